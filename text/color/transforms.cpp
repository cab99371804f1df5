#include "text/color/transforms.hpp"

#include <cmath>
#include <numbers>

namespace vtm::text {
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
