/// \file
/// Doubles two at a time. Each is computed as if alone, so results are the same on all machines. Operators
/// work element by element; comparisons give masks. A template that takes doubles takes these as well.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace vtm::compiler {

using Pair = double __attribute__((vector_size(2 * sizeof(double))));
using PairMask = std::int64_t __attribute__((vector_size(2 * sizeof(std::int64_t))));
using IntPair = std::int32_t __attribute__((vector_size(2 * sizeof(std::int32_t))));

/// From and to places that need not be aligned.
inline Pair load(const double* from) {
    Pair v;
    std::memcpy(&v, from, sizeof(v));
    return v;
}
inline void store(double* to, Pair v) { std::memcpy(to, &v, sizeof(v)); }

inline Pair both(double v) { return Pair{v, v}; }

inline double magnitude(double v) { return std::abs(v); }
inline Pair magnitude(Pair v) {
    constexpr std::int64_t allButSign = 0x7fff'ffff'ffff'ffff;
    return reinterpret_cast<Pair>(reinterpret_cast<PairMask>(v) & allButSign);
}
inline double squareRoot(double v) { return std::sqrt(v); }
inline Pair squareRoot(Pair v) { return Pair{std::sqrt(v[0]), std::sqrt(v[1])}; }

#if defined(__SSE2__)
inline Pair larger(Pair a, Pair b) { return _mm_max_pd(b, a); }
inline Pair smaller(Pair a, Pair b) { return _mm_min_pd(b, a); }
#else
inline Pair larger(Pair a, Pair b) { return a < b ? b : a; }
inline Pair smaller(Pair a, Pair b) { return b < a ? b : a; }
#endif

/// The elements before those of `at`, where `before` holds the pair before it.
inline Pair previous(Pair before, Pair at) { return __builtin_shufflevector(before, at, 1, 2); }

inline Pair toDoubles(IntPair v) { return __builtin_convertvector(v, Pair); }
/// Towards zero.
inline IntPair toIntegers(Pair v) { return __builtin_convertvector(v, IntPair); }

}  // namespace vtm::compiler
