// What a filter's values may be.

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "scene/src/validate_values.hpp"

namespace vtm::scene {

namespace {

template <class... Numbers>
bool allFinite(Numbers... numbers) {
    return (std::isfinite(numbers) && ...);
}

bool areFinite(std::span<const float> numbers) {
    return std::ranges::all_of(numbers, [](float v) { return std::isfinite(v); });
}

/// Finite and not below zero.
template <class... Numbers>
bool areLengths(Numbers... numbers) {
    return ((std::isfinite(numbers) && numbers >= 0) && ...);
}

const char* where(bool holds, const char* fault) { return holds ? "" : fault; }

std::string operationFault(const BlendFilter& f) {
    return where(known(f.mode, BlendMode::PlusLighter), "blend mode is unknown");
}
std::string operationFault(const ColorMatrixFilter& f) {
    return where(areFinite(f.matrix), "matrix is not finite");
}
std::string operationFault(const ComponentTransferFilter& f) {
    for (const TransferFunction& function : f.functions) {
        if (!known(function.kind, TransferFunction::Kind::Gamma))
            return "transfer function is unknown";
        const bool isLinear = function.kind == TransferFunction::Kind::Linear,
                   isGamma = function.kind == TransferFunction::Kind::Gamma;
        if ((isLinear && function.values.size() != 2) || (isGamma && function.values.size() != 3))
            return "transfer function has the wrong number of values";
        if (!areFinite(function.values))
            return "transfer function is not finite";
    }
    return {};
}
std::string operationFault(const CompositeFilter& f) {
    return where(known(f.op, CompositeFilter::Operator::Arithmetic) && areFinite(f.k),
                 "operator is unknown, or a factor not finite");
}
std::string operationFault(const ConvolveMatrixFilter& f) {
    if (f.columns < 1 || f.rows < 1 || f.columns > maxKernel || f.rows > maxKernel ||
        f.columns * f.rows > maxKernel || f.kernel.size() != f.columns * f.rows)
        return fmt::format("kernel of {} x {} has {} entries", f.columns, f.rows, f.kernel.size());
    if (f.targetX >= f.columns || f.targetY >= f.rows)
        return "target lies outside the kernel";
    if (!known(f.edge, EdgeMode::None))
        return "edge mode is unknown";
    return where(areFinite(f.kernel) && allFinite(f.divisor, f.bias) && f.divisor != 0,
                 "kernel, divisor or bias is not finite, or the divisor zero");
}
std::string lightFault(const DistantLight& l) {
    return where(allFinite(l.azimuth, l.elevation), "light is not finite");
}
std::string lightFault(const PointLight& l) { return where(areFinite(l.position), "light is not finite"); }
std::string lightFault(const SpotLight& l) {
    return where(areFinite(l.position) && areFinite(l.pointsAt) && allFinite(l.exponent, l.coneAngle),
                 "light is not finite");
}
std::string operationFault(const LightingFilter& f) {
    if (!allFinite(f.surfaceScale, f.exponent) || !areLengths(f.constant))
        return "lighting is not finite, or its constant below zero";
    if (std::string wrong = fault(f.color); !wrong.empty())
        return wrong;
    return std::visit([](const auto& light) { return lightFault(light); }, f.light);
}
std::string operationFault(const DisplacementMapFilter& f) {
    return where(allFinite(f.scale) && known(f.x, Channel::A) && known(f.y, Channel::A),
                 "scale is not finite, or a channel unknown");
}
std::string operationFault(const DropShadowFilter& f) {
    if (!allFinite(f.dx, f.dy) || !areLengths(f.deviationX, f.deviationY))
        return "shadow is not finite, or a deviation below zero";
    return fault(f.color);
}
std::string operationFault(const FloodFilter& f) { return fault(f.color); }
std::string operationFault(const GaussianBlurFilter& f) {
    return where(areLengths(f.deviationX, f.deviationY), "a deviation is not finite or below zero");
}
std::string operationFault(const PictureFilter&) { return {}; }
std::string operationFault(const MergeFilter&) { return {}; }
std::string operationFault(const MorphologyFilter& f) {
    return where(areLengths(f.radiusX, f.radiusY), "a radius is not finite or below zero");
}
std::string operationFault(const OffsetFilter& f) {
    return where(allFinite(f.dx, f.dy), "offset is not finite");
}
std::string operationFault(const TileFilter&) { return {}; }
std::string operationFault(const TurbulenceFilter& f) {
    if (!areLengths(f.frequencyX, f.frequencyY))
        return "a frequency is not finite or below zero";
    return where(f.octaves >= 0 && f.octaves <= maxOctaves, "number of octaves is out of range");
}

template <class Operation>
inline constexpr std::size_t inputCount = 1;
template <>
inline constexpr std::size_t inputCount<BlendFilter> = 2;
template <>
inline constexpr std::size_t inputCount<CompositeFilter> = 2;
template <>
inline constexpr std::size_t inputCount<DisplacementMapFilter> = 2;
template <>
inline constexpr std::size_t inputCount<FloodFilter> = 0;
template <>
inline constexpr std::size_t inputCount<PictureFilter> = 0;
template <>
inline constexpr std::size_t inputCount<TurbulenceFilter> = 0;

template <class Operation>
bool hasInputs(const Operation&, std::size_t count) {
    return std::is_same_v<Operation, MergeFilter> || count == inputCount<Operation>;
}

bool isBox(Point min, Point max) { return finite(min) && finite(max) && max.x >= min.x && max.y >= min.y; }

std::string primitiveFault(const FilterPrimitive& primitive, std::size_t index) {
    if (!isBox(primitive.min, primitive.max))
        return "subregion is not finite, or its sides are below zero";
    if (!std::visit([&](const auto& f) { return hasInputs(f, primitive.inputs.size()); },
                    primitive.operation))
        return fmt::format("operation has {} inputs", primitive.inputs.size());
    for (const FilterInput& input : primitive.inputs)
        if (!known(input.kind, FilterInput::Kind::Result) ||
            (input.kind == FilterInput::Kind::Result && input.result >= index))
            return "reads the result of a later primitive";
    return std::visit([](const auto& f) { return operationFault(f); }, primitive.operation);
}

}  // namespace

std::string fault(const Filter& f) {
    if (!inverse(f.transform))
        return "filter's transform is not finite or flattens the plane";
    if (!isBox(f.min, f.max))
        return "filter region is not finite, or its sides are below zero";
    if (f.primitives.empty() || f.primitives.size() > maxPrimitives)
        return fmt::format("filter has {} primitives, not 1 to {}", f.primitives.size(), maxPrimitives);
    for (std::size_t i = 0; i < f.primitives.size(); ++i)
        if (const std::string wrong = primitiveFault(f.primitives[i], i); !wrong.empty())
            return fmt::format("filter primitive {}: {}", i, wrong);
    return {};
}

}  // namespace vtm::scene
