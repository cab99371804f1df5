// Filter primitives: attributes in, operations out. Source: Filter Effects Module Level 1, section 9.

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "svg/convert/filter.hpp"
#include "svg/convert/filter_matrix.hpp"
#include "svg/css/property_values.hpp"

namespace vtm::svg {

using scene::FilterOperation;

double PrimitiveUnits::length(double v) const {
    return ofBox ? v * std::sqrt((box.width() * box.width() + box.height() * box.height()) / 2) : v;
}

std::optional<std::vector<double>> parseNumbers(std::string_view text) {
    std::vector<double> numbers;
    Cursor cursor(text);
    for (cursor.skipSpaces(); !cursor.atEnd(); cursor.skipCommaSpaces()) {
        const auto number = cursor.number();
        if (!number)
            return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

double numberOf(const Element& element, std::string_view name, double fallback) {
    const auto numbers = parseNumbers(element.get(name));
    return numbers && numbers->size() == 1 ? numbers->front() : fallback;
}

namespace {

/// What makes an operation of an element.
struct Source {
    const Element& element;
    const Style& style;
    const PrimitiveUnits& units;
    bool& isFailed;

    double number(std::string_view name, double fallback) const { return numberOf(element, name, fallback); }
    float asFloat(std::string_view name, double fallback) const {
        return static_cast<float>(number(name, fallback));
    }
    FilterOperation failed() const {
        isFailed = true;
        return scene::FloodFilter{{0, 0, 0, 0}};
    }
    template <class T, std::size_t N>
    T keyword(std::string_view name, const Keyword<T> (&table)[N], T fallback) const {
        return findKeyword(trim(element.get(name)), table).value_or(fallback);
    }
};

/// One or two numbers, the second like the first; nothing if there are others.
std::optional<std::pair<double, double>> numberPair(std::string_view text) {
    const auto numbers = parseNumbers(text);
    if (!numbers || numbers->empty() || numbers->size() > 2)
        return std::nullopt;
    return std::pair(numbers->front(), numbers->back());
}

scene::Color floodColor(const Style& style) {
    scene::Color color = resolveColor(style.floodColor, style);
    color.a *= static_cast<float>(style.floodOpacity);
    return color;
}

/// Deviations below zero, and lists that are no deviations, blur nothing.
std::pair<float, float> deviations(const Source& s, double fallback) {
    const auto text = s.element.find("stdDeviation");
    const auto pair = text ? numberPair(*text).value_or(std::pair(0.0, 0.0)) : std::pair(fallback, fallback);
    if (pair.first < 0 || pair.second < 0)
        return {0.0f, 0.0f};
    return {static_cast<float>(s.units.x(pair.first)), static_cast<float>(s.units.y(pair.second))};
}

// ---- Colours --------------------------------------------------------------------------------------

FilterOperation blend(const Source& s) {
    const auto mode = parseBlend(trim(s.element.get("mode")), {});
    return scene::BlendFilter{mode.value_or(scene::BlendMode::Normal)};
}

FilterOperation colorMatrix(const Source& s) {
    const std::string_view type = trim(s.element.get("type"));
    const auto values = parseNumbers(s.element.get("values"));
    const auto single = values && values->size() == 1 ? std::optional(values->front()) : std::nullopt;
    if (type == "saturate")
        return saturateMatrix(std::max(single.value_or(1), 0.0));
    if (type == "hueRotate")
        return hueRotateMatrix(single.value_or(0));
    if (type == "luminanceToAlpha")
        return luminanceToAlphaMatrix();
    if (!values || values->size() != 20)
        return matrixOf({1, 0, 0, 0, 1, 0, 0, 0, 1});
    scene::ColorMatrixFilter filter;
    std::ranges::transform(*values, filter.matrix.begin(), [](double v) { return static_cast<float>(v); });
    return filter;
}

scene::TransferFunction transferFunction(const Element& element) {
    using Kind = scene::TransferFunction::Kind;
    const std::string_view type = trim(element.get("type"));
    const auto number = [&](std::string_view name, double fallback) {
        return static_cast<float>(numberOf(element, name, fallback));
    };
    if (type == "linear")
        return {Kind::Linear, {number("slope", 1), number("intercept", 0)}};
    if (type == "gamma")
        return {Kind::Gamma, {number("amplitude", 1), number("exponent", 1), number("offset", 0)}};
    if (type != "table" && type != "discrete")
        return {};
    scene::TransferFunction function{type == "table" ? Kind::Table : Kind::Discrete, {}};
    for (const double v : parseNumbers(element.get("tableValues")).value_or(std::vector<double>{}))
        function.values.push_back(static_cast<float>(v));
    return function;
}

/// Of several functions for a channel the last one counts.
FilterOperation componentTransfer(const Source& s) {
    scene::ComponentTransferFilter filter;
    constexpr std::array<std::string_view, 4> names{"feFuncR", "feFuncG", "feFuncB", "feFuncA"};
    for (const Element* child : s.element.children) {
        const auto name = std::ranges::find(names, child->name);
        if (child->tag == Tag::FilterPrimitive && name != names.end())
            filter.functions[std::size_t(name - names.begin())] = transferFunction(*child);
    }
    return filter;
}

FilterOperation composite(const Source& s) {
    using Operator = scene::CompositeFilter::Operator;
    static constexpr Keyword<Operator> operators[]{{"over", Operator::Over},
                                                   {"in", Operator::In},
                                                   {"out", Operator::Out},
                                                   {"atop", Operator::Atop},
                                                   {"xor", Operator::Xor},
                                                   {"lighter", Operator::Lighter},
                                                   {"arithmetic", Operator::Arithmetic}};
    scene::CompositeFilter filter;
    filter.op = s.keyword("operator", operators, Operator::Over);
    filter.k = {s.asFloat("k1", 0), s.asFloat("k2", 0), s.asFloat("k3", 0), s.asFloat("k4", 0)};
    return filter;
}

FilterOperation flood(const Source& s) { return scene::FloodFilter{floodColor(s.style)}; }

// ---- Neighbours -----------------------------------------------------------------------------------

FilterOperation gaussianBlur(const Source& s) {
    const auto [x, y] = deviations(s, 0);
    return scene::GaussianBlurFilter{x, y};
}

FilterOperation dropShadow(const Source& s) {
    const auto [x, y] = deviations(s, 2);
    return scene::DropShadowFilter{static_cast<float>(s.units.x(s.number("dx", 2))),
                                   static_cast<float>(s.units.y(s.number("dy", 2))), x, y,
                                   floodColor(s.style)};
}

bool isWhole(double v) { return v == std::floor(v); }

/// The sum of the entries, or 1 where that is zero but for what decimals leave.
double defaultDivisor(const std::vector<double>& kernel) {
    constexpr double rounding = 1e-9;
    double sum = 0, magnitude = 0;
    for (const double v : kernel) {
        sum += v;
        magnitude += std::abs(v);
    }
    return std::abs(sum) <= rounding * magnitude ? 1 : sum;
}

/// The specification's errors make the primitive transparent black.
FilterOperation convolve(const Source& s) {
    scene::ConvolveMatrixFilter filter;
    const auto order = s.element.find("order") ? numberPair(s.element.get("order")) : std::pair(3.0, 3.0);
    const auto isOrder = [](double v) { return v >= 1 && v <= double(scene::maxKernel) && isWhole(v); };
    if (!order || !isOrder(order->first) || !isOrder(order->second))
        return s.failed();
    filter.columns = std::size_t(order->first);
    filter.rows = std::size_t(order->second);
    const auto kernel = parseNumbers(s.element.get("kernelMatrix"));
    if (filter.columns * filter.rows > scene::maxKernel || !kernel ||
        kernel->size() != filter.columns * filter.rows)
        return s.failed();
    for (const double v : *kernel)
        filter.kernel.push_back(static_cast<float>(v));
    const double divisor = s.number("divisor", defaultDivisor(*kernel));
    filter.divisor = static_cast<float>(divisor);
    if (filter.divisor == 0)
        return s.failed();
    filter.bias = s.asFloat("bias", 0);
    const auto target = [&](std::string_view name, std::size_t size) -> std::optional<std::size_t> {
        const double v = s.number(name, double(size / 2));
        return v >= 0 && v < double(size) && isWhole(v) ? std::optional(std::size_t(v)) : std::nullopt;
    };
    const auto x = target("targetX", filter.columns), y = target("targetY", filter.rows);
    if (!x || !y)
        return s.failed();
    filter.targetX = *x;
    filter.targetY = *y;
    static constexpr Keyword<scene::EdgeMode> edges[]{{"duplicate", scene::EdgeMode::Duplicate},
                                                      {"wrap", scene::EdgeMode::Wrap},
                                                      {"none", scene::EdgeMode::None}};
    filter.edge = s.keyword("edgeMode", edges, scene::EdgeMode::Duplicate);
    filter.preserveAlpha = trim(s.element.get("preserveAlpha")) == "true";
    return filter;
}

/// Browsers take a radius that is zero, absent or in error for 1; the specification would switch the effect
/// off.
FilterOperation morphology(const Source& s) {
    auto pair = numberPair(s.element.get("radius")).value_or(std::pair(0.0, 0.0));
    if (pair.first < 0 || pair.second < 0)
        pair = {0.0, 0.0};
    const auto radius = [](double written, double inUnits) {
        return static_cast<float>(written == 0 ? 1 : inUnits);
    };
    scene::MorphologyFilter filter;
    filter.radiusX = radius(pair.first, s.units.x(pair.first));
    filter.radiusY = radius(pair.second, s.units.y(pair.second));
    filter.dilate = trim(s.element.get("operator")) == "dilate";
    return filter;
}

// ---- Places ---------------------------------------------------------------------------------------

FilterOperation offset(const Source& s) {
    return scene::OffsetFilter{static_cast<float>(s.units.x(s.number("dx", 0))),
                               static_cast<float>(s.units.y(s.number("dy", 0)))};
}

FilterOperation displacementMap(const Source& s) {
    static constexpr Keyword<scene::Channel> channels[]{{"R", scene::Channel::R},
                                                        {"G", scene::Channel::G},
                                                        {"B", scene::Channel::B},
                                                        {"A", scene::Channel::A}};
    return scene::DisplacementMapFilter{static_cast<float>(s.units.length(s.number("scale", 0))),
                                        s.keyword("xChannelSelector", channels, scene::Channel::A),
                                        s.keyword("yChannelSelector", channels, scene::Channel::A)};
}

FilterOperation turbulence(const Source& s) {
    scene::TurbulenceFilter filter;
    const auto frequency = numberPair(s.element.get("baseFrequency")).value_or(std::pair(0.0, 0.0));
    if (frequency.first < 0 || frequency.second < 0)
        return s.failed();
    filter.frequencyX = static_cast<float>(frequency.first);
    filter.frequencyY = static_cast<float>(frequency.second);
    const double octaves = s.number("numOctaves", 1);
    filter.octaves = octaves > 0 ? int(std::min(octaves, double(scene::maxOctaves))) : 0;
    constexpr double largestSeed = 2147483647;
    filter.seed = int(std::clamp(std::trunc(s.number("seed", 0)), -largestSeed, largestSeed));
    filter.stitch = trim(s.element.get("stitchTiles")) == "stitch";
    filter.fractalNoise = trim(s.element.get("type")) == "fractalNoise";
    return filter;
}

// ---- Light ----------------------------------------------------------------------------------------

std::array<float, 3> lightPoint(const Element& light, const PrimitiveUnits& units, std::string_view x,
                                std::string_view y, std::string_view z) {
    return {static_cast<float>(units.placeX(numberOf(light, x, 0))),
            static_cast<float>(units.placeY(numberOf(light, y, 0))),
            static_cast<float>(units.length(numberOf(light, z, 0)))};
}

/// The first light source among the children.
std::optional<decltype(scene::LightingFilter::light)> lightOf(const Source& s) {
    for (const Element* child : s.element.children) {
        if (child->tag != Tag::FilterPrimitive)
            continue;
        const auto number = [&](std::string_view name, double fallback) {
            return static_cast<float>(numberOf(*child, name, fallback));
        };
        if (child->name == "feDistantLight")
            return scene::DistantLight{number("azimuth", 0), number("elevation", 0)};
        if (child->name == "fePointLight")
            return scene::PointLight{lightPoint(*child, s.units, "x", "y", "z")};
        if (child->name == "feSpotLight") {
            scene::SpotLight light;
            light.position = lightPoint(*child, s.units, "x", "y", "z");
            light.pointsAt = lightPoint(*child, s.units, "pointsAtX", "pointsAtY", "pointsAtZ");
            light.exponent = number("specularExponent", 1);
            if (light.exponent <= 0)
                light.exponent = 1;
            light.coneAngle = number("limitingConeAngle", 180);
            return light;
        }
    }
    return std::nullopt;
}

FilterOperation lighting(const Source& s) {
    scene::LightingFilter filter;
    const auto light = lightOf(s);
    filter.specular = s.element.name == "feSpecularLighting";
    filter.constant = s.asFloat(filter.specular ? "specularConstant" : "diffuseConstant", 1);
    filter.exponent = s.asFloat("specularExponent", 1);
    constexpr float smallestExponent = 1, largestExponent = 128;
    if (!light ||
        (filter.specular && !(filter.exponent >= smallestExponent && filter.exponent <= largestExponent)))
        return s.failed();
    filter.constant = std::max(filter.constant, 0.0f);
    filter.surfaceScale = s.asFloat("surfaceScale", 1);
    filter.color = resolveColor(s.style.lightingColor, s.style);
    filter.light = *light;
    return filter;
}

using Reader = FilterOperation (*)(const Source&);

const std::unordered_map<std::string_view, Reader>& readers() {
    static const std::unordered_map<std::string_view, Reader> table{
        {"feBlend", blend},
        {"feColorMatrix", colorMatrix},
        {"feComponentTransfer", componentTransfer},
        {"feComposite", composite},
        {"feConvolveMatrix", convolve},
        {"feDiffuseLighting", lighting},
        {"feDisplacementMap", displacementMap},
        {"feDropShadow", dropShadow},
        {"feFlood", flood},
        {"feGaussianBlur", gaussianBlur},
        {"feMerge", [](const Source&) -> FilterOperation { return scene::MergeFilter{}; }},
        {"feMorphology", morphology},
        {"feOffset", offset},
        {"feSpecularLighting", lighting},
        {"feTile", [](const Source&) -> FilterOperation { return scene::TileFilter{}; }},
        {"feTurbulence", turbulence}};
    return table;
}

}  // namespace

std::optional<FilterOperation> filterOperation(const Element& element, const Style& style,
                                               const PrimitiveUnits& units, bool& isFailed) {
    const auto reader = readers().find(element.name);
    if (reader == readers().end())
        return std::nullopt;
    return reader->second({element, style, units, isFailed});
}

std::optional<std::size_t> inputCount(const FilterOperation& operation) {
    if (std::holds_alternative<scene::MergeFilter>(operation))
        return std::nullopt;
    if (std::holds_alternative<scene::FloodFilter>(operation) ||
        std::holds_alternative<scene::PictureFilter>(operation) ||
        std::holds_alternative<scene::TurbulenceFilter>(operation))
        return 0;
    const bool hasTwo = std::holds_alternative<scene::BlendFilter>(operation) ||
                        std::holds_alternative<scene::CompositeFilter>(operation) ||
                        std::holds_alternative<scene::DisplacementMapFilter>(operation);
    return hasTwo ? 2 : 1;
}

}  // namespace vtm::svg
