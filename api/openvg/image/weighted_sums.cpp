#include "api/openvg/image/weighted_sums.hpp"

#include <cstring>

namespace vtm::openvg {

namespace {

using Double4 = double __attribute__((vector_size(32)));

/// As many colours as sums stay in registers, with whatever instructions the caller is compiled for.
template <int count>
__attribute__((always_inline)) inline void sumSome(const Sum* const* taps, const double* weights,
                                                   std::size_t tapCount, std::size_t first, Sum* sums) {
    Double4 sum[count] = {};
    for (std::size_t k = 0; k < tapCount; ++k) {
        const double w = weights[k];
        const Double4 weight{w, w, w, w};
        for (int i = 0; i < count; ++i) {
            Double4 tap;
            std::memcpy(&tap, taps[k] + first + std::size_t(i), sizeof(tap));
            sum[i] += weight * tap;
        }
    }
    std::memcpy(sums + first, sum, sizeof(sum));
}

__attribute__((always_inline)) inline void sumAll(const Sum* const* taps, const double* weights,
                                                  std::size_t tapCount, Sum* sums, std::size_t size) {
    constexpr std::size_t atOnce = 6;
    std::size_t i = 0;
    for (; i + atOnce <= size; i += atOnce)
        sumSome<atOnce>(taps, weights, tapCount, i, sums);
    for (; i < size; ++i)
        sumSome<1>(taps, weights, tapCount, i, sums);
}

#ifdef __x86_64__
__attribute__((target("avx2"))) void sumWide(const Sum* const* taps, const double* weights,
                                             std::size_t tapCount, Sum* sums, std::size_t size) {
    sumAll(taps, weights, tapCount, sums, size);
}
#endif

}  // namespace

void weightedSums(std::span<const Sum* const> taps, std::span<const double> weights, std::span<Sum> sums) {
#ifdef __x86_64__
    static const bool isWide = __builtin_cpu_supports("avx2");
    if (isWide)
        return sumWide(taps.data(), weights.data(), taps.size(), sums.data(), sums.size());
#endif
    sumAll(taps.data(), weights.data(), taps.size(), sums.data(), sums.size());
}

}  // namespace vtm::openvg
