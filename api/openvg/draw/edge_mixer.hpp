/// \file
/// One colour mixed into the first three of a pixel's four bytes, which are opaque, by a share of the pixel:
/// in linear light (docs/openvg.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "api/openvg/paint/color.hpp"

namespace vtm::openvg {

/// A share of a pixel in fixed point.
inline constexpr unsigned wholeShare = 65536;
inline unsigned fixedShare(float share) { return unsigned(int(share * float(wholeShare) + 0.5f)); }

/// A pixel that is covered in part, counted from a corner.
struct EdgePixel {
    std::uint8_t x, y;
    std::uint16_t share;  ///< in 65536ths, not 0

    /// Of four bytes a pixel.
    std::uint8_t* in(std::uint8_t* corner, std::ptrdiff_t stride) const {
        return corner + y * stride + 4 * std::ptrdiff_t(x);
    }
};

/// On surfaces of linear light; an opaque colour on sRGB surfaces; a translucent one there, which is blended
/// in their space, with the edge mixed in linear light.
enum class EdgeRule { linear, opaque, translucent };

/// One colour, as a surface takes it, prepared for many edges.
struct EdgeColor {
    EdgeColor() = default;
    EdgeColor(Color color, ColorSpace space, bool hasAlpha)
        : rule(space.linear   ? EdgeRule::linear
               : color.a == 1 ? EdgeRule::opaque
                              : EdgeRule::translucent),
          kept(1 - color.a),
          groundHasAlpha(hasAlpha),
          groundIsPremultiplied(space.premultiplied) {
        for (int c = 0; c < 3; ++c)
            source[std::size_t(c)] = rule == EdgeRule::opaque ? byteGamma().decode(color[c]) : color[c];
        isGrey = source[0] == source[1] && source[1] == source[2];
    }

    EdgeRule rule = EdgeRule::linear;
    std::array<float, 3> source{};  ///< premultiplied; of an opaque one in linear light
    float kept = 0;                 ///< of what is below a translucent one
    bool isGrey = false;
    bool groundHasAlpha = false;  ///< in the fourth byte
    bool groundIsPremultiplied = false;
};

namespace wide {
/// Mixes pixels of four bytes on processors with AVX2; false on others.
bool mixEdges(std::uint8_t* corner, std::ptrdiff_t stride, std::span<const EdgePixel> edges,
              const EdgeColor& color);
}  // namespace wide

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
