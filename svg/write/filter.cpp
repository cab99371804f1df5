// Filters. Their lengths are in the space of the element that has the filter: a group with the filter's
// transform, around one with its inverse.

#include <array>

#include <fmt/format.h>

#include "svg/write/values.hpp"
#include "svg/write/writer.hpp"

namespace vtm::svg {

using namespace scene;

namespace {

template <class Numbers>
std::string list(const Numbers& numbers) {
    std::string text;
    for (const auto v : numbers)
        text += (text.empty() ? "" : " ") + number(v);
    return text;
}

std::string numbered(std::string_view name, float value) { return attribute(name, number(value)); }

std::string channel(Channel c) { return std::string(1, "RGBA"[int(c)]); }

std::string region(Point min, Point max) {
    return attribute("x", number(min.x)) + attribute("y", number(min.y)) +
           attribute("width", number(max.x - min.x)) + attribute("height", number(max.y - min.y));
}

std::string flood(const Color& c) {
    return attribute("flood-color", hex(c)) + opacityAttribute("flood-opacity", c.a);
}

std::string transferText(std::string_view tag, const TransferFunction& f) {
    using Kind = TransferFunction::Kind;
    const bool isIdentity = (f.kind == Kind::Table || f.kind == Kind::Discrete) && f.values.empty();
    if (isIdentity)
        return "";
    std::string text = fmt::format("<{}", tag);
    switch (f.kind) {
        case Kind::Table:
            text += attribute("type", "table") + attribute("tableValues", list(f.values));
            break;
        case Kind::Discrete:
            text += attribute("type", "discrete") + attribute("tableValues", list(f.values));
            break;
        case Kind::Linear:
            text += attribute("type", "linear") + numbered("slope", f.values[0]) +
                    numbered("intercept", f.values[1]);
            break;
        case Kind::Gamma:
            text += attribute("type", "gamma") + numbered("amplitude", f.values[0]) +
                    numbered("exponent", f.values[1]) + numbered("offset", f.values[2]);
            break;
    }
    return text + "/>";
}

struct LightText {
    std::string operator()(const DistantLight& l) const {
        return "<feDistantLight" + numbered("azimuth", l.azimuth) + numbered("elevation", l.elevation) + "/>";
    }
    std::string operator()(const PointLight& l) const {
        return "<fePointLight" + place("", l.position) + "/>";
    }
    std::string operator()(const SpotLight& l) const {
        return "<feSpotLight" + place("", l.position) + place("pointsAt", l.pointsAt) +
               numbered("specularExponent", l.exponent) +
               (l.coneAngle == 180 ? "" : numbered("limitingConeAngle", l.coneAngle)) + "/>";
    }

private:
    static std::string place(const std::string& prefix, const std::array<float, 3>& p) {
        const bool isPlain = prefix.empty();
        return numbered(isPlain ? "x" : prefix + "X", p[0]) + numbered(isPlain ? "y" : prefix + "Y", p[1]) +
               numbered(isPlain ? "z" : prefix + "Z", p[2]);
    }
};

/// A primitive without its inputs and its region.
struct PrimitiveText {
    std::string tag, attributes{}, content{};
};

struct OperationText {
    PrimitiveText operator()(const BlendFilter& f) const {
        return {"feBlend", attribute("mode", nameOf(f.mode))};
    }
    PrimitiveText operator()(const ColorMatrixFilter& f) const {
        return {"feColorMatrix", attribute("values", list(f.matrix))};
    }
    PrimitiveText operator()(const ComponentTransferFilter& f) const {
        return {"feComponentTransfer", "",
                transferText("feFuncR", f.functions[0]) + transferText("feFuncG", f.functions[1]) +
                    transferText("feFuncB", f.functions[2]) + transferText("feFuncA", f.functions[3])};
    }
    PrimitiveText operator()(const CompositeFilter& f) const {
        constexpr std::array names{"over", "in", "out", "atop", "xor", "lighter", "arithmetic"};
        std::string attributes = attribute("operator", names[std::size_t(f.op)]);
        if (f.op == CompositeFilter::Operator::Arithmetic)
            attributes += numbered("k1", f.k[0]) + numbered("k2", f.k[1]) + numbered("k3", f.k[2]) +
                          numbered("k4", f.k[3]);
        return {"feComposite", attributes};
    }
    PrimitiveText operator()(const ConvolveMatrixFilter& f) const {
        constexpr std::array edges{"duplicate", "wrap", "none"};
        return {"feConvolveMatrix", attribute("order", fmt::format("{} {}", f.columns, f.rows)) +
                                        attribute("kernelMatrix", list(f.kernel)) +
                                        numbered("divisor", f.divisor) + numbered("bias", f.bias) +
                                        attribute("targetX", fmt::format("{}", f.targetX)) +
                                        attribute("targetY", fmt::format("{}", f.targetY)) +
                                        attribute("edgeMode", edges[std::size_t(f.edge)]) +
                                        (f.preserveAlpha ? attribute("preserveAlpha", "true") : "")};
    }
    PrimitiveText operator()(const LightingFilter& f) const {
        const std::string attributes =
            numbered("surfaceScale", f.surfaceScale) + attribute("lighting-color", hex(f.color));
        const std::string light = std::visit(LightText{}, f.light);
        if (f.specular)
            return {"feSpecularLighting",
                    attributes + numbered("specularConstant", f.constant) +
                        numbered("specularExponent", f.exponent),
                    light};
        return {"feDiffuseLighting", attributes + numbered("diffuseConstant", f.constant), light};
    }
    PrimitiveText operator()(const DisplacementMapFilter& f) const {
        return {"feDisplacementMap", numbered("scale", f.scale) +
                                         attribute("xChannelSelector", channel(f.x)) +
                                         attribute("yChannelSelector", channel(f.y))};
    }
    PrimitiveText operator()(const DropShadowFilter& f) const {
        return {"feDropShadow", numbered("dx", f.dx) + numbered("dy", f.dy) +
                                    attribute("stdDeviation", pair({f.deviationX, f.deviationY})) +
                                    flood(f.color)};
    }
    PrimitiveText operator()(const FloodFilter& f) const { return {"feFlood", flood(f.color)}; }
    PrimitiveText operator()(const GaussianBlurFilter& f) const {
        return {"feGaussianBlur", attribute("stdDeviation", pair({f.deviationX, f.deviationY}))};
    }
    PrimitiveText operator()(const PictureFilter&) const { return {"feImage"}; }
    PrimitiveText operator()(const MergeFilter&) const { return {"feMerge"}; }
    PrimitiveText operator()(const MorphologyFilter& f) const {
        return {"feMorphology", attribute("operator", f.dilate ? "dilate" : "erode") +
                                    attribute("radius", pair({f.radiusX, f.radiusY}))};
    }
    PrimitiveText operator()(const OffsetFilter& f) const {
        return {"feOffset", numbered("dx", f.dx) + numbered("dy", f.dy)};
    }
    PrimitiveText operator()(const TileFilter&) const { return {"feTile"}; }
    PrimitiveText operator()(const TurbulenceFilter& f) const {
        return {"feTurbulence", attribute("baseFrequency", pair({f.frequencyX, f.frequencyY})) +
                                    attribute("numOctaves", fmt::format("{}", f.octaves)) +
                                    attribute("seed", fmt::format("{}", f.seed)) +
                                    (f.stitch ? attribute("stitchTiles", "stitch") : "") +
                                    (f.fractalNoise ? attribute("type", "fractalNoise") : "")};
    }
};

std::string nameOf(const FilterInput& input) {
    switch (input.kind) {
        case FilterInput::Kind::SourceGraphic:
            return "SourceGraphic";
        case FilterInput::Kind::SourceAlpha:
            return "SourceAlpha";
        case FilterInput::Kind::Result:
            break;
    }
    return fmt::format("r{}", input.result);
}

}  // namespace

std::string Writer::filter(const Filter& filter) {
    const Affine toUser = *inverse(filter.transform);
    std::string text = attribute("filterUnits", "userSpaceOnUse") + region(filter.min, filter.max) + ">\n";
    for (std::size_t i = 0; i < filter.primitives.size(); ++i) {
        limits::check();
        const FilterPrimitive& primitive = filter.primitives[i];
        PrimitiveText written = std::visit(OperationText{}, primitive.operation);
        if (const auto* picture = std::get_if<PictureFilter>(&primitive.operation)) {
            const Part& content = shared(picture->content);
            const Affine moved = compose(translation(-primitive.min.x, -primitive.min.y), toUser);
            written.attributes =
                attribute("href", "#" + definitions_.add("g", transformAttribute("transform", moved) + ">\n" +
                                                                  content.text + "</g>"));
        } else if (std::holds_alternative<MergeFilter>(primitive.operation)) {
            for (const FilterInput& input : primitive.inputs)
                written.content += "<feMergeNode" + attribute("in", nameOf(input)) + "/>";
        } else {
            constexpr std::array names{"in", "in2"};
            for (std::size_t k = 0; k < primitive.inputs.size(); ++k)
                written.attributes += attribute(names[k], nameOf(primitive.inputs[k]));
        }
        text += "<" + written.tag + written.attributes + region(primitive.min, primitive.max) +
                (primitive.linear ? "" : attribute("color-interpolation-filters", "sRGB")) +
                attribute("result", fmt::format("r{}", i)) +
                (written.content.empty() ? "/>\n" : ">" + written.content + "</" + written.tag + ">\n");
    }
    return reference("filter", definitions_.add("filter", text + "</filter>"));
}

/// What a filter makes of what has been written.
Writer::Part Writer::filtered(const Filter& made, const Part& source) {
    const Affine& transform = made.transform;
    const std::string inner =
        transform == identity
            ? source.text
            : "<g" + transformAttribute("transform", *inverse(transform)) + ">\n" + source.text + "</g>\n";
    Part part;
    part.text = "<g" + transformAttribute("transform", transform) + filter(made) + ">\n" + inner + "</g>\n";
    part.box = geometry::mapped(Box{made.min, made.max}, transform);
    return part;
}

}  // namespace vtm::svg
