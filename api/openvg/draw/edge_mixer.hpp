/// \file
/// One colour mixed into the first three of a pixel's four bytes, which are opaque, by a share of the pixel:
/// in linear light (docs/openvg.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "api/openvg/paint/color.hpp"

namespace vtm::openvg {

/// A share of a pixel in fixed point.
inline constexpr unsigned wholeShare = 65536;
inline unsigned fixedShare(float share) { return unsigned(int(share * float(wholeShare) + 0.5f)); }

/// On surfaces of linear light.
class LinearMixer {
public:
    explicit LinearMixer(Color source) : added_(source * 255.0f), kept_(source.a) {}
    void operator()(std::uint8_t* p, unsigned share) const {
        const float part = float(int(share)) * (1.0f / wholeShare);
        for (int c = 0; c < 3; ++c) {
            const float before = float(p[c]);
            p[c] = std::uint8_t(int(before + part * (added_[c] - kept_ * before) + 0.5f));
        }
    }

private:
    Color added_;
    float kept_;
};

/// An opaque colour on sRGB surfaces.
class OpaqueMixer {
public:
    explicit OpaqueMixer(Color source) {
        for (int c = 0; c < 3; ++c)
            light_[c] = unsigned(int(gamma_.decode(source[c]) * 2 * ByteGamma::steps + 0.5f));
        isGrey_ = light_[0] == light_[1] && light_[1] == light_[2];
    }
    void operator()(std::uint8_t* p, unsigned share) const {
        const unsigned left = wholeShare - share;
        const auto mixed = [&](int c) {
            constexpr unsigned half = 1 << 16;  // of a step
            return gamma_.encoded[(gamma_.halfSteps[p[c]] * left + light_[c] * share + half) >> 17];
        };
        const std::uint8_t r = mixed(0);
        // Text mostly is grey on grey.
        if (isGrey_ && p[1] == p[0] && p[2] == p[0]) {
            p[0] = p[1] = p[2] = r;
            return;
        }
        const std::uint8_t g = mixed(1), b = mixed(2);
        p[0] = r, p[1] = g, p[2] = b;
    }

private:
    const ByteGamma& gamma_ = byteGamma();
    std::array<unsigned, 3> light_;  ///< 32768 is 1
    bool isGrey_;
};

/// What an OpaqueMixer makes of one pixel, a word, for 4096 shares: in the middle of each step, so the share
/// is off by 2^-13, 0.4 of a byte at most, where white is drawn on black.
class FlatGround {
public:
    /// The words by share for this colour on a ground of that word; null if there are none.
    const std::uint32_t* words(const Color& color, std::uint32_t ground) const {
        return color == color_ && ground == ground_ ? words_.data() : nullptr;
    }
    static std::size_t indexOf(unsigned share) { return share >> stepBits; }
    /// Counts what is mixed on a ground, and makes the table when it pays.
    void count(const Color& color, std::uint32_t ground, std::size_t pixels) {
        if (color != nextColor_ || ground != nextGround_)
            mixed_ = 0;
        nextColor_ = color;
        nextGround_ = ground;
        mixed_ += pixels;
        if (mixed_ > words_.size())
            make();
    }

private:
    static constexpr int stepBits = 4;

    void make() {
        const OpaqueMixer mixer(nextColor_);
        for (std::size_t i = 0; i < words_.size(); ++i) {
            words_[i] = nextGround_;
            mixer(reinterpret_cast<std::uint8_t*>(&words_[i]), unsigned(i << stepBits) + (1 << stepBits) / 2);
        }
        color_ = nextColor_;
        ground_ = nextGround_;
        mixed_ = 0;
    }

    std::array<std::uint32_t, (wholeShare >> stepBits)> words_;
    Color color_{-1}, nextColor_{-1};  ///< no colour at first
    std::uint32_t ground_ = 0, nextGround_ = 0;
    std::size_t mixed_ = 0;
};

/// A translucent colour on sRGB surfaces: it is blended in their space, and the edge is mixed in linear
/// light.
class TranslucentMixer {
public:
    explicit TranslucentMixer(Color source) : source_(source), kept_((1 - source.a) / 255) {}
    void operator()(std::uint8_t* p, unsigned share) const {
        const float part = float(int(share)) * (1.0f / wholeShare);
        for (int c = 0; c < 3; ++c) {
            const float before = gamma_.decodedBytes[p[c]],
                        after = gamma_.decode(std::min(source_[c] + float(p[c]) * kept_, 1.0f));
            p[c] = gamma_.encode(before + part * (after - before));
        }
    }

private:
    const ByteGamma& gamma_ = byteGamma();
    Color source_;
    float kept_;
};

}  // namespace vtm::openvg
