// Filter functions as primitives. Source: Filter Effects Module Level 1, section 13.

#include "svg/convert/filter.hpp"
#include "svg/convert/filter_matrix.hpp"

namespace vtm::svg {
namespace {

using Kind = FilterFunction::Kind;
using scene::ColorMatrixFilter;
using scene::ComponentTransferFilter;
using scene::TransferFunction;

/// The same function of red, green and blue.
ComponentTransferFilter ofColors(const TransferFunction& function) {
    return {{function, function, function, TransferFunction{}}};
}

TransferFunction linear(double slope, double intercept) {
    return {TransferFunction::Kind::Linear, {static_cast<float>(slope), static_cast<float>(intercept)}};
}

TransferFunction table(double first, double last) {
    return {TransferFunction::Kind::Table, {static_cast<float>(first), static_cast<float>(last)}};
}

ColorMatrixFilter sepia(double amount) {
    const double rest = 1 - amount;
    return matrixOf({0.393 + 0.607 * rest, 0.769 - 0.769 * rest, 0.189 - 0.189 * rest, 0.349 - 0.349 * rest,
                     0.686 + 0.314 * rest, 0.168 - 0.168 * rest, 0.272 - 0.272 * rest, 0.534 - 0.534 * rest,
                     0.131 + 0.869 * rest});
}

scene::FilterOperation operationOf(const FilterFunction& f, const scene::Color& color) {
    switch (f.kind) {
        case Kind::Blur:
            return scene::GaussianBlurFilter{static_cast<float>(f.deviation),
                                             static_cast<float>(f.deviation)};
        case Kind::Brightness:
            return ofColors(linear(f.amount, 0));
        case Kind::Contrast:
            return ofColors(linear(f.amount, 0.5 - 0.5 * f.amount));
        case Kind::DropShadow:
            return scene::DropShadowFilter{static_cast<float>(f.x), static_cast<float>(f.y),
                                           static_cast<float>(f.deviation), static_cast<float>(f.deviation),
                                           color};
        case Kind::Grayscale:
            return grayscaleMatrix(f.amount);
        case Kind::HueRotate:
            return hueRotateMatrix(f.amount);
        case Kind::Invert:
            return ofColors(table(f.amount, 1 - f.amount));
        case Kind::Opacity:
            return ComponentTransferFilter{
                {TransferFunction{}, TransferFunction{}, TransferFunction{}, table(0, f.amount)}};
        case Kind::Saturate:
            return saturateMatrix(f.amount);
        case Kind::Sepia:
            break;
    }
    return sepia(f.amount);
}

/// Beyond every picture.
constexpr double everything = 0x1p30;

}  // namespace

scene::Filter filterOf(const FilterFunction& function, const scene::Color& color,
                       const scene::Affine& transform) {
    scene::Filter filter;
    filter.transform = transform;
    filter.min = scene::Point(-everything);
    filter.max = scene::Point(everything);
    filter.primitives.push_back(
        {operationOf(function, color), {scene::FilterInput{}}, filter.min, filter.max, false});
    return filter;
}

}  // namespace vtm::svg
