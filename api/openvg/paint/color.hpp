/// \file
/// Colours as OpenVG counts them (specification section 3.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace vtm::openvg {

/// How the first three numbers of a colour are meant. A luminance colour carries its one number in all three.
struct ColorSpace {
    bool linear = false;         ///< linear light, not sRGB-encoded
    bool premultiplied = false;  ///< multiplied by alpha
    bool luminance = false;

    friend bool operator==(const ColorSpace&, const ColorSpace&) = default;
};

inline constexpr ColorSpace sRGBA{false, false, false}, sRGBA_PRE{false, true, false};

/// Red, green, blue, alpha in [0, 1] unless said otherwise.
using Color = glm::vec4;

/// Every number pulled to [0, 1]; what no number is becomes 0 (section 3.3).
inline Color clampedToUnit(Color c) { return glm::min(glm::max(Color(0), c), Color(1)); }

/// γ and its inverse of section 3.4.2, on [0, 1].
float encodeGamma(float linear);
float decodeGamma(float encoded);

/// The same of colours, from tables, within 1e-5: fast enough for every pixel of an edge.
void fastEncode(std::span<Color> linear);
void fastDecode(std::span<Color> encoded);
inline Color fastEncoded(Color linear) {
    fastEncode({&linear, 1});
    return linear;
}
inline Color fastDecoded(Color encoded) {
    fastDecode({&encoded, 1});
    return encoded;
}

/// For bytes: γ⁻¹ of v / 255 for v from 0 to 255, and of numbers from 0 to 1 within a tenth of a byte's step;
/// γ as bytes, within 0.6 of the exact number's.
struct ByteGamma {
    static constexpr float steps = 16384;  ///< of linear light, of `encoded`

    std::array<float, 256> decodedBytes;
    std::array<std::uint16_t, 256> halfSteps;  ///< of decodedBytes, 32768 being 1
    std::array<float, 4097> decoded;
    std::array<std::uint8_t, 16385> encoded;

    ByteGamma();
    float decode(float v) const { return decoded[unsigned(int(v * 4096 + 0.5f))]; }
    std::uint8_t encode(float linear) const { return encoded[unsigned(int(linear * steps + 0.5f))]; }
};
const ByteGamma& byteGamma();

/// Formula (3): that of linear light, of red, green and blue.
inline float luminance(glm::vec3 c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

/// Divides alpha out: colours are clamped to [0, alpha] first, and 0 where alpha is.
inline Color unpremultiplied(Color c) {
    if (!(c.a > 0))
        return Color(0, 0, 0, 0);
    return Color(glm::clamp(glm::vec3(c), 0.0f, c.a) / c.a, c.a);
}

inline Color premultiplied(Color c) { return Color(glm::vec3(c) * c.a, c.a); }

/// A colour without premultiplied alpha, from one space to another (table 2); only `linear` and `luminance`
/// count.
Color converted(Color color, ColorSpace from, ColorSpace to);

/// The same with alpha taken out before and put back after, as both spaces want it (section 3.4.4).
Color fullyConverted(Color color, ColorSpace from, ColorSpace to);

/// A colour that a program gave, four numbers without premultiplied alpha in sRGB, as one of another space.
inline Color givenColor(const std::array<float, 4>& c, ColorSpace to) {
    return fullyConverted(clampedToUnit({c[0], c[1], c[2], c[3]}), sRGBA, to);
}

}  // namespace vtm::openvg
