#include "api/openvg/draw/flat_ground.hpp"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace vtm::openvg {

namespace {

using Group = FlatGround::Group;

/// Draws a group if its covered pixels are the ground.
bool drawGroup(std::uint8_t* p, const Group& group, std::uint32_t ground) {
    std::array<std::uint32_t, FlatGround::groupPixels> there;
    std::memcpy(there.data(), p, sizeof there);
    std::uint32_t others = 0;
    for (std::size_t k = 0; k < there.size(); ++k)
        others |= group.covered[k] ? there[k] ^ ground : 0;
    if (others != 0)
        return false;
    for (std::size_t k = 0; k < there.size(); ++k)
        there[k] = group.covered[k] ? group.words[k] : there[k];
    std::memcpy(p, there.data(), sizeof there);
    return true;
}

#ifdef __x86_64__

__attribute__((target("avx2"))) bool drawGroupAtOnce(std::uint8_t* p, const Group& group, __m256i ground) {
    auto* const pixels = reinterpret_cast<__m256i*>(p);
    const __m256i there = _mm256_loadu_si256(pixels),
                  words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(group.words.data())),
                  covered = _mm256_cvtepi8_epi32(
                      _mm_loadl_epi64(reinterpret_cast<const __m128i*>(group.covered.data())));
    if (!_mm256_testz_si256(_mm256_xor_si256(there, ground), covered))
        return false;
    _mm256_storeu_si256(pixels, _mm256_blendv_epi8(there, words, covered));
    return true;
}

__attribute__((target("avx2"))) std::size_t drawGroupsAtOnce(std::uint8_t* corner,
                                                             std::span<const Group> groups,
                                                             std::uint32_t ground, std::uint16_t* others) {
    const __m256i grounds = _mm256_set1_epi32(int(ground));
    std::size_t count = 0;
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (!drawGroupAtOnce(corner + groups[i].place, groups[i], grounds))
            others[count++] = std::uint16_t(i);
    return count;
}

#endif

}  // namespace

std::size_t FlatGround::drawGroups(std::uint8_t* corner, std::uint16_t* others) const {
#ifdef __x86_64__
    static const bool hasAvx2 = __builtin_cpu_supports("avx2");
    if (hasAvx2)
        return drawGroupsAtOnce(corner, groups_, key_.ground, others);
#endif
    std::size_t count = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i)
        if (!drawGroup(corner + groups_[i].place, groups_[i], key_.ground))
            others[count++] = std::uint16_t(i);
    return count;
}

}  // namespace vtm::openvg
