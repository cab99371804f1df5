/// \file
/// 64-bit hashes of sequences of numbers.
#pragma once

#include <bit>
#include <cstdint>

namespace vtm::compiler {

/// The hash of a sequence whose hash was `h`, one number longer. Each step is a bijection of either argument
/// (the finaliser of MurmurHash3, Appleby), so different numbers give different hashes.
inline std::uint64_t hashCombine(std::uint64_t h, std::uint64_t value) {
    h = std::rotl(h, 23) * 0x9E3779B97F4A7C15u ^ value;
    h = (h ^ (h >> 33)) * 0xFF51AFD7ED558CCDu;
    h = (h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53u;
    return h ^ (h >> 33);
}

inline std::uint64_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }
inline std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace vtm::compiler
