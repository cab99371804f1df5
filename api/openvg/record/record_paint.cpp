#include "api/openvg/record/record_paint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "api/openvg/draw/pixel_source.hpp"
#include "api/openvg/paint/paint_color.hpp"

namespace vtm::openvg {

namespace {

/// Straight, as a scene has it.
scene::Color sceneColor(Color c) {
    c = clampedToUnit(c);
    return {c.r, c.g, c.b, c.a};
}

/// What the context's colour transform makes of a straight colour.
Color finished(Color color, ColorSpace from, const State& state) {
    const ScaleAndBias transform(state);
    if (transform.isOn()) {
        color = transform(color);
        from.luminance = false;  // what was grey may no longer be
    }
    return converted(color, {from.linear, false, from.luminance}, sRGBA);
}

// ---- Ramps ----------------------------------------------------------------------------------------

/// Stops of a scene are mixed straight and in sRGB. Where a ramp is mixed otherwise it is halved until both
/// agree, premultiplied, within this at three places: a quarter of a byte's step.
constexpr float rampTolerance = 1.0f / 1024;
constexpr int maxHalvings = 6;

/// A colour without alpha has none to show. So near to a stop its neighbourhood's is taken.
constexpr float besideStop = 1.0f / 1024;

class Stops {
public:
    Stops(const ColorRamp& ramp, const State& state) : ramp_(ramp), state_(state) {
        const std::vector<ColorRamp::Stop>& stops = ramp.stops();
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
            const Color first = at(stops[i], stops[i + 1], 0), last = at(stops[i], stops[i + 1], 1);
            add(stops[i].offset, first);
            divide(stops[i], stops[i + 1], 0, first, 1, last, maxHalvings);
            add(stops[i + 1].offset, last);
        }
    }

    std::vector<scene::GradientStop> result;

private:
    Color at(const ColorRamp::Stop& a, const ColorRamp::Stop& b, float t) const {
        const auto straight = [&](float u) {
            return finished(unpremultiplied(ramp_.between(a, b, u)), ramp_.space(), state_);
        };
        const Color color = straight(t);
        if (color.a > 0 || (t > 0 && t < 1))
            return color;
        return {glm::vec3(straight(t > 0 ? 1 - besideStop : besideStop)), 0};
    }

    void add(float offset, Color color) {
        const scene::GradientStop stop{offset, sceneColor(color)};
        if (result.empty() || result.back().offset != offset || !(result.back().color == stop.color))
            result.push_back(stop);
    }

    void divide(const ColorRamp::Stop& a, const ColorRamp::Stop& b, float from, Color first, float to,
                Color last, int left) {
        const auto isOff = [&](float t) {
            const Color want = premultiplied(at(a, b, glm::mix(from, to, t))),
                        got = premultiplied(glm::mix(first, last, t)), off = glm::abs(want - got);
            return std::max({off.r, off.g, off.b, off.a}) > rampTolerance;
        };
        if (left == 0 || !(isOff(0.25f) || isOff(0.5f) || isOff(0.75f)))
            return;
        const float middle = 0.5f * (from + to);
        const Color color = at(a, b, middle);
        divide(a, b, from, first, middle, color, left - 1);
        add(glm::mix(a.offset, b.offset, middle), color);
        divide(a, b, middle, color, to, last, left - 1);
    }

    const ColorRamp& ramp_;
    const State& state_;
};

scene::Spread spreadOf(const Paint& paint) {
    return paint.spread == VG_COLOR_RAMP_SPREAD_REPEAT    ? scene::Spread::Repeat
           : paint.spread == VG_COLOR_RAMP_SPREAD_REFLECT ? scene::Spread::Reflect
                                                          : scene::Spread::Pad;
}

/// A parameter of a gradient: what is no number counts as 0, what is infinite as the largest there is.
double number(VGfloat v) {
    return std::isnan(v) ? 0 : std::clamp(double(v), -double(maxFloat), double(maxFloat));
}

scene::Paint gradientPaint(const Paint& paint, const scene::Affine& toUser, const State& state) {
    const ColorRamp ramp(paint);
    const auto end = [&] {
        return scene::Paint(
            sceneColor(finished(unpremultiplied(ramp.at(1)), {ramp.space().linear, false, false}, state)));
    };
    if (paint.type == VG_PAINT_TYPE_LINEAR_GRADIENT) {
        const glm::dvec2 start(number(paint.linear[0]), number(paint.linear[1])),
            last(number(paint.linear[2]), number(paint.linear[3]));
        if (start == last)
            return end();
        return scene::LinearGradient{start, last, Stops(ramp, state).result, spreadOf(paint), toUser};
    }
    const double radius = number(paint.radial[4]);
    const glm::dvec2 center(number(paint.radial[0]), number(paint.radial[1])), focus = insideFocus(paint);
    if (!(radius > 0 && std::isfinite(focus.x) && std::isfinite(focus.y)))
        return end();
    return scene::RadialGradient{center,          radius, focus, 0, Stops(ramp, state).result,
                                 spreadOf(paint), toUser};
}

// ---- Images ---------------------------------------------------------------------------------------

/// `texel(x, y)`: straight, sRGB.
template <class Texel>
image::Bitmap bitmapOf(int width, int height, Texel&& texel) {
    image::Bitmap bitmap{width, height, {}};
    bitmap.rgba.reserve(std::size_t(width) * std::size_t(height) * 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Color color = clampedToUnit(texel(x, y));
            for (int c = 0; c < 4; ++c)
                bitmap.rgba.push_back(std::uint8_t(color[c] * 255 + 0.5f));
        }
    return bitmap;
}

Color straightColor(const Image& image, int x, int y) {
    const Color color = image.color(x, y);
    return image.format().space.premultiplied ? unpremultiplied(color) : color;
}

/// A pixel as both colour transforms leave it.
Color texelOf(const Image& image, int x, int y, const ColorTransform& transform, const State& state) {
    ColorSpace space = image.format().space;
    Color color = straightColor(image, x, y);
    if (!transform.isIdentity()) {
        color = transform(converted(color, space, transform.space()));
        space = transform.space();
    }
    return finished(color, space, state);
}

int wrapped(int i, int size) { return (i % size + size) % size; }

scene::Affine shifted(const scene::Affine& m, double by) {
    return scene::compose(m, scene::translation(by, by));
}

scene::Node itemOf(const scene::Shape& shape, scene::Paint paint) {
    return {scene::Item{shape.path, shape.transform, shape.geometry, std::move(paint), 1}};
}

std::shared_ptr<const scene::Path> rectangle(double width, double height) {
    return std::make_shared<scene::Path>(scene::rectangle({0, 0}, {width, height}));
}

/// One period of a repeated or mirrored image. A border of a pixel holds what comes next, for filters to
/// reach into.
scene::Pattern tiles(const Image& image, bool isMirrored, const scene::ImageFilter filter,
                     const scene::Affine& toUser, const ColorTransform& transform, const State& state,
                     Bitmaps& bitmaps) {
    const int w = image.width(), h = image.height(), width = isMirrored ? 2 * w : w,
              height = isMirrored ? 2 * h : h;
    const auto texel = [&](int x, int y) {
        const int i = wrapped(x - 1, width), j = wrapped(y - 1, height);
        return texelOf(image, i < w ? i : width - 1 - i, j < h ? j : height - 1 - j, transform, state);
    };
    scene::ImagePaint fill{bitmaps.add(bitmapOf(width + 2, height + 2, texel)), filter,
                           shifted(scene::identity, -1)};
    const scene::Shape tile{rectangle(width, height), scene::identity, scene::FillRule::NonZero};
    return {{0, 0}, {double(width), double(height)}, groupOf(itemOf(tile, std::move(fill))), toUser};
}

scene::Node patternNode(const scene::Shape& shape, const Paint& paint, const scene::Affine& toUser,
                        const State& state, Bitmaps& bitmaps) {
    const Image& image = *paint.pattern;
    const ColorTransform transform(paint);
    const scene::ImageFilter filter = state.imageQuality == VG_IMAGE_QUALITY_NONANTIALIASED
                                          ? scene::ImageFilter::Nearest
                                          : scene::ImageFilter::Trilinear;
    if (paint.tiling == VG_TILE_REPEAT || paint.tiling == VG_TILE_REFLECT)
        return itemOf(
            shape, tiles(image, paint.tiling == VG_TILE_REFLECT, filter, toUser, transform, state, bitmaps));
    const auto texel = [&](int x, int y) { return texelOf(image, x, y, transform, state); };
    scene::Node inside = itemOf(
        shape,
        scene::ImagePaint{bitmaps.add(bitmapOf(image.width(), image.height(), texel)), filter, toUser});
    if (paint.tiling == VG_TILE_PAD)
        return inside;
    const auto& f = state.tileFillColor;
    const Color around = finished(transformedColor(transform, {f[0], f[1], f[2], f[3]}, sRGBA), sRGBA, state);
    const scene::Shape tile{rectangle(image.width(), image.height()), scene::compose(shape.transform, toUser),
                            scene::FillRule::NonZero};
    return {scene::Select{tile, groupOf(std::move(inside)), groupOf(itemOf(shape, sceneColor(around)))}};
}

bool isOpaque(const scene::Paint& paint) {
    const auto areOpaque = [](const std::vector<scene::GradientStop>& stops) {
        return std::ranges::all_of(stops, [](const scene::GradientStop& s) { return s.color.a == 1; });
    };
    if (const auto* color = std::get_if<scene::Color>(&paint))
        return color->a == 1;
    if (const auto* linear = std::get_if<scene::LinearGradient>(&paint))
        return areOpaque(linear->stops);
    if (const auto* radial = std::get_if<scene::RadialGradient>(&paint))
        return areOpaque(radial->stops);
    if (const auto* image = std::get_if<scene::ImagePaint>(&paint)) {
        const std::vector<std::uint8_t>& rgba = image->bitmap->rgba;
        for (std::size_t i = 3; i < rgba.size(); i += 4)
            if (rgba[i] != 255)
                return false;
        return true;
    }
    return false;
}

}  // namespace

std::shared_ptr<const scene::Group> groupOf(scene::Node node) {
    scene::Group group;
    group.children.push_back(std::move(node));
    return std::make_shared<scene::Group>(std::move(group));
}

std::shared_ptr<const image::Bitmap> Bitmaps::add(image::Bitmap bitmap) {
    const auto known = std::ranges::find_if(bitmaps_, [&](const auto& b) {
        return b->width == bitmap.width && b->height == bitmap.height && b->rgba == bitmap.rgba;
    });
    if (known != bitmaps_.end())
        return *known;
    bitmaps_.push_back(std::make_shared<image::Bitmap>(std::move(bitmap)));
    return bitmaps_.back();
}

scene::Affine affineOf(const glm::mat3& m) { return {glm::dvec2(m[0]), glm::dvec2(m[1]), glm::dvec2(m[2])}; }

scene::Color clearColor(const State& state) {
    const auto& c = state.clearColor;
    return sceneColor({c[0], c[1], c[2], c[3]});
}

std::optional<Color> colorOf(const Paint& paint) {
    if (paint.type != VG_PAINT_TYPE_COLOR && (paint.type != VG_PAINT_TYPE_PATTERN || paint.pattern))
        return std::nullopt;
    const std::array<VGfloat, 4>& c = paint.color;
    return transformedColor(ColorTransform(paint), {c[0], c[1], c[2], c[3]}, sRGBA);
}

scene::Node painted(const scene::Shape& shape, const Paint& paint, const scene::Affine& paintToUser,
                    const State& state, Bitmaps& bitmaps) {
    if (const std::optional<Color> color = colorOf(paint))
        return itemOf(shape, sceneColor(finished(*color, sRGBA, state)));
    if (paint.type == VG_PAINT_TYPE_PATTERN)
        return patternNode(shape, paint, paintToUser, state, bitmaps);
    return itemOf(shape, gradientPaint(paint, paintToUser, state));
}

namespace {

/// `texel(x, y)`: straight, sRGB.
template <class Texel>
scene::Node imageItem(const Image& image, const scene::Affine& toPicture, const State& state,
                      Bitmaps& bitmaps, Texel&& texel) {
    const scene::Shape shape{rectangle(image.width(), image.height()), toPicture, scene::FillRule::NonZero};
    return itemOf(shape, scene::ImagePaint{bitmaps.add(bitmapOf(image.width(), image.height(), texel)),
                                           isSmooth(image, state) ? scene::ImageFilter::Trilinear
                                                                  : scene::ImageFilter::Nearest});
}

const Paint& plainPaint() {
    static const Paint plain;
    return plain;
}

scene::Affine placed(const CopyArea& area) { return scene::translation(area.dx, area.dy); }

}  // namespace

scene::Node painted(const Image& image, const scene::Affine& toPicture, const State& state,
                    Bitmaps& bitmaps) {
    return transformed(image, plainPaint(), toPicture, state, bitmaps);
}

scene::Node transformed(const Image& image, const Paint& paint, const scene::Affine& toPicture,
                        const State& state, Bitmaps& bitmaps) {
    const ColorTransform transform(paint);
    return imageItem(image, toPicture, state, bitmaps,
                     [&](int x, int y) { return texelOf(image, x, y, transform, state); });
}

scene::Node multiplied(const Image& image, Color color, const scene::Affine& toPicture, const State& state,
                       Bitmaps& bitmaps) {
    // The numbers of both, whatever they mean (section 10.8).
    const ColorSpace space{image.format().space.linear, false, false};
    return imageItem(image, toPicture, state, bitmaps, [&](int x, int y) {
        return finished(straightColor(image, x, y) * color, space, state);
    });
}

scene::Node alphaOf(const Image& image, const scene::Affine& toPicture, const State& state,
                    Bitmaps& bitmaps) {
    return imageItem(image, toPicture, state, bitmaps,
                     [&](int x, int y) { return Color(1, 1, 1, image.color(x, y).a); });
}

scene::Node opaque(const Image& image, const scene::Affine& toPicture, const State& state, Bitmaps& bitmaps) {
    const ColorTransform none(plainPaint());
    return imageItem(image, toPicture, state, bitmaps,
                     [&](int x, int y) { return Color(glm::vec3(texelOf(image, x, y, none, state)), 1); });
}

scene::ImagePaint storedPart(const Image& image, const CopyArea& area, Bitmaps& bitmaps) {
    ColorSpace space = image.format().space;
    space.premultiplied = false;
    const auto texel = [&](int x, int y) {
        return converted(straightColor(image, area.sx + x, area.sy + y), space, sRGBA);
    };
    return {bitmaps.add(bitmapOf(area.width, area.height, texel)), scene::ImageFilter::Nearest, placed(area)};
}

scene::ImagePaint storedPart(const MaskValues& values, const CopyArea& area, bool isRest, Bitmaps& bitmaps) {
    const auto texel = [&](int x, int y) {
        const float value = float(values.row(area.sy + y)[area.sx + x]) / 255;
        return Color(1, 1, 1, isRest ? 1 - value : value);
    };
    return {bitmaps.add(bitmapOf(area.width, area.height, texel)), scene::ImageFilter::Nearest, placed(area)};
}

bool isWhite(const Image& image) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (const Color c = straightColor(image, x, y); c.a > 0 && !(c.r == 1 && c.g == 1 && c.b == 1))
                return false;
    return true;
}

bool isOpaque(const scene::Node& node) {
    const auto* item = std::get_if<scene::Item>(&node.value);
    return item && isOpaque(item->paint);
}

}  // namespace vtm::openvg
