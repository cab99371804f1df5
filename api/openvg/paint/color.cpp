#include "api/openvg/paint/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "api/openvg/paint/lanes.hpp"

namespace vtm::openvg {

float encodeGamma(float x) { return x <= 0.00304f ? 12.92f * x : 1.0556f * std::pow(x, 1 / 2.4f) - 0.0556f; }

float decodeGamma(float x) { return x <= 0.03928f ? x / 12.92f : std::pow((x + 0.0556f) / 1.0556f, 2.4f); }

namespace {

Color decoded(Color c) { return {decodeGamma(c.r), decodeGamma(c.g), decodeGamma(c.b), c.a}; }
Color encoded(Color c) { return {encodeGamma(c.r), encodeGamma(c.g), encodeGamma(c.b), c.a}; }

/// A function on [0, 1] by straight lines between many points.
class Table {
public:
    template <class Function>
    explicit Table(Function&& function) {
        for (std::size_t i = 0; i < values_.size(); ++i)
            values_[i] = float(function(double(i) / parts));
    }
    /// Of the first three; the last stays.
    Float4 operator()(Float4 x) const {
        const Float4 place = unit(x) * splat(float(parts));
        Float4 result = x;
        for (int c = 0; c < 3; ++c) {
            const int i = std::min(int(place[c]), parts - 1);
            const float* const value = &values_[std::size_t(i)];
            result[c] = value[0] + (place[c] - float(i)) * (value[1] - value[0]);
        }
        return result;
    }

private:
    static constexpr int parts = 4096;
    std::array<float, parts + 1> values_;
};

}  // namespace

void fastEncode(std::span<Color> colors) {
    // Over the root, where the curve is not steep.
    static const Table table([](double root) { return encodeGamma(float(root * root)); });
    for (Color& color : colors) {
        const Float4 c = loaded(color);
        assign(color, withAlpha(table(root(greater(c, Float4{}))), c));
    }
}

void fastDecode(std::span<Color> colors) {
    static const Table table([](double x) { return decodeGamma(float(x)); });
    for (Color& color : colors)
        assign(color, table(loaded(color)));
}

ByteGamma::ByteGamma() {
    for (std::size_t i = 0; i < decodedBytes.size(); ++i) {
        decodedBytes[i] = decodeGamma(float(i) / 255);
        halfSteps[i] = std::uint16_t(std::min(decodedBytes[i], 1.0f) * 2 * steps + 0.5f);
    }
    for (std::size_t i = 0; i < decoded.size(); ++i)
        decoded[i] = decodeGamma(float(i) / 4096);
    for (std::size_t i = 0; i < encoded.size(); ++i)
        encoded[i] = std::uint8_t(std::min(encodeGamma(float(i) / steps), 1.0f) * 255 + 0.5f);
}

const ByteGamma& byteGamma() {
    static const ByteGamma tables;
    return tables;
}

Color converted(Color color, ColorSpace from, ColorSpace to) {
    if (from.linear == to.linear && from.luminance == to.luminance)
        return color;
    // Luminance is a sum of linear light. Grey stands for itself in all spaces of its kind.
    const bool toGrey = to.luminance && !from.luminance;
    bool linear = from.linear;
    if (!linear && (toGrey || to.linear)) {
        color = decoded(color);
        linear = true;
    }
    if (toGrey)
        color = Color(glm::vec3(luminance(glm::vec3(color))), color.a);
    return linear && !to.linear ? encoded(color) : color;
}

Color fullyConverted(Color color, ColorSpace from, ColorSpace to) {
    if (from == to)
        return color;
    if (from.premultiplied)
        color = unpremultiplied(color);
    color = converted(color, from, to);
    return to.premultiplied ? premultiplied(color) : color;
}

}  // namespace vtm::openvg
