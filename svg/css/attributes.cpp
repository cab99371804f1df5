#include "svg/css/attributes.hpp"

#include <algorithm>
#include <unordered_map>

#include "svg/css/length.hpp"
#include "svg/geometry/transform.hpp"

namespace vtm::svg {
namespace {

// ---- Kinds of values ------------------------------------------------------------------------------

bool isLength(std::string_view text) { return isAnyLength(text, {}); }
bool isLengthOrAuto(std::string_view text) { return isLength(text) || equalsIgnoringCase(text, "auto"); }

bool isSize(std::string_view text) { return isNotNegative(text, {}); }
bool isRadius(std::string_view text) { return isSize(text) || equalsIgnoringCase(text, "auto"); }

template <std::size_t N>
bool isOneOf(std::string_view text, const std::string_view (&words)[N]) {
    return std::find(std::begin(words), std::end(words), text) != std::end(words);
}

bool isReferenceX(std::string_view text) {
    return isLength(text) || isOneOf(text, {"left", "center", "right"});
}
bool isReferenceY(std::string_view text) {
    return isLength(text) || isOneOf(text, {"top", "center", "bottom"});
}
bool isUnits(std::string_view text) { return isOneOf(text, {"userSpaceOnUse", "objectBoundingBox"}); }
bool isMarkerUnits(std::string_view text) { return isOneOf(text, {"userSpaceOnUse", "strokeWidth"}); }
bool isSpread(std::string_view text) { return isOneOf(text, {"pad", "reflect", "repeat"}); }

bool isOrientation(std::string_view text) {
    Cursor cursor(text);
    return isOneOf(text, {"auto", "auto-start-reverse"}) || (readAngle(cursor) && cursor.atEnd());
}

bool isFraction(std::string_view text) { return parseFraction(text).has_value(); }
bool isViewBox(std::string_view text) { return parseViewBox(text) || isEmptyViewBox(text); }
bool isAspectRatio(std::string_view text) { return readAspectRatio(text).has_value(); }

// ---- Elements -------------------------------------------------------------------------------------

struct Kind {
    std::string_view name;
    bool (*holds)(std::string_view);
};
using Kinds = std::vector<Kind>;

const std::unordered_map<Tag, Kinds>& kindsByTag() {
    static const std::unordered_map<Tag, Kinds> table = [] {
        const Kinds place{{"x", isLength}, {"y", isLength}};
        const Kinds size{{"width", isLengthOrAuto}, {"height", isLengthOrAuto}};
        const Kinds center{{"cx", isLength}, {"cy", isLength}};
        const Kinds radii{{"rx", isRadius}, {"ry", isRadius}};
        const Kinds ends{{"x1", isLength}, {"y1", isLength}, {"x2", isLength}, {"y2", isLength}};
        const Kinds box{{"viewBox", isViewBox}, {"preserveAspectRatio", isAspectRatio}};
        const Kinds length{{"pathLength", isSize}};
        const Kinds gradient{{"gradientUnits", isUnits}, {"spreadMethod", isSpread}};
        const auto all = [](std::initializer_list<Kinds> parts) {
            Kinds kinds;
            for (const Kinds& part : parts)
                kinds.insert(kinds.end(), part.begin(), part.end());
            return kinds;
        };
        return std::unordered_map<Tag, Kinds>{
            {Tag::Svg, all({place, size, box})},
            {Tag::Symbol, all({place, size, box, {{"refX", isReferenceX}, {"refY", isReferenceY}}})},
            {Tag::Use, all({place, size})},
            {Tag::Image, all({place, size, {{"preserveAspectRatio", isAspectRatio}}})},
            {Tag::Rect, all({place, size, radii, length})},
            {Tag::Circle, all({center, {{"r", isLength}}, length})},
            {Tag::Ellipse, all({center, radii, length})},
            {Tag::Line, all({ends, length})},
            {Tag::Polyline, length},
            {Tag::Polygon, length},
            {Tag::Path, length},
            {Tag::LinearGradient, all({ends, gradient})},
            {Tag::RadialGradient,
             all({center, gradient, {{"r", isSize}, {"fx", isLength}, {"fy", isLength}, {"fr", isSize}}})},
            {Tag::Stop, {{"offset", isFraction}}},
            {Tag::Pattern,
             all({place, size, box, {{"patternUnits", isUnits}, {"patternContentUnits", isUnits}}})},
            {Tag::ClipPath, {{"clipPathUnits", isUnits}}},
            {Tag::Mask, all({place, size, {{"maskUnits", isUnits}, {"maskContentUnits", isUnits}}})},
            {Tag::Marker, all({box,
                               {{"refX", isReferenceX},
                                {"refY", isReferenceY},
                                {"markerWidth", isLength},
                                {"markerHeight", isLength},
                                {"markerUnits", isMarkerUnits},
                                {"orient", isOrientation}}})},
        };
    }();
    return table;
}

}  // namespace

void checkAttributes(const Tree& tree, Reporter& reporter) {
    for (const Element& element : tree.elements) {
        limits::check();
        if (const auto kinds = kindsByTag().find(element.tag); kinds != kindsByTag().end())
            for (const Kind& kind : kinds->second)
                if (const auto value = element.find(kind.name); value && !kind.holds(trim(*value)))
                    reporter.warnInvalid(element, kind.name, *value);
    }
}

}  // namespace vtm::svg
