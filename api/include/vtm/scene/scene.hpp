/// \file
/// The scene: the normal form between importers and the compiler (docs/scene.md lists all rules).
///
/// Everything is resolved: there are no units, no inheritance and no references by name. Transforms are
/// absolute: they map a node's space to the picture. Painter's order: later children lie on top. Parts that
/// are held by pointer may be shared and must not change after that.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <vtm/error.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/scene/affine.hpp>
#include <vtm/scene/filter.hpp>
#include <vtm/scene/nested.hpp>
#include <vtm/scene/paint.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

/// Source: W3C Compositing and Blending Level 1, section 10. PlusLighter is from Level 2, section 9.1:
/// min(1, source + backdrop) on premultiplied colours.
enum class BlendMode {
    Normal,
    Multiply,
    Screen,
    Overlay,
    Darken,
    Lighten,
    ColorDodge,
    ColorBurn,
    HardLight,
    SoftLight,
    Difference,
    Exclusion,
    Hue,
    Saturation,
    Color,
    Luminosity,
    PlusLighter
};

/// A set of points: a path, filled by a rule or stroked.
struct Shape {
    std::shared_ptr<const Path> path;  ///< not null
    Affine transform = identity;       ///< path space to picture
    std::variant<FillRule, StrokeStyle> geometry;
};

/// One path, filled or stroked, with one paint. A shape with both is two items in its paint order.
struct Item {
    std::shared_ptr<const Path> path;  ///< not null; instances of an outline may share it
    Affine transform = identity;       ///< path space to picture
    std::variant<FillRule, StrokeStyle> geometry;
    Paint paint;
    float opacity = 1;      ///< in [0, 1]; multiplies the paint's alpha
    limits::Place place{};  ///< position in the source file, for messages only
};

struct ClipShape;

/// The union of `shapes`, cut by a further clip. An empty union clips everything away.
struct Clip {
    std::vector<ClipShape> shapes;
    Link<Clip> clip;  ///< may be null
};

/// A filled path, cut by a clip of its own.
struct ClipShape {
    std::shared_ptr<const Path> path;  ///< not null
    Affine transform = identity;       ///< path space to the space of the clipped group
    FillRule rule = FillRule::NonZero;
    Link<Clip> clip;        ///< may be null
    limits::Place place{};  ///< as an item's
};

enum class MaskKind { Luminance, Alpha };

/// Multiplies the masked group by the luminance or the alpha of another group. The luminance is
/// 0.2126 R + 0.7152 G + 0.0722 B of the premultiplied colour. Source: CSS Masking Level 1.
struct Mask {
    Link<Group> content;  ///< not null
    MaskKind kind = MaskKind::Luminance;
    bool linear = false;  ///< luminance of linear light instead of sRGB-encoded values
};

struct Node;

/// A vector of nodes, which may be groups. Copying a list that is nested more than 2 maxNesting levels deep
/// throws InvalidScene; destroying it does not recurse.
class NodeList : public std::vector<Node> {
public:
    using std::vector<Node>::vector;
    // Defined where Node is complete.
    NodeList() noexcept;
    NodeList(std::vector<Node> nodes) noexcept;
    NodeList(const NodeList& other);
    NodeList(NodeList&&) noexcept;
    NodeList& operator=(const NodeList& other);
    NodeList& operator=(NodeList&&) noexcept;
    ~NodeList();
};

/// An isolated group: its children are composited on transparent black; the result is replaced by what
/// `filter` makes of it, cut by `clip`, multiplied by `mask` and `opacity`, and blended with what lies below
/// it in the parent.
struct Group {
    NodeList children;
    float opacity = 1;  ///< in [0, 1]
    BlendMode blend = BlendMode::Normal;
    Link<Clip> clip;                       ///< may be null
    Link<Mask> mask;                       ///< may be null
    Link<Filter> filter = Link<Filter>();  ///< may be null
};

/// One of two pictures at every point: `inside` where the mask is inside, `outside` elsewhere. It is a
/// choice, not a layer: a translucent inside does not show the outside. Each side is isolated, and the
/// chosen side lies over what is below. Source: Ray et al. 2005, the shader algebra b·c1 + (1-b)·c2.
struct Select {
    Shape mask;
    Link<Group> inside, outside;  ///< null: nothing is drawn there
};

struct Node {
    std::variant<Item, Group, Select> value;
};

/// Limits of a picture's sides in user units. They are those of the .vtm format, so every picture that can be
/// drawn can be written.
inline constexpr double minSide = 0x1p-40, maxSide = 0x1p40;

/// A picture of `width` by `height` user units with its top left corner at the origin, on transparent black.
/// Everything outside is cut off.
struct Scene {
    double width = 0, height = 0;  ///< in [minSide, maxSide]
    Group root;
};

/// A scene breaks a rule of the normal form. what() names the node and the rule.
class InvalidScene : public Error {
    using Error::Error;
};

/// Max number of groups, selections and clips inside each other, including those of masks and patterns.
inline constexpr int maxNesting = 1024;

/// Throws InvalidScene unless every rule of docs/scene.md holds, and limits::Exceeded when a budget is used
/// up (vtm/limits/limits.hpp).
void validate(const Scene& scene);

/// The same, but skips paths for which `isKnown` returns true: paths that are known to be valid.
void validate(const Scene& scene, const std::function<bool(const Path&)>& isKnown);

/// Returns a readable text form, one node per line, for tests and for diff. The scene need not be valid;
/// nodes that are nested too deeply are cut off.
std::string dump(const Scene& scene);

}  // namespace vtm::scene

#pragma GCC visibility pop
