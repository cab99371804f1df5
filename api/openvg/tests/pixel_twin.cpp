#include "api/openvg/tests/pixel_twin.hpp"

#include <algorithm>
#include <cmath>

namespace vtm::openvg::testing {

namespace {

Color inLight(Color c) {
    return premultiplied(converted(unpremultiplied(c), {false, false, false}, {true, false, false}));
}
Color fromLight(Color c) {
    return premultiplied(converted(unpremultiplied(c), {true, false, false}, {false, false, false}));
}

ColorSpace premultipliedSpace(ColorSpace space) { return {space.linear, true, space.luminance}; }

glm::dvec2 mapped(const glm::dmat3& m, double x, double y) {
    const glm::dvec3 p = m * glm::dvec3(x, y, 1);
    return glm::dvec2(p) / p.z;
}

Color padded(const TwinImage& image, double x, double y) {
    return image.color(int(std::clamp(x, 0.0, image.width - 1.0)),
                       int(std::clamp(y, 0.0, image.height - 1.0)));
}

}  // namespace

TwinImage::TwinImage(VGImageFormat imageName, int w, int h)
    : name(imageName),
      format(*imageFormat(VGint(imageName))),
      width(w),
      height(h),
      words(std::size_t(w) * std::size_t(h)) {}

Color TwinImage::color(int x, int y) const {
    const Color c = format.decode(word(x, y));
    return format.space.premultiplied ? c : premultiplied(c);
}

std::vector<std::uint8_t> TwinImage::bytes() const {
    std::vector<std::uint8_t> result(std::size_t(stride()) * std::size_t(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* const row = result.data() + y * stride();
            const auto bit = unsigned(x) * format.bits;
            for (unsigned b = 0; b < format.bits; ++b)
                if (word(x, y) >> b & 1)
                    row[(bit + b) / 8] |= std::uint8_t(1u << ((bit + b) % 8));
        }
    return result;
}

void TwinImage::setBytes(const std::vector<std::uint8_t>& bytes) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::uint8_t* const row = bytes.data() + y * stride();
            const auto bit = unsigned(x) * format.bits;
            word(x, y) = 0;
            for (unsigned b = 0; b < format.bits; ++b)
                word(x, y) |= (row[(bit + b) / 8] >> ((bit + b) % 8) & 1u) << b;
        }
}

Color TwinDrawing::drawn(const TwinImage& surface, const TwinSource& source, int x, int y) const {
    const ColorSpace space = premultipliedSpace(surface.format.space);
    ColorSpace from = source.space;
    Color color = source.color(x, y);
    if (colorTransform) {
        const std::array<VGfloat, 8>& t = *colorTransform;
        color = premultiplied(clampedToUnit(unpremultiplied(color) * Color(t[0], t[1], t[2], t[3]) +
                                            Color(t[4], t[5], t[6], t[7])));
        from.luminance = false;
    }
    color = fullyConverted(color, from, space);
    const Color before = surface.color(x, y), after = blendModeOf(blendMode).pixel(color, before);
    const float share = coverage(x, y);
    if (share == 1 || share == 0)
        return share == 1 ? after : before;
    if (space.linear)
        return before + share * (after - before);
    return fromLight(inLight(before) + share * (inLight(after) - inLight(before)));
}

TwinSource nearest(const TwinImage& image, const glm::dmat3& fromSurface) {
    return {premultipliedSpace(image.format.space), [&image, fromSurface](int x, int y) {
                const glm::dvec2 p = glm::floor(mapped(fromSurface, x + 0.5, y + 0.5));
                return padded(image, p.x, p.y);
            }};
}

TwinSource bilinear(const TwinImage& image, const glm::dmat3& fromSurface) {
    return {premultipliedSpace(image.format.space), [&image, fromSurface](int x, int y) {
                const glm::dvec2 q = mapped(fromSurface, x + 0.5, y + 0.5) - 0.5, low = glm::floor(q),
                                 share = q - low;
                glm::dvec4 sum(0);
                for (int j = 0; j < 2; ++j)
                    for (int i = 0; i < 2; ++i)
                        sum += (i ? share.x : 1 - share.x) * (j ? share.y : 1 - share.y) *
                               glm::dvec4(padded(image, low.x + i, low.y + j));
                return Color(sum);
            }};
}

bool isNear(const PixelFormat& format, std::uint32_t word, Color expected) {
    const float rounding = 0.5f / 255 + 1e-3f / 255;
    const Color stored = format.decode(word);
    const auto step = [](Channel channel) {
        return channel.bits == 0 ? 0 : 0.5f / float((1 << channel.bits) - 1);
    };
    // Without alpha, what the colour is before its own multiplies it.
    if (format.alpha.bits == 0 && !format.space.premultiplied)
        expected = Color(glm::vec3(unpremultiplied(expected)), 1);
    if (std::abs(stored.a - expected.a) > step(format.alpha) + rounding)
        return false;
    if (format.red.bits == 0 && format.grey.bits == 0)
        return true;
    const std::array<float, 3> steps =
        format.grey.bits != 0 ? std::array{step(format.grey), 0.0f, 0.0f}
                              : std::array{step(format.red), step(format.green), step(format.blue)};
    const bool isStraight = !format.space.premultiplied && format.alpha.bits != 0;
    // Alpha itself is rounded, too, where it multiplies.
    const float alphaStep = isStraight ? step(format.alpha) : 0;
    const Color shown = isStraight ? premultiplied(stored) : stored;
    for (int c = 0; c < (format.grey.bits != 0 ? 1 : 3); ++c)
        if (std::abs(shown[c] - expected[c]) > steps[std::size_t(c)] + alphaStep + rounding)
            return false;
    return true;
}

}  // namespace vtm::openvg::testing
