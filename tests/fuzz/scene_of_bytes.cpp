#include "tests/fuzz/scene_of_bytes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <glm/geometric.hpp>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>

namespace vtm::fuzz {

namespace {

using namespace scene;

/// Zeros follow once the bytes have ended.
class ByteNumbers {
public:
    explicit ByteNumbers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool atEnd() const { return next_ >= bytes_.size(); }
    unsigned byte() { return atEnd() ? 0 : bytes_[next_++]; }
    /// In [0, n), n <= 256.
    unsigned below(unsigned n) { return byte() % n; }
    /// One time in `n`; never once the bytes have ended.
    bool rarely(unsigned n) { return below(n) == n - 1; }
    /// In [0, 1]; 1 often.
    float share() {
        const unsigned b = byte();
        return b >= 128 ? 1.0f : float(b) / 127;
    }
    /// One of an enumeration's values, 0 to last.
    template <class Enum>
    Enum any(Enum last) {
        return static_cast<Enum>(below(unsigned(last) + 1));
    }
    /// Between 2^-(n - 1) and 1.
    double magnitude(unsigned n) { return std::ldexp(1.0 - double(below(64)) / 128, -int(below(n))); }

    /// Of a picture `side` units wide: mostly on a coarse grid, so that edges and vertices coincide; the
    /// number before, or one that is a hair off; any; rarely far outside, which sets isFar().
    double coordinate(double side) {
        const unsigned kind = byte();
        if (kind < 176)
            last_ = side * (double(kind) - 16) / 144;
        else if (kind < 200)
            last_ += std::ldexp(side, -int(8 + below(40))) * (kind % 2 == 0 ? 1 : -1);
        else if (kind < 248)
            last_ = side * (double(byte() << 8 | byte()) / 65536 * 1.5 - 0.25);
        else if (kind < 255)
            setFar(side, below(6));
        return last_;
    }
    scene::Point point(double side) {
        const double x = coordinate(side);
        return {x, coordinate(side)};
    }
    /// Whether a coordinate was far outside since forgetFar().
    bool isFar() const { return isFar_; }
    void forgetFar() { isFar_ = false; }
    /// Whether any was so far outside that doubles do not resolve the picture there.
    bool isWild() const { return isWild_; }

    /// Mostly none; turned, leant, mirrored, shrunk or enlarged about a point.
    scene::Affine transform(double side) {
        if (!rarely(4))
            return scene::identity;
        const auto entry = [&] { return (double(byte()) - 128) / 64 * (rarely(16) ? magnitude(60) : 1); };
        const glm::dvec2 x{entry(), entry()}, y{entry(), entry()};
        const scene::Point about = point(side);
        return {x, y, about - x * about.x - y * about.y};
    }

private:
    void setFar(double side, unsigned which) {
        constexpr std::array distances{1e3, -1e3, 1e5, -1e7, 1e15, -1e30};
        last_ = side * distances[which];
        isFar_ = true;
        isWild_ |= which >= 4;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    double last_ = 0;
    bool isFar_ = false, isWild_ = false;
};

constexpr int maxItems = 8, maxCommands = 24, maxLevels = 3;
/// A dash pattern's period and a tile's side are not below this share of the picture's side: hundreds of
/// dashes or tiles, not thousands.
constexpr double minPeriod = 1.0 / 16;

bool jumpsWithRounding(BlendMode mode) {
    return mode == BlendMode::ColorDodge || mode == BlendMode::ColorBurn || mode == BlendMode::SoftLight ||
           (mode >= BlendMode::Hue && mode <= BlendMode::Luminosity);
}

class SceneMaker {
public:
    explicit SceneMaker(std::span<const std::uint8_t> bytes) : in_(bytes) {}

    ByteScene run() {
        constexpr double sizes[][2] = {{64, 64},  {64, 40},           {1, 1},
                                       {1000, 7}, {minSide, minSide}, {3e5, maxSide}};
        const auto& size = sizes[in_.rarely(8) ? in_.below(6) : in_.below(2)];
        result_.scene.width = size[0];
        result_.scene.height = size[1];
        side_ = std::max(size[0], size[1]);
        for (left_ = maxItems; left_ > 0 && !in_.atEnd();)
            result_.scene.root.children.push_back(node(maxLevels));
        result_.isSteady &= !in_.isWild();
        return std::move(result_);
    }

private:
    // ---- Nodes ------------------------------------------------------------------------------------

    Node node(int levels) {
        const unsigned kind = in_.below(8);
        if (levels > 0 && kind == 7)
            return {select(levels - 1)};
        if (levels > 0 && kind == 6)
            return {group(levels - 1)};
        --left_;
        return {item(levels)};
    }

    Group group(int levels) {
        Group group;
        for (unsigned i = 1 + in_.below(3); i > 0 && left_ > 0; --i)
            group.children.push_back(node(levels));
        group.opacity = in_.share();
        if (in_.rarely(3))
            group.blend = in_.any(BlendMode::PlusLighter);
        result_.isSteady &= !jumpsWithRounding(group.blend);
        if (in_.rarely(3))
            group.clip = clip(2);
        if (in_.rarely(6))
            group.mask =
                std::make_shared<Mask>(Mask{content(levels), in_.any(MaskKind::Alpha), in_.rarely(2)});
        return group;
    }

    std::shared_ptr<const Group> content(int levels) {
        return std::make_shared<Group>(levels > 0 ? group(levels - 1) : Group{});
    }

    Select select(int levels) {
        Select select;
        const auto path = outline();
        select.mask = {path, in_.transform(side_), geometry()};
        if (!in_.rarely(4))
            select.inside = content(levels);
        if (!in_.rarely(4))
            select.outside = content(levels);
        return select;
    }

    std::shared_ptr<const Clip> clip(int levels) {
        auto clip = std::make_shared<Clip>();
        for (unsigned i = in_.below(3); i > 0; --i) {
            const auto path = outline();
            const Affine transform = in_.transform(side_);
            clip->shapes.push_back({path, transform, in_.any(FillRule::EvenOdd),
                                    levels > 0 && in_.rarely(4) ? this->clip(levels - 1) : nullptr});
        }
        if (levels > 0 && in_.rarely(4))
            clip->clip = this->clip(levels - 1);
        return clip;
    }

    Item item(int levels) {
        Item item;
        item.path = outline();
        item.transform = in_.transform(side_);
        item.geometry = geometry();
        item.paint = paint(levels);
        if (in_.rarely(3))
            item.opacity = in_.share();
        return item;
    }

    // ---- Geometry ---------------------------------------------------------------------------------

    /// Now and then the same as before. Strokes follow for what does not reach far.
    std::shared_ptr<const Path> outline() {
        if (last_ && in_.rarely(6))
            return last_;
        in_.forgetFar();
        isFar_ = false;
        auto path = std::make_shared<Path>();
        for (unsigned i = in_.below(maxCommands); i > 0; --i)
            path->push_back(command(path->empty()));
        isFar_ = in_.isFar();
        return last_ = path;
    }

    Command command(bool first) {
        const unsigned kind = first ? 0 : in_.below(16);
        if (kind == 0)
            return MoveTo{in_.point(side_)};
        if (kind < 8)
            return LineTo{in_.point(side_)};
        if (kind < 10)
            return QuadTo{in_.point(side_), in_.point(side_)};
        if (kind < 13)
            return CubicTo{in_.point(side_), in_.point(side_), in_.point(side_)};
        if (kind < 15) {
            const Point radii = in_.point(side_);
            const double rotation = double(in_.byte()) / 40;
            const bool large = in_.rarely(2), sweep = in_.rarely(2);
            const Point to = in_.point(side_);
            result_.isSteady &= !in_.isFar();
            return ArcTo{radii, rotation, large, sweep, to};
        }
        return Close{};
    }

    std::variant<FillRule, StrokeStyle> geometry() {
        if (!in_.rarely(3) || isFar_)
            return in_.any(FillRule::EvenOdd);
        StrokeStyle style;
        style.width = side_ / 4 * in_.magnitude(24);
        style.cap = in_.any(Cap::Square);
        style.join = in_.any(Join::Bevel);
        style.miterLimit = 1 + double(in_.byte()) / 8;
        if (in_.rarely(4))
            for (unsigned i = 1 + in_.below(2); i > 0; --i) {
                style.dashes.push_back(side_ * double(in_.byte()) / 512);
                style.dashes.push_back(side_ * std::max(minPeriod, double(in_.byte()) / 512));
                style.dashPhase = in_.coordinate(side_);
            }
        return style;
    }

    // ---- Paints -----------------------------------------------------------------------------------

    Color color() {
        const auto channel = [&] { return float(in_.byte()) / 255; };
        Color color{channel(), channel(), channel(), 1};
        color.a = in_.share();
        return color;
    }

    std::vector<GradientStop> stops() {
        std::vector<GradientStop> stops;
        float offset = 0;
        for (unsigned i = 2 + in_.below(4); i > 0; --i) {
            stops.push_back({offset, color()});
            offset = std::min(1.0f, offset + float(in_.below(5)) / 4);
        }
        return stops;
    }

    Paint paint(int levels) {
        switch (in_.below(12)) {
            case 8:
                return linear();
            case 9:
                return radial();
            case 10:
                return levels > 0 ? pattern(levels - 1) : Paint(color());
            case 11:
                return in_.rarely(2)
                           ? Paint(image())
                           : Paint(Material{"m", "vec4 m(vec2 p){}", color(), in_.transform(side_)});
            default:
                return color();
        }
    }

    Paint linear() {
        LinearGradient g{in_.point(side_), in_.point(side_), stops(), in_.any(Spread::Repeat),
                         in_.transform(side_)};
        return g.start == g.end ? Paint(color()) : Paint(g);
    }

    Paint radial() {
        RadialGradient g{};
        g.center = in_.point(side_);
        g.radius = 2 * side_ * in_.magnitude(40);
        g.focalRadius = g.radius * double(in_.byte()) / 256;
        const double way = double(in_.byte()) / 40;
        g.focus = g.center + g.radius * (double(in_.byte()) / 257) * Point(std::cos(way), std::sin(way));
        g.stops = stops();
        g.spread = in_.any(Spread::Repeat);
        g.transform = in_.transform(side_);
        return glm::distance(g.center, g.focus) < g.radius ? Paint(g) : Paint(color());
    }

    Paint pattern(int levels) {
        const Point min = in_.point(side_);
        const double minimum = 2 * minPeriod * side_;
        const Point size{std::max(minimum, in_.coordinate(side_)), std::max(minimum, in_.coordinate(side_))};
        if (!(min.x + size.x > min.x && min.y + size.y > min.y))
            return color();
        result_.isSteady = false;
        return Pattern{min, min + size, content(levels), identity};
    }

    ImagePaint image() {
        image::Bitmap bitmap{1 + int(in_.below(4)), 1 + int(in_.below(4)), {}};
        bitmap.rgba.resize(std::size_t(bitmap.width * bitmap.height) * 4);
        for (std::uint8_t& value : bitmap.rgba)
            value = std::uint8_t(in_.byte());
        const double scale = side_ / 2 * in_.magnitude(20);
        const Affine placed = compose(in_.transform(side_), scaling(scale, scale));
        return {std::make_shared<image::Bitmap>(std::move(bitmap)), in_.any(ImageFilter::Bicubic), placed};
    }

    ByteNumbers in_;
    ByteScene result_;
    double side_ = 0;
    int left_ = 0;
    std::shared_ptr<const Path> last_;
    bool isFar_ = false;  ///< it reaches so far that a stroke would take too many chords and dashes
};

}  // namespace

ByteScene sceneOfBytes(std::span<const std::uint8_t> bytes) { return SceneMaker(bytes).run(); }

}  // namespace vtm::fuzz
