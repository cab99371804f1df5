/// \file
/// Random numbers that are the same everywhere: the standard's distributions are not.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <vtm/scene/path.hpp>

namespace vtm::generate {

/// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    /// In [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * std::ldexp(double(bits() >> 11), -53);
    }
    /// Of even spread over the orders of magnitude; low > 0.
    double magnitude(double low, double high) { return std::exp2(uniform(std::log2(low), std::log2(high))); }
    /// In [low, high].
    int integer(int low, int high) { return low + int(bits() % std::uint64_t(high - low + 1)); }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    scene::Point point(double low, double high) {
        const double x = uniform(low, high);
        return {x, uniform(low, high)};
    }
    /// One of an enumeration's values, 0 to last.
    template <class Enum>
    Enum any(Enum last) {
        return static_cast<Enum>(integer(0, int(last)));
    }

private:
    std::uint64_t state_;
};

}  // namespace vtm::generate
