/// \file
/// From the tree of elements to the scene. One class, because everything in SVG may contain
/// everything else; its chapters are the files named below each heading.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include <vtm/limits/limits.hpp>
#include <vtm/scene/scene.hpp>
#include "svg/convert/scope.hpp"
#include "svg/css/style.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/geometry/shapes.hpp"
#include "svg/geometry/transform.hpp"
#include "svg/text/layout.hpp"
#include "svg/xml/element.hpp"
#include "svg/xml/report.hpp"

namespace vtm::svg {

using Nodes = std::vector<scene::Node>;
using FilterList = std::vector<std::shared_ptr<const scene::Filter>>;

/// What all documents of one load, nested images included, may use together.
struct Budget {
    std::size_t visits = Limits::maxNodes;  ///< elements still to be visited
    std::int64_t imagePixels = 1 << 26;     ///< still to be decoded
    int imageDepth = 0;                     ///< images in images around this document
    int level = 0;                          ///< elements and references that are being followed
};

/// The element whose paints `context-fill` and `context-stroke` stand for: a use or a marked shape.
struct ContextElement {
    const Element& element;
    const Scope& scope;
    mutable std::optional<Box> box;  ///< in its user space; empty: not known yet
};

/// A paint server and the templates that it refers to, one through the other.
using TemplateChain = std::vector<const Element*>;
/// The first value along the chain, on elements of `tag` only unless that is Unknown; empty if there is none.
std::string_view inherited(const TemplateChain& chain, std::string_view name, Tag tag = Tag::Unknown);

class Converter {
public:
    Converter(const Tree& tree, Reporter& reporter, const Options& options, Budget& budget);
    ~Converter();
    Converter(const Converter&) = delete;
    Converter& operator=(const Converter&) = delete;

    /// The root viewport in user units.
    Viewport rootSize() const { return rootSize_; }
    /// Appends the picture; `placement` maps the root viewport's units to where they shall lie.
    void convertRoot(const scene::Affine& placement, Nodes& out);
    /// The same of one element, at its place.
    void convertOnly(const Element& element, const scene::Affine& placement, Nodes& out);
    /// For the places of a nested document's items: the image in the outermost file.
    void standFor(const limits::Place& image) { standsFor_ = image; }

private:
    struct NestedDocument;  // nested_document.hpp
    /// Documents in documents in documents …
    static constexpr int maxNested = 8;

    limits::Place placeOf(const Element& element) const {
        return standsFor_ ? *standsFor_ : reporter_.placeOf(element);
    }
    /// One level further in, by nesting or by reference, for as long as it lives; false where that is too
    /// deep, after a warning. Says that the element is being worked on, and checks the budget.
    class Level {
    public:
        Level(Converter& converter, const Element& element);
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        ~Level() { --converter_.budget_.level; }
        explicit operator bool() const { return converter_.budget_.level <= Limits::maxDepth; }

    private:
        Converter& converter_;
        const Element& element_;
        const limits::Stage stage_;
    };

    // convert.cpp: elements in general
    /// Whether the element is an ancestor of the only one that is drawn, which has not been reached.
    bool leadsToOnly(const Element& element) const;
    void convertTowardsOnly(const Element& element, const Scope& parent, Nodes& out);
    void convertElement(const Element& element, const Scope& parent, Nodes& out);
    void convertChildren(const Element& element, const Scope& scope, Nodes& out);
    void convertContent(const Element& element, const Scope& scope, Nodes& out);
    void warnUnsupported(const Element& element);
    bool passesConditions(const Element& element) const;
    std::optional<Scope> enter(const Element& element, const Scope& parent);
    void convertSwitch(const Element& element, const Scope& scope, Nodes& out);
    scene::Affine transformFrom(std::string_view text, const Style& style, const Viewport& viewport) const;
    /// What the style's properties make, with percentages and origin in a box.
    scene::Affine transformIn(const Box& box, const Style& style) const;
    /// Of an element in a scope that has its style, and the transform and viewport of its parent.
    scene::Affine transformOf(const Element& element, const Scope& scope);
    Box ownBox(const Element& element, const Scope& scope);
    /// With its strokes.
    Box ownStrokeBox(const Element& element, const Scope& scope);
    const Style& styleOf(const Element& element);
    LengthReader lengths(const Element& element, const Scope& scope) const;
    Units unitsFor(const Style& style) const;
    /// False once too much has been visited.
    bool spend(std::size_t visits = 1);
    bool leavesPaintAlone(const Style& style) const;

    // viewport.cpp: svg, symbol, use
    void convertSvg(const Element& element, const Scope& scope, Nodes& out);
    void fillBackground(const Scope& scope, const Rect& canvas, Nodes& out);
    void convertViewport(const Element& element, const Rect& viewport, const Scope& scope, Nodes& out);
    void convertUse(const Element& element, const Scope& scope, Nodes& out);
    /// An element of another file.
    void convertForeignUse(const Element& use, std::string_view href, const Scope& scope, Nodes& out);
    std::shared_ptr<NestedDocument> foreignDocument(std::string_view file, const Element& use);
    void convertUsed(const Element& use, const Element& target, const Scope& scope, Nodes& out);
    Viewport computeRootSize();
    void appendClipped(const Rect& rect, const scene::Affine& transform, Nodes content, Nodes& out);

    // shape.cpp: paths and their items
    struct CachedShape {
        Viewport viewport;
        double fontSize;
        std::shared_ptr<const scene::Path> path;
        std::optional<Box> box;
        std::optional<double> length;
    };
    CachedShape* shapeOf(const Element& element, const Scope& scope);
    const Box& boxOf(CachedShape& shape);
    void convertShape(const Element& element, const Scope& scope, Nodes& out);
    void fillShape(const Element& element, const Scope& scope, CachedShape& shape, Nodes& out);
    void strokeShape(const Element& element, const Scope& scope, CachedShape& shape, Nodes& out);
    std::optional<scene::StrokeStyle> strokeStyle(const Element& element, const Scope& scope,
                                                  CachedShape& shape);
    void addDashes(const Element& element, const Scope& scope, CachedShape& shape,
                   scene::StrokeStyle& stroke);

    // paint.cpp: fill and stroke values, gradients, patterns
    /// A paint server that cannot be used, so that the fallback is; one that paints nothing; a paint.
    struct Invalid {};
    struct Nothing {};
    using ServerResult = std::variant<Invalid, Nothing, scene::Paint>;
    std::optional<scene::Paint> paint(const PaintValue& value, const Element& element, const Scope& scope,
                                      const Box& box);
    std::optional<scene::Paint> contextPaint(bool fill, const Scope& scope);
    const Box& contextBox(const ContextElement& context);
    ServerResult server(std::string_view href, const Element& element, const Scope& scope, const Box& box);
    TemplateChain templateChain(const Element& server);
    /// The first transform along the chain; empty if there is none.
    std::string_view templateTransform(const TemplateChain& chain);
    ServerResult gradient(const Element& server, const Scope& scope, const Box& box);
    const std::vector<scene::GradientStop>& gradientStops(const std::vector<const Element*>& chain);
    std::vector<scene::GradientStop> stopsIn(const Element& gradient);
    ServerResult pattern(const Element& server, const Scope& scope, const Box& box);
    /// A pattern's content and how many visits it stands for, patterns within patterns expanded.
    struct PatternContent {
        std::shared_ptr<const scene::Group> group;
        std::size_t visits = 0;
    };
    std::shared_ptr<const scene::Group> patternContent(const Element& owner, const Viewport& viewport);

    // effects.cpp: clips, masks and what else makes a group
    struct Effects {
        bool draw = true;  ///< false: the element is not rendered at all
        FilterList filters;
        std::shared_ptr<const scene::Clip> clip;
        std::shared_ptr<const scene::Mask> mask;
    };
    using Content = std::function<void(Nodes&)>;
    /// Appends what `content` makes, as a group where the element's style asks for one.
    void appendWithEffects(const Element& element, const Scope& scope, Nodes& out, const Content& content);
    /// The box, in the scope's user space, of the shapes that `convert` meets.
    Box boxAround(const Scope& scope, const std::function<void()>& convert);
    Effects effectsOf(const Element& element, const Scope& scope, const Box& box);
    /// What an href to a mask or clipPath leads to; nothing (and a warning) if it leads nowhere.
    const Element* resource(std::string_view href, Tag tag, const Element& user);
    std::shared_ptr<const scene::Clip> clip(const Element& clipPath, const Scope& scope, const Box& box);
    void addClipChild(const Element& child, const Scope& scope, scene::Clip& clip);
    void addClipShape(const Element& child, const Scope& scope,
                      const std::shared_ptr<const scene::Clip>& around, scene::Clip& clip);
    std::shared_ptr<const scene::Clip> clipOf(const Element& element, const Scope& scope, const Box& box);
    /// Of a shape that clip-path names.
    std::shared_ptr<const scene::Clip> shapeClip(const Element& element, const Scope& scope, const Box& box);
    std::shared_ptr<const scene::Mask> mask(const Element& maskElement, const Scope& scope, const Box& box);
    std::shared_ptr<const scene::Mask> maskOf(const Element& element, const Scope& scope, const Box& box);

    // filter.cpp
    class FilterBuilder;
    /// In the order in which they apply; nothing if the element is not rendered.
    std::optional<FilterList> filtersOf(const Element& element, const Scope& scope, const Box& box);
    TemplateChain filterChain(const Element& filter);
    scene::Link<scene::Group> filterImage(const Element& element, const Scope& scope, const Box& region);

    // text_content.cpp, text.cpp
    class TextCollector;
    TextContent textContent(const Element& text, const Scope& scope);
    TextContent flowContent(const Element& flowRoot, const Scope& scope);
    Box flowRegion(const Element& flowRoot, const Scope& scope);
    void convertFlowRoot(const Element& element, const Scope& scope, Nodes& out);
    struct PlacedText {
        TextLayout layout;
        std::shared_ptr<const scene::Path> cells;  ///< of its clusters, and the box around them: user space
        Box box;
    };
    std::optional<PlacedText> placeText(const Element& element, const Scope& scope,
                                        const TextContent& content);
    void paintText(const Element& element, const Scope& scope, const TextContent& content, Nodes& out);
    text::FontSet& fonts();
    void addFontFaces(text::FontSet& fonts);
    bool addFontFace(text::FontSet& fonts, const text::FontFace& face, std::string_view url,
                     const std::string& directory, std::string& cause);
    void warnOfMissingFamilies(const TextContent& content);
    void warnOfMissingGlyphs(const Element& element, const TextContent& content, const TextLayout& layout);
    void convertText(const Element& element, const Scope& scope, Nodes& out);
    void paintLine(const TextContent& content, const PlacedLine& line, const Box& box, Nodes& out);
    void paintClusters(const TextElement& text, std::span<const PlacedCluster> clusters, const Box& box,
                       Nodes& out);
    void fillGlyph(const TextElement& text, const PlacedGlyph& glyph,
                   const std::shared_ptr<const scene::Path>& outline, Nodes& out);
    bool paintColorGlyph(const TextElement& text, const PlacedGlyph& glyph, Nodes& out);
    void convertSvgGlyph(const TextElement& text, const PlacedGlyph& glyph, const text::SvgGlyph& svg,
                         const scene::Affine& transform, Nodes& out);
    void addClipText(const Element& element, const Scope& parent, scene::Clip& clip);

    // marker.cpp
    void convertMarkers(const Element& element, const Scope& scope, CachedShape& shape, Nodes& out);
    void convertMarker(const Element& marker, const ContextElement& context, scene::Point at, double degrees,
                       Nodes& out);

    // image.cpp
    using ImageContent =
        std::variant<std::monostate, std::shared_ptr<const image::Bitmap>, std::shared_ptr<NestedDocument>>;
    void convertImage(const Element& element, const Scope& scope, Nodes& out);
    ImageContent imageContent(std::string_view href, const Element& element);
    ImageContent loadImage(std::string_view href);
    std::shared_ptr<NestedDocument> svgGlyph(const TextElement& text, const PlacedGlyph& glyph,
                                             const text::SvgGlyph& svg);
    static std::optional<Viewport> sizeOf(const ImageContent& content);
    void placeBitmap(const std::shared_ptr<const image::Bitmap>& bitmap, const Element& element,
                     const Rect& viewport, const AspectRatio& ratio, const Scope& scope, Nodes& out);
    /// As an image of the element.
    void placeNested(NestedDocument& document, const Element& element, const Rect& viewport,
                     const AspectRatio& ratio, const Scope& scope, Nodes& out);
    void placeDocument(NestedDocument& document, const Rect& viewport, const AspectRatio& ratio,
                       const Scope& scope, Nodes& out);

    /// Marks an element as being expanded for as long as it lives.
    class Expansion {
    public:
        Expansion(std::unordered_set<const Element*>& active, const Element& element)
            : active_(active), element_(&element), fresh_(active.insert(element_).second) {}
        Expansion(const Expansion&) = delete;
        Expansion& operator=(const Expansion&) = delete;
        ~Expansion() {
            if (fresh_)
                active_.erase(element_);
        }
        /// False where the element is being expanded already: a reference in a circle.
        explicit operator bool() const { return fresh_; }

    private:
        std::unordered_set<const Element*>& active_;
        const Element* element_;
        bool fresh_;
    };

    /// Runs `convert` so that the shapes it meets count for nobody's box.
    template <class Function>
    void withoutOutlines(Function convert) {
        const std::size_t kept = outlines_.size();
        convert();
        outlines_.resize(kept);
    }

    /// Shapes met while somebody asks for the box of what he contains, in picture space.
    struct Outline {
        std::shared_ptr<const scene::Path> path;
        scene::Affine transform;
    };
    Box outlineBox(std::size_t first, const scene::Affine& userToPicture) const;

    const Element* only_ = nullptr;  ///< drawn alone, until it is reached
    const Tree& tree_;
    using Kind = Warning::Kind;
    Reporter& reporter_;
    const Options& options_;
    Budget& budget_;
    Viewport rootSize_;
    double rootFontSize_;
    std::unordered_map<const Element*, Style> styles_;
    std::unordered_map<const Element*, CachedShape> shapes_;
    std::unordered_map<const Element*, PatternContent> patterns_;
    std::unordered_map<const Element*, std::vector<scene::GradientStop>> stops_;  ///< by their gradient
    std::unordered_map<std::string_view, ImageContent> images_;
    std::unordered_map<std::string_view, std::shared_ptr<NestedDocument>>
        foreign_;  ///< by file; null: not read
    std::unordered_set<const Element*> active_;
    std::unique_ptr<text::FontSet> fonts_;  ///< null until there is text
    /// Of glyphs that are documents; null for those that cannot be read.
    std::map<std::pair<const text::Font*, text::GlyphId>, std::shared_ptr<NestedDocument>> svgGlyphs_;
    std::unordered_set<std::string> missingFamilies_;  ///< those that were warned of
    std::vector<Outline> outlines_;
    int outlineListeners_ = 0;
    std::optional<limits::Place> standsFor_;
};

/// The paint laid in another space: `change` maps its old path space to the new one.
scene::Paint mapPaint(scene::Paint paint, const scene::Affine& change);

/// Appends a group, or only its children where it would change nothing.
void appendGroup(scene::Group group, bool isolated, Nodes& out);

/// False for boxes that lie, in part, too far away to be drawn.
bool isWithinReach(const Box& box);

/// The parts of the union of `first` that lie in `second` too; either may be null.
std::shared_ptr<const scene::Clip> intersect(const std::shared_ptr<const scene::Clip>& first,
                                             const std::shared_ptr<const scene::Clip>& second);

}  // namespace vtm::svg
