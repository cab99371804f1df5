#include "text/color/colr_table.hpp"

#include <cmath>
#include <numbers>

namespace vtm::text {
namespace {

/// Of the header.
constexpr std::size_t baseGlyphsField = 14, layersField = 18, clipsField = 22, headerSize = 34;

/// The last of `count` records whose first number, a glyph, is not above `glyph`; nothing if all are.
template <typename GlyphAt>
std::optional<std::size_t> lastUpTo(GlyphId glyph, std::size_t count, GlyphAt glyphAt) {
    std::size_t low = 0, high = count;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (glyphAt(middle) <= glyph)
            low = middle + 1;
        else
            high = middle;
    }
    return low > 0 ? std::optional(low - 1) : std::nullopt;
}

}  // namespace

std::optional<std::size_t> ColrTable::list(std::size_t field) const {
    if (table_.size() < headerSize || at(0).unsignedNumber(2) < 1)
        return std::nullopt;
    const std::size_t offset = at(field).unsignedNumber(4);
    return offset > 0 && offset < table_.size() ? std::optional(offset) : std::nullopt;
}

std::optional<std::size_t> ColrTable::paintOf(GlyphId glyph) const {
    constexpr std::size_t recordSize = 6;
    const auto base = list(baseGlyphsField);
    if (!base)
        return std::nullopt;
    const auto recordAt = [&](std::size_t i) { return at(*base + 4 + recordSize * i); };
    const auto found = lastUpTo(glyph, at(*base).unsignedNumber(4),
                                [&](std::size_t i) { return recordAt(i).unsignedNumber(2); });
    if (!found)
        return std::nullopt;
    TableCursor record = recordAt(*found);
    return record.unsignedNumber(2) == glyph ? std::optional(*base + record.unsignedNumber(4)) : std::nullopt;
}

std::optional<ClipBox> ColrTable::clipBoxOf(GlyphId glyph) const {
    constexpr std::size_t recordSize = 7;
    const auto clips = list(clipsField);
    if (!clips)
        return std::nullopt;
    const auto recordAt = [&](std::size_t i) { return at(*clips + 5 + recordSize * i); };
    const auto found = lastUpTo(glyph, at(*clips + 1).unsignedNumber(4),
                                [&](std::size_t i) { return recordAt(i).unsignedNumber(2); });
    if (!found)
        return std::nullopt;
    TableCursor record = recordAt(*found);
    record.unsignedNumber(2);
    if (glyph > record.unsignedNumber(2))
        return std::nullopt;
    TableCursor box = at(*clips + record.unsignedNumber(3) + 1);
    const int left = box.word(), bottom = box.word(), right = box.word(), top = box.word();
    return ClipBox{{left, -top}, {right, -bottom}};
}

std::optional<std::size_t> ColrTable::layer(std::uint32_t index) const {
    const auto layers = list(layersField);
    if (!layers || index >= at(*layers).unsignedNumber(4))
        return std::nullopt;
    return *layers + at(*layers + 4 + 4 * std::size_t(index)).unsignedNumber(4);
}

namespace {

using scene::Affine;
using scene::Point;

/// The table's angles count half turns.
constexpr double halfTurn = std::numbers::pi;

/// Fonts' matrices, turned y down.
Affine affine(double xx, double yx, double xy, double yy, double dx, double dy) {
    return {xx, -yx, -xy, yy, dx, -dy};
}

Affine around(const Affine& linear, Point center) {
    return scene::compose(scene::compose(scene::translation(center.x, center.y), linear),
                          scene::translation(-center.x, -center.y));
}

Affine readMatrix(TableCursor from) {
    const double xx = from.fixed(), yx = from.fixed(), xy = from.fixed(), yy = from.fixed();
    const double dx = from.fixed(), dy = from.fixed();
    return affine(xx, yx, xy, yy, dx, dy);
}

Affine readTranslation(TableCursor& from) {
    const Point by = readPoint(from);
    return scene::translation(by.x, by.y);
}

Affine readScale(TableCursor& from, bool isUniform) {
    const double x = from.fraction(), y = isUniform ? x : from.fraction();
    return scene::scaling(x, y);
}

Affine readRotation(TableCursor& from) {
    const double angle = from.fraction() * halfTurn, c = std::cos(angle), s = std::sin(angle);
    return affine(c, s, -s, c, 0, 0);
}

Affine readSkew(TableCursor& from) {
    const double x = std::tan(from.fraction() * halfTurn), y = std::tan(from.fraction() * halfTurn);
    return affine(1, y, -x, 1, 0, 0);
}

/// Nothing for other formats.
std::optional<Affine> readLinear(PaintFormat format, TableCursor& from) {
    switch (format) {
        case PaintFormat::Scale:
        case PaintFormat::ScaleAround:
            return readScale(from, false);
        case PaintFormat::ScaleUniform:
        case PaintFormat::ScaleUniformAround:
            return readScale(from, true);
        case PaintFormat::Rotate:
        case PaintFormat::RotateAround:
            return readRotation(from);
        case PaintFormat::Skew:
        case PaintFormat::SkewAround:
            return readSkew(from);
        default:
            return std::nullopt;
    }
}

bool hasCenter(PaintFormat format) {
    return format == PaintFormat::ScaleAround || format == PaintFormat::ScaleUniformAround ||
           format == PaintFormat::RotateAround || format == PaintFormat::SkewAround;
}

}  // namespace

Point readPoint(TableCursor& from) {
    const int x = from.word(), y = from.word();
    return {x, -y};
}

std::optional<Affine> readTransform(const ColrTable& table, PaintFormat format, std::size_t at,
                                    TableCursor from) {
    if (format == PaintFormat::Transform)
        return readMatrix(table.at(at + from.unsignedNumber(3)));
    if (format == PaintFormat::Translate)
        return readTranslation(from);
    const auto linear = readLinear(format, from);
    return linear && hasCenter(format) ? around(*linear, readPoint(from)) : linear;
}

}  // namespace vtm::text
