/// \file
/// The scene: the written normal form between the importers and the compiler (docs/scene.md).
///
/// Everything is resolved: no units, no inheritance, no references by name; transforms are absolute
/// (from the node's space to the picture). Painter's order: later children lie on top.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <vtm/error.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/scene/affine.hpp>
#include <vtm/scene/nested.hpp>
#include <vtm/scene/paint.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

/// W3C Compositing and Blending Level 1, section 10; last, level 2 section 9.1: min(1, source + backdrop) on
/// premultiplied colours.
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

/// Where a path is inside, filled by a rule or stroked.
struct Shape {
    std::shared_ptr<const Path> path;
    Affine transform = identity;  ///< path space to picture
    std::variant<FillRule, StrokeStyle> geometry;
};

/// One filled or stroked path. A shape with both is two items in its paint order.
struct Item {
    std::shared_ptr<const Path> path;  ///< shared between the instances of a `use`d outline
    Affine transform = identity;       ///< path space to picture
    std::variant<FillRule, StrokeStyle> geometry;
    Paint paint;
    float opacity = 1;      ///< multiplies the paint's alpha, in [0, 1]
    limits::Place place{};  ///< in the file it comes from, for messages; no part of the picture
};

struct ClipShape;

/// The union of shapes, each perhaps clipped itself, cut by a further clip. An empty union clips
/// everything away.
struct Clip {
    std::vector<ClipShape> shapes;
    Link<Clip> clip;  ///< may be null
};

struct ClipShape {
    std::shared_ptr<const Path> path;
    Affine transform = identity;
    FillRule rule = FillRule::NonZero;
    Link<Clip> clip;        ///< may be null
    limits::Place place{};  ///< as an item's
};

enum class MaskKind { Luminance, Alpha };

/// Multiplies what it is put on by the luminance times alpha, or the alpha, of a group.
/// Luminance: 0.2126 R + 0.7152 G + 0.0722 B of the group's premultiplied colour, on sRGB bytes or,
/// with `linear`, on linear light.
struct Mask {
    Link<Group> content;
    MaskKind kind = MaskKind::Luminance;
    bool linear = false;
};

struct Node;

/// A vector of nodes that may be groups. Copying one that is nested beyond 2 maxNesting throws InvalidScene.
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

/// An isolated group: its children are composited on transparent black; the result is cut by `clip`,
/// multiplied by `mask` and `opacity`, and blended with what lies below.
struct Group {
    NodeList children;
    float opacity = 1;
    BlendMode blend = BlendMode::Normal;
    Link<Clip> clip;  ///< may be null
    Link<Mask> mask;  ///< may be null
};

/// One of two pictures at every point: `inside` where the mask is inside, `outside` elsewhere. It is a
/// choice, not a layer: a translucent inside does not show the outside. Each side is isolated, and what
/// was chosen lies over what is below. Source: Ray et al. 2005, the shader algebra b·c1 + (1-b)·c2.
struct Select {
    Shape mask;
    Link<Group> inside, outside;  ///< null: nothing
};

struct Node {
    std::variant<Item, Group, Select> value;
};

/// Limits on a picture's sides, user units: those of the asset's format, so that what can be drawn can be
/// written.
inline constexpr double minSide = 0x1p-40, maxSide = 0x1p40;

/// A picture of `width` by `height` user units, its top left corner at the origin. What lies outside
/// is cut off.
struct Scene {
    double width = 0, height = 0;  ///< in [minSide, maxSide]
    Group root;
};

/// Says which node breaks which rule of the normal form.
class InvalidScene : public Error {
    using Error::Error;
};

/// Levels of groups, selections and clips inside each other, those of masks and patterns included.
inline constexpr int maxNesting = 1024;

/// Throws InvalidScene unless every rule of docs/scene.md holds, and limits::Exceeded under a budget.
void validate(const Scene& scene);

/// The same, but for paths that `isKnown` to be valid.
void validate(const Scene& scene, const std::function<bool(const Path&)>& isKnown);

/// A readable text form, one node a line, for tests and for `diff`. Scenes need not be valid; what is
/// nested too deeply is cut.
std::string dump(const Scene& scene);

}  // namespace vtm::scene

#pragma GCC visibility pop
