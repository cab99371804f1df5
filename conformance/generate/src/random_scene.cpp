#include <algorithm>
#include <numbers>

#include <vtm/scene/paint.hpp>
#include "conformance/generate/generate.hpp"
#include "conformance/generate/src/outlines.hpp"
#include "conformance/generate/src/random.hpp"

namespace vtm::generate {

namespace {

using namespace scene;

constexpr double gradients = 0.15;  ///< share of all paints

Color randomColor(Random& random) {
    const auto channel = [&] { return float(random.integer(0, 255)) / 255; };
    Color color{channel(), channel(), channel(), 1};
    if (random.chance(0.4))
        color.a = channel();
    return color;
}

/// Few and apart from each other, so that they vary little in a small part of the picture, and ending as they
/// begin, so that no spread makes a sharp edge.
std::vector<GradientStop> randomStops(Random& random) {
    const Color ends = randomColor(random);
    std::vector<GradientStop> stops{{0, ends}};
    const int between = random.integer(1, 2);
    for (int i = 1; i <= between; ++i)
        stops.push_back({float(i) / float(between + 1), randomColor(random)});
    stops.push_back({1, ends});
    return stops;
}

/// A colour, opaque or not, or a gradient without sharp edges over about [0, side]².
scene::Paint randomPaint(Random& random, double side) {
    if (!random.chance(gradients))
        return randomColor(random);
    const Point centre = random.point(0, side);
    const double reach = random.uniform(0.5, 1.5) * side, angle = random.uniform(0, 2 * std::numbers::pi);
    if (random.chance(0.5))
        return LinearGradient{centre, centre + reach * Point(std::cos(angle), std::sin(angle)),
                              randomStops(random), random.any(Spread::Repeat)};
    return RadialGradient{centre,
                          reach,
                          centre + random.point(-0.3 * reach, 0.3 * reach),
                          0,
                          randomStops(random),
                          random.any(Spread::Repeat)};
}

/// Shares of what has strokes, dashes, transforms, groups and clips.
constexpr double strokes = 0.35, dashed = 0.3, transformed = 0.2, grouped = 0.2, clipped = 0.4;
constexpr int maxItems = 6;
/// A dash pattern's period is not below this share of the picture's side: some hundred dashes a path.
constexpr double shortestDash = 0.02;

class SceneMaker {
public:
    explicit SceneMaker(std::uint64_t seed) : random_(seed) {}

    Scene run() {
        constexpr double sizes[][2] = {{64, 64}, {64, 64}, {64, 40}, {30, 100}, {1000, 700}, {1, 1}};
        const auto& size = sizes[random_.integer(0, 5)];
        Scene scene{size[0], size[1], {}};
        side_ = std::max(size[0], size[1]);
        left_ = random_.integer(1, maxItems);
        while (left_ > 0)
            scene.root.children.push_back(node(2));
        return scene;
    }

private:
    Node node(int levels) {
        if (levels > 0 && random_.chance(grouped))
            return {group(levels - 1)};
        --left_;
        return {item()};
    }

    Group group(int levels) {
        Group group;
        for (int i = random_.integer(1, 3); i > 0 && left_ > 0; --i)
            group.children.push_back(node(levels));
        if (random_.chance(0.5))
            group.opacity = float(random_.uniform(0, 1));
        if (random_.chance(0.3))
            group.blend = smoothBlend();
        if (random_.chance(clipped))
            group.clip = clip(1);
        return group;
    }

    /// Without those that jump: dodge, burn and the four that sort the channels.
    BlendMode smoothBlend() {
        constexpr BlendMode modes[] = {BlendMode::Multiply,  BlendMode::Screen,     BlendMode::Darken,
                                       BlendMode::Lighten,   BlendMode::Difference, BlendMode::Exclusion,
                                       BlendMode::HardLight, BlendMode::Overlay};
        return modes[random_.integer(0, 7)];
    }

    std::shared_ptr<const Clip> clip(int levels) {
        auto clip = std::make_shared<Clip>();
        for (int i = random_.integer(1, 2); i > 0; --i)
            clip->shapes.push_back({outline(), transform(), random_.any(FillRule::EvenOdd), nullptr});
        if (levels > 0 && random_.chance(0.3))
            clip->clip = this->clip(levels - 1);
        return clip;
    }

    Item item() {
        Item item;
        item.path = outline();
        item.transform = transform();
        item.paint = randomPaint(random_, side_);
        if (random_.chance(strokes))
            item.geometry = style(*item.path);
        else
            item.geometry = random_.any(FillRule::EvenOdd);
        if (random_.chance(0.3))
            item.opacity = float(random_.uniform(0, 1));
        return item;
    }

    /// So far that a dashed stroke would have more dashes than are worth looking at.
    bool reachesFar(const Path& path) const {
        const auto far = [&](Point p) { return std::max(std::abs(p.x), std::abs(p.y)) > 4 * side_; };
        return std::ranges::any_of(path, [&](const Command& command) {
            const auto* line = std::get_if<LineTo>(&command);
            const auto* cubic = std::get_if<CubicTo>(&command);
            return (line && far(line->to)) || (cubic && (far(cubic->control1) || far(cubic->to)));
        });
    }

    std::shared_ptr<const Path> outline() {
        last_ = randomOutline(random_, side_, last_);
        return std::make_shared<Path>(last_);
    }

    /// Mostly none; else any that keeps the picture about where it is, or turns it over.
    Affine transform() {
        if (!random_.chance(transformed))
            return identity;
        const double angle = random_.uniform(0, 2 * std::numbers::pi);
        const double sx = random_.uniform(0.3, 1.5),
                     sy = random_.uniform(0.3, 1.5) * (random_.chance(0.3) ? -1 : 1);
        const Point x = sx * Point(std::cos(angle), std::sin(angle));
        const Point y = sy * Point(-std::sin(angle + 0.3), std::cos(angle + 0.3));
        const Point centre = Point(side_ / 2);
        return {x, y, centre - centre.x * x - centre.y * y};
    }

    StrokeStyle style(const Path& path) {
        StrokeStyle style;
        style.width = random_.magnitude(1e-4, 0.3) * side_;
        style.cap = random_.any(Cap::Square);
        style.join = random_.any(Join::Bevel);
        style.miterLimit = random_.magnitude(1, 20);
        if (random_.chance(dashed) && !reachesFar(path)) {
            for (int i = random_.integer(1, 2); i > 0; --i) {
                style.dashes.push_back(random_.chance(0.2) ? 0 : random_.uniform(0, 0.2) * side_);
                style.dashes.push_back(random_.uniform(shortestDash, 0.2) * side_);
            }
            style.dashPhase = random_.uniform(-1, 1) * side_;
        }
        return style;
    }

    Random random_;
    double side_ = 0;
    int left_ = 0;
    Path last_;
};

}  // namespace

scene::Scene randomScene(std::uint64_t seed) { return SceneMaker(seed).run(); }

}  // namespace vtm::generate
