/// \file
/// Computed style: every property that the importer knows, with inheritance done.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <vtm/scene/scene.hpp>
#include "svg/css/length.hpp"
#include "svg/geometry/transform.hpp"
#include "svg/xml/element.hpp"
#include "text/font_set.hpp"
#include "text/shape.hpp"

namespace vtm::svg {

enum class PaintKind { None, Color, CurrentColor, Server, ContextFill, ContextStroke };

/// A value of `fill` or `stroke`.
struct PaintValue {
    PaintKind kind = PaintKind::None;
    scene::Color color;                 ///< of Color, or of a fallback that is a colour
    std::string_view server;            ///< the href in url()
    std::optional<PaintKind> fallback;  ///< None, Color or CurrentColor
};

/// A colour that may be `currentColor`.
struct ColorValue {
    bool current = false;
    scene::Color color;
};

enum class PaintStage { Fill, Stroke, Markers };

/// In which box the origin of transforms lies, and of what their percentages are.
enum class TransformBox { View, Fill, Stroke };

enum class TextAnchor { Start, Middle, End };
/// `dominant-baseline` and `alignment-baseline`: the line of a font that is aligned.
enum class Baseline {
    Auto,
    Alphabetic,
    Ideographic,
    Middle,
    Central,
    Mathematical,
    Hanging,
    TextBottom,
    TextTop
};
enum class WritingMode { Horizontal, VerticalRl, VerticalLr };
/// How white space in text is kept (CSS Text 4 section 3).
enum class WhiteSpace { Collapse, Preserve };
/// Lines of `text-decoration`, as bits.
enum TextLines : unsigned { Underline = 1, Overline = 2, LineThrough = 4 };
/// `text-decoration-style`.
enum class LineStyle { Solid, Double, Dotted, Dashed };
/// How the lines of an element look.
struct TextDecoration {
    LineStyle style = LineStyle::Solid;
    std::optional<Length> thickness;  ///< nothing: the font's; percentages refer to the font size
};
enum class UnicodeBidi { Normal, Embed, Isolate, Override, IsolateOverride, Plaintext };

/// `baseline-shift`: up by a length, or by what the font says of subscripts and superscripts.
struct BaselineShift {
    enum class Kind { Length, Sub, Super } kind = Kind::Length;
    Length length;  ///< percentages refer to the font size
};

/// Fonts and text, inherited. Source: CSS Fonts 4, CSS Text 4, CSS Writing Modes 4, SVG 2 chapter 11.
struct TextStyle {
    double fontSize = 12;
    std::string_view fontFamily;  ///< as written; empty: the default family
    double fontWeight = 400;
    double fontStretch = 100;  ///< percent
    text::Slant fontSlant = text::Slant::Normal;
    std::optional<double> fontSizeAdjust;           ///< x-height by font size
    std::string_view fontFeatures, fontVariations;  ///< as written, empty: normal
    std::uint64_t fontVariants = 0;  ///< rows of the table of font-variant's keywords (font_values.hpp)
    std::optional<bool> kerning;     ///< nothing: auto
    bool synthesizeWeight = true, synthesizeSlant = true, synthesizeSmallCaps = true;
    Length letterSpacing, wordSpacing;  ///< percentages refer to the font size
    TextAnchor anchor = TextAnchor::Start;
    TextAnchor align = TextAnchor::Start;  ///< text-align
    Baseline dominantBaseline = Baseline::Auto;
    WritingMode writingMode = WritingMode::Horizontal;
    text::TextOrientation textOrientation = text::TextOrientation::Mixed;
    bool rightToLeft = false;               ///< direction
    double lineHeight = 1.25;               ///< by font size; `normal` as Inkscape has it
    std::optional<Length> underlineOffset;  ///< nothing: the font's; percentages refer to the font size
    std::optional<WhiteSpace> whiteSpace;   ///< nothing: as xml:space says
};

/// Properties that an element takes over from its parent.
struct Inherited : TextStyle {
    scene::Color color{0, 0, 0, 1};
    PaintValue fill{PaintKind::Color, {0, 0, 0, 1}, {}, {}}, stroke;
    double fillOpacity = 1, strokeOpacity = 1;
    scene::FillRule fillRule = scene::FillRule::NonZero, clipRule = scene::FillRule::NonZero;
    Length strokeWidth{1};
    scene::Cap cap = scene::Cap::Butt;
    scene::Join join = scene::Join::Miter;
    double miterLimit = 4;
    std::shared_ptr<const std::vector<Length>> dashes;  ///< null: none
    Length dashOffset;
    bool visible = true;
    std::string_view markerStart, markerMid, markerEnd;  ///< hrefs, empty: none
    std::array<PaintStage, 3> paintOrder{PaintStage::Fill, PaintStage::Stroke, PaintStage::Markers};
    bool linearColors = false;  ///< color-interpolation
    bool linearFilters = true;  ///< color-interpolation-filters
    scene::ImageFilter imageFilter = scene::ImageFilter::Trilinear;
};

/// Properties of the element alone. Hrefs of url() are empty for `none`.
struct Own {
    bool displayed = true;
    double opacity = 1;
    scene::BlendMode blend = scene::BlendMode::Normal;
    bool isolated = false;
    std::optional<bool> overflow;  ///< whether it is visible, if declared
    std::string_view clipPath;     ///< the whole value
    std::string_view mask;
    std::optional<scene::MaskKind> maskMode;  ///< else that of the mask
    std::string_view filter;                  ///< the whole value
    scene::MaskKind maskKind = scene::MaskKind::Luminance;
    ColorValue stopColor{false, {0, 0, 0, 1}};
    double stopOpacity = 1;
    ColorValue floodColor{false, {0, 0, 0, 1}}, lightingColor{false, {1, 1, 1, 1}};
    double floodOpacity = 1;
    std::optional<scene::Color> background;
    bool nonScalingStroke = false;
    std::string_view transform, translate, rotate, scale;  ///< as written, known to be well formed
    std::optional<TransformOrigin> transformOrigin;
    TransformBox transformBox = TransformBox::View;
    Baseline alignmentBaseline = Baseline::Auto;
    BaselineShift baselineShift;
    unsigned textLines = 0;  ///< TextLines that the element adds; those of its ancestors go on
    TextDecoration decoration;
    UnicodeBidi unicodeBidi = UnicodeBidi::Normal;
    std::optional<Length> inlineSize;  ///< nothing: auto
    /// x, width, cx, … where CSS, not an attribute, gives them.
    std::vector<Attribute> geometry;
};

struct Style : Inherited, Own {};

/// The computed style of `element` below a parent of style `parent`; units.fontSize is ignored.
Style computeStyle(const Element& element, const Style& parent, Units units);

scene::Color resolveColor(const ColorValue& value, const Style& style);

struct Property {
    std::string_view name;
    bool attribute;  ///< may also be written as an attribute
    bool inherited;
    /// False if the value is not one of the property's.
    bool (*apply)(Style& style, std::string_view value, const Units& units);
    void (*copy)(Style& to, const Style& from);
};

/// Whether a value is one of the property's, or a keyword that all properties have.
bool isValid(const Property& property, std::string_view value);

/// Null for unknown names.
const Property* findProperty(std::string_view name);
/// The same of a name in a declaration, whose case does not matter.
const Property* findDeclared(std::string_view name);

}  // namespace vtm::svg
