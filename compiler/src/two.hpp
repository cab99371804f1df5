/// \file
/// Two numbers at once, in one register, for loops over many. Operators work element by element; comparisons
/// give masks. A template that takes numbers takes these as well.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

namespace vtm::compiler {

typedef double Two __attribute__((vector_size(16)));
typedef std::int64_t TwoMasks __attribute__((vector_size(16)));

/// From and to places that need not be aligned.
inline Two loadTwo(const double* from) {
    Two v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
inline void storeTwo(Two v, double* to) { std::memcpy(to, &v, sizeof v); }

inline double magnitude(double v) { return std::abs(v); }
inline Two magnitude(Two v) {
    constexpr std::int64_t allButSign = 0x7fff'ffff'ffff'ffff;
    return reinterpret_cast<Two>(reinterpret_cast<TwoMasks>(v) & allButSign);
}
inline double squareRoot(double v) { return std::sqrt(v); }
inline Two squareRoot(Two v) { return Two{std::sqrt(v[0]), std::sqrt(v[1])}; }

}  // namespace vtm::compiler
