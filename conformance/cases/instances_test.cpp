// Assets with instances against the same scene without them, and against the reference: random scenes of
// shapes that stand many times, on backgrounds, in groups and clips, in each other, side by side and across
// each other.
//
// VTM_INSTANCE_SCENES=2000 tries that many.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>
#include <string_view>

#include <gtest/gtest.h>

#include <glm/mat2x2.hpp>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/prefilter.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/svg/load.hpp>
#include "asset/instances.hpp"
#include "backend_gl/testing.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"
#include "raster/planar_map.hpp"

namespace vtm::cases {
namespace {

using scene::Affine;
using scene::Color;
using scene::Group;
using scene::Item;
using scene::Path;
using scene::Point;
using scene::Scene;

constexpr double side = 256;

/// Shapes that repeat.
class Repeats {
public:
    explicit Repeats(unsigned seed) : random_(seed) {}

    Scene scene() {
        Scene scene;
        scene.width = scene.height = side;
        background(scene.root);
        const int symbols = 1 + pick(3);
        for (int i = 0; i < symbols; ++i)
            place(symbol(), scene.root);
        if (pick(3) == 0)  // on top of all
            scene.root.children.push_back({item(blob(20 + uniform(100)), at(uniform(side), uniform(side)))});
        return scene;
    }

    /// Groups of groups of shapes that repeat.
    Scene groups() {
        Scene scene;
        scene.width = scene.height = side;
        background(scene.root);
        Group shapes = symbol();
        transform(shapes, scene::scaling(0.25, 0.25));
        Group group;
        const int members = 4 + pick(6);
        for (int i = 0; i < members; ++i) {
            Group member = shapes;
            transform(member, scene::compose(at(6 * (i % 3) + uniform(2), 6 * (i / 3) + uniform(2)),
                                             turned(uniform(7))));
            if (pick(4) == 0)
                std::get<Item>(member.children.front().value).paint = color();
            group.children.push_back({std::move(member)});
        }
        const bool varied = pick(3) == 0;
        for (int i = 0; i < 25; ++i) {
            Group instance = group;
            const Affine to = at(28 + 48 * (i % 5) + uniform(6), 28 + 48 * (i / 5) + uniform(6));
            transform(instance, scene::compose(to, scene::compose(turned(uniform(7)), sizes(varied))));
            if (varied)
                forEachItem(instance, [&](Item& item) { item.paint = color(); });
            if (pick(8) == 0)
                instance.opacity = 0.5f;
            scene.root.children.push_back({std::move(instance)});
        }
        return scene;
    }

    /// Groups that are cut by clips of their own and lie across each other and the picture's borders.
    Scene cut() {
        Scene scene = ground();
        const double step = 20 + uniform(30);
        Group group;
        const int shapes = 2 + pick(2);
        for (int i = 0; i < shapes; ++i)
            group.children.push_back(
                {item(blob((0.1 + uniform(0.3)) * step), at(uniform(step), uniform(step)))});
        auto clip = std::make_shared<scene::Clip>();
        clip->shapes.push_back({pick(2) == 0 ? std::make_shared<const Path>(scene::rectangle(
                                                   {0, 0}, {step, (0.5 + uniform(0.5)) * step}))
                                             : blob((0.3 + uniform(0.5)) * step),
                                scene::identity, scene::FillRule::NonZero, nullptr});
        if (pick(4) != 0)
            group.clip = clip;
        const double jitter = pick(2) * uniform(step);
        for (int i = 0; i < 64; ++i) {
            const Affine to = at(step * (i % 8) - 0.7 * step + uniform(jitter),
                                 step * (i / 8) - 0.6 * step + uniform(jitter));
            Group instance = group;
            transform(instance, to);
            if (group.clip) {
                auto own = std::make_shared<scene::Clip>(*clip);
                own->shapes.front().transform = to;
                instance.clip = own;
            }
            scene.root.children.push_back({std::move(instance)});
        }
        return scene;
    }

    /// A few shapes that do not repeat.
    Scene ground() {
        Scene scene;
        scene.width = scene.height = side;
        background(scene.root);
        return scene;
    }

    /// Shapes that lie in a tile and across its borders.
    Group tile(Point min, Point max) {
        Group group;
        const Point size = max - min;
        for (int i = 0; i < 2; ++i) {
            Item shape = item(blob((0.2 + uniform(0.4)) * std::min(size.x, size.y)),
                              at(min.x + uniform(size.x), min.y + uniform(size.y)));
            if (auto* stroke = std::get_if<scene::StrokeStyle>(&shape.geometry))
                stroke->width *= 0.05 * size.x;
            group.children.push_back({std::move(shape)});
        }
        return group;
    }
    std::shared_ptr<const Path> outline(double radius) { return blob(radius); }

    template <class Visit>
    static void forEachItem(Group& group, const Visit& visit) {
        for (scene::Node& node : group.children)
            if (auto* child = std::get_if<Item>(&node.value))
                visit(*child);
            else
                forEachItem(std::get<Group>(node.value), visit);
    }
    static void transform(Group& group, const Affine& by) {
        forEachItem(group, [&](Item& item) { item.transform = scene::compose(by, item.transform); });
    }

private:
    double uniform(double to) { return std::uniform_real_distribution<double>(0, to)(random_); }
    int pick(int n) { return int(random_() % unsigned(n)); }
    static Affine at(double x, double y) { return scene::translation(x, y); }
    static Affine turned(double angle) {
        return {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0, 0};
    }

    Color color() {
        const float a = pick(3) == 0 ? float(0.3 + uniform(0.5)) : 1.0f;
        return {float(uniform(1)), float(uniform(1)), float(uniform(1)), a};
    }

    std::shared_ptr<const Path> blob(double radius) {
        const int n = 3 + pick(6);
        const double inner = 0.4 + uniform(0.6);
        Path path;
        const bool curved = pick(2) == 0;
        const auto point = [&](double i, double r) {
            const double angle = 2 * std::numbers::pi * i / n;
            return Point(std::cos(angle), std::sin(angle)) * r * radius;
        };
        path.push_back(scene::MoveTo{point(0, 1)});
        for (int i = 0; i < n; ++i) {
            if (curved)
                path.push_back(scene::CubicTo{point(i + 0.2, 1.2), point(i + 0.8, inner), point(i + 1, 1)});
            else {
                path.push_back(scene::LineTo{point(i + 0.5, inner)});
                path.push_back(scene::LineTo{point(i + 1, 1)});
            }
        }
        path.push_back(scene::Close{});
        if (pick(3) == 0) {  // a hole
            for (const double x : {-0.2, 0.2, 0.2, -0.2})
                path.push_back(path.back().index() == 5
                                   ? scene::Command(scene::MoveTo{Point(x, -0.2) * radius})
                                   : scene::Command(scene::LineTo{Point(x, x < 0 ? 0.1 : 0.2) * radius}));
            path.push_back(scene::Close{});
        }
        return std::make_shared<const Path>(std::move(path));
    }

    Item item(std::shared_ptr<const Path> path, const Affine& transform) {
        Item item;
        item.path = std::move(path);
        item.transform = transform;
        item.geometry = scene::FillRule::EvenOdd;
        if (pick(4) == 0) {
            scene::StrokeStyle stroke;
            stroke.width = 0.5 + uniform(3);
            item.geometry = stroke;
        }
        item.paint = color();
        return item;
    }

    void background(Group& root) {
        const int n = pick(4);
        for (int i = 0; i < n; ++i) {
            Item shape = item(blob(30 + uniform(150)), at(uniform(side), uniform(side)));
            if (pick(3) == 0) {
                scene::LinearGradient gradient;
                gradient.start = {0, 0};
                gradient.end = {50, 20};
                gradient.stops = {{0, color()}, {1, color()}};
                shape.paint = gradient;
            }
            root.children.push_back({std::move(shape)});
        }
    }

    Group symbol() {
        Group group;
        const int n = 1 + pick(3);
        const double radius = 2 + uniform(8);
        for (int i = 0; i < n; ++i)
            group.children.push_back({item(blob(radius * (1 - 0.3 * i)), at(uniform(2), uniform(2)))});
        return group;
    }

    /// Mirrored now and then.
    Affine sizes(bool areEqual) {
        const double x = 0.4 + uniform(1), y = areEqual ? x : 0.4 + uniform(1);
        return scene::scaling(x, areEqual && pick(2) == 0 ? -y : y);
    }

    /// With another path instead of the transform, which is a similarity: as programs write it, with four
    /// decimals.
    static Item written(const Item& item, const Affine& by) {
        const auto point = [&](Point p) { return glm::round(scene::apply(by, p) * 1e4) / 1e4; };
        Path path = *item.path;
        for (scene::Command& command : path)
            if (auto* move = std::get_if<scene::MoveTo>(&command))
                move->to = point(move->to);
            else if (auto* line = std::get_if<scene::LineTo>(&command))
                line->to = point(line->to);
            else if (auto* cubic = std::get_if<scene::CubicTo>(&command))
                *cubic = {point(cubic->control1), point(cubic->control2), point(cubic->to)};
        Item result = item;
        result.path = std::make_shared<const Path>(std::move(path));
        result.transform = scene::identity;
        if (auto* stroke = std::get_if<scene::StrokeStyle>(&result.geometry))
            stroke->width *= glm::length(by[0]);
        return result;
    }

    void place(const Group& symbol, Group& root) {
        const bool grid = pick(3) == 0, varied = pick(3) == 0, isWritten = pick(4) == 0;
        const double step = 12 + uniform(30);
        const int count = 10 + pick(90);
        for (int i = 0; i < count; ++i) {
            Group instance = symbol;
            Affine to = at(uniform(side), uniform(side));
            if (grid)
                to = at(step * (0.5 + i % 8), step * (0.5 + i / 8));
            if (!grid || varied)
                to = scene::compose(to, scene::compose(turned(uniform(7)), sizes(isWritten)));
            transform(instance, to);
            if (isWritten)
                forEachItem(instance, [](Item& item) { item = written(item, item.transform); });
            if (varied)
                forEachItem(instance, [&](Item& item) { item.paint = color(); });
            if (pick(8) == 0)
                instance.opacity = 0.5f;
            if (pick(12) == 0)
                instance.blend = scene::BlendMode::Multiply;
            root.children.push_back({std::move(instance)});
        }
    }

    std::mt19937 random_;
};

unsigned innerMaps(const asset::Asset& asset) {
    const std::vector<unsigned> depths = asset::mapDepths(asset);
    return *std::ranges::max_element(depths) - 1;
}

asset::View viewOf(unsigned seed, int pixels, double zoom) {
    asset::View view{pixels, pixels, {}};
    const double angle = seed % 3 == 0 ? 0 : 0.7 * seed, scale = pixels / side * zoom;
    view.toPixels = {scale * std::cos(angle),
                     scale * std::sin(angle),
                     -scale * std::sin(angle),
                     scale * std::cos(angle),
                     0,
                     0};
    view.toPixels[2] =
        glm::dvec2(pixels / 2.0) - glm::dmat2(view.toPixels[0], view.toPixels[1]) * glm::dvec2(side / 2);
    return view;
}

image::Raster referenceOf(const Scene& scene, const asset::View& view) {
    reference::View as;
    as.width = view.width;
    as.height = view.height;
    as.toPixels = view.toPixels;
    return reference::render(scene, as);
}

/// Whether vtm_sample takes some of the picture's colours from its pyramid of means.
bool meetsPrefilter(const asset::Asset& asset, const asset::View& view) {
    const double pixelsPerTexel = std::sqrt(std::abs(glm::determinant(glm::dmat2(view.toPixels)))) *
                                  asset.width / asset::prefilterSize(asset).width;
    return pixelsPerTexel * asset::fadeFrom < 1;
}

unsigned scenes() {
    if (const char* text = std::getenv("VTM_INSTANCE_SCENES"))
        return unsigned(std::strtoul(text, nullptr, 10));
    return std::getenv("VTM_TEST_ALL") ? 200 : 128;
}

/// Compiling the texture's shaders takes a while.
constexpr unsigned glEvery = 8;

TEST(Instances, DrawWhatTheFlatAssetDraws) {
    Gl gl;
    std::size_t withInstances = 0, instances = 0;
    double worst = 0;
    for (unsigned seed = 0; seed < scenes(); ++seed) {
        const Scene scene = Repeats(seed).scene();
        compiler::Options options;
        const asset::Asset placed = compiler::compile(scene, options).asset;
        options.instances = false;
        const asset::Asset flat = compiler::compile(scene, options).asset;
        ASSERT_TRUE(flat.instances.empty());
        withInstances += !placed.instances.empty();
        instances += placed.instances.size();
        const asset::Asset again = asset::read(asset::write(placed));
        const asset::Scanner scanner(again), flatScanner(flat);
        const bool withGl = seed % glEvery == 0 && !placed.instances.empty();
        std::optional<gl::test::TextureCanvas> texture, flatTexture;
        if (withGl) {
            texture.emplace(again);
            flatTexture.emplace(flat);
        }
        for (const auto& [pixels, zoom] : {std::pair(160, 1.0), std::pair(48, 1.0), std::pair(96, 6.0)}) {
            SCOPED_TRACE(fmt::format("scene {} on {} pixels, zoom {}", seed, pixels, zoom));
            const asset::View view = viewOf(seed, pixels, zoom);
            const image::Raster drawn = scanner.draw(view), evaluated = asset::evaluate(again, view),
                                truth = referenceOf(scene, view);
            EXPECT_LE(compare::compare(drawn, evaluated).max, assetMax);
            const double difference = compare::compare(drawn, truth).max;
            const double flatDifference = compare::compare(flatScanner.draw(view), truth).max;
            EXPECT_LE(difference, std::max(referenceMax, flatDifference + 1));
            worst = std::max(worst, difference);
            if (!withGl)
                continue;
            const auto glDifference = [&](const asset::Asset& of) {
                return compare::compare(gl.render(of, view), truth).max;
            };
            EXPECT_LE(glDifference(again), std::max(referenceMax, glDifference(flat) + 1));
            if (!meetsPrefilter(again, view)) {
                const auto textureDifference = [&](gl::test::TextureCanvas& of) {
                    return compare::compare(of.draw(view), truth).max;
                };
                EXPECT_LE(textureDifference(*texture),
                          std::max(referenceMax, textureDifference(*flatTexture) + 1));
            }
        }
        if (HasFailure())
            return;
    }
    fmt::print("{} of {} scenes have instances, {} in all; largest difference {:.2f}/255\n", withInstances,
               scenes(), instances, worst);
    EXPECT_GT(withInstances, scenes() / 2);
}

TEST(Instances, GroupsThatRepeatAreMapsOfMaps) {
    Gl gl;
    std::size_t nested = 0;
    double worst = 0;
    for (unsigned seed = 0; seed < scenes() / 8; ++seed) {
        const Scene scene = Repeats(seed).groups();
        const asset::Asset placed = compiler::compile(scene).asset;
        const bool isNested = innerMaps(placed) > 1;
        nested += isNested;
        const asset::Scanner scanner(placed);
        for (const auto& [pixels, zoom] : {std::pair(128, 1.0), std::pair(40, 1.0), std::pair(96, 7.0)}) {
            SCOPED_TRACE(fmt::format("scene {} on {} pixels, zoom {}", seed, pixels, zoom));
            const asset::View view = viewOf(seed, pixels, zoom);
            const image::Raster drawn = scanner.draw(view);
            EXPECT_LE(compare::compare(drawn, asset::evaluate(placed, view)).max, assetMax);
            const double error = compare::compare(drawn, referenceOf(scene, view)).max;
            EXPECT_LE(error, referenceMax);
            worst = std::max(worst, error);
            if (seed % 8 == 1) {
                EXPECT_LE(compare::compare(gl.render(placed, view), drawn).max, referenceMax);
            }
            if (seed % 16 == 1 && zoom > 1 && !meetsPrefilter(placed, view)) {
                compiler::Options options;
                options.instances = false;
                const auto difference = [&](const asset::Asset& of) {
                    return compare::compare(gl::test::TextureCanvas(of).draw(view), drawn).max;
                };
                EXPECT_LE(difference(placed),
                          std::max(referenceMax, difference(compiler::compile(scene, options).asset) + 1));
            }
        }
    }
    fmt::print("{} of {} scenes have maps in maps; largest difference {:.2f}/255\n", nested, scenes() / 8,
               worst);
    EXPECT_GT(nested, scenes() / 32);
}

/// A pattern of many tiles, turned and skewed, that fills a shape over a background and below another shape;
/// now and then two of them across each other.
Scene patterned(unsigned seed, double smallest, double largest) {
    std::mt19937 random(seed);
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    Scene scene = Repeats(seed).ground();
    const int patterns = 1 + int(seed % 4 == 0);
    for (int i = 0; i < patterns; ++i) {
        scene::Pattern pattern;
        pattern.min = {uniform(-3, 3), uniform(-3, 3)};
        pattern.max = pattern.min + Point(uniform(smallest, largest), uniform(smallest, largest));
        pattern.content = std::make_shared<const Group>(Repeats(seed + 77).tile(pattern.min, pattern.max));
        if (seed % 2 == 1) {
            const double angle = uniform(0, 3);
            pattern.transform = {std::cos(angle), std::sin(angle), -std::sin(angle) * 0.8,
                                 std::cos(angle), uniform(0, 9),   uniform(0, 9)};
        }
        Item filled;
        const double r = uniform(60, 120);
        filled.path = seed % 3 == 0 ? std::make_shared<const Path>(scene::rectangle({-r, -r}, {r, r}))
                                    : Repeats(seed + 99).outline(r);
        filled.transform = scene::translation(side / 2 + 20 * i, side / 2);
        filled.geometry = scene::FillRule::NonZero;
        filled.paint = pattern;
        filled.opacity = seed % 5 == 0 ? 0.6f : 1.0f;
        const auto at = std::ptrdiff_t(random() % (scene.root.children.size() + 1));
        scene.root.children.insert(scene.root.children.begin() + at, scene::Node{std::move(filled)});
    }
    return scene;
}

/// Shapes whose paths differ in their size alone: hatching, as drawings of waveforms have it.
TEST(Instances, SizesAreNotMixedUp) {
    Scene scene;
    scene.width = scene.height = side;
    scene::StrokeStyle stroke;
    stroke.cap = scene::Cap::Round;
    for (int i = 0; i < 200; ++i) {
        const double length = std::ldexp(3, i % 3);
        Item line;
        line.path = std::make_shared<const Path>(
            Path{scene::MoveTo{{0, 0}}, scene::CubicTo{{length, 0}, {0, length / 2}, {length, length}}});
        line.transform = scene::translation(6 + 12 * (i % 20), 6 + 24 * (i / 20));
        line.geometry = stroke;
        line.paint = Color{0, 0, 0, 1};
        scene.root.children.push_back({line});
    }
    const asset::Asset placed = compiler::compile(scene).asset;
    EXPECT_GE(placed.instances.size(), 60u);
    const asset::View view = viewOf(0, 512, 1);
    EXPECT_LE(compare::compare(asset::Scanner(placed).draw(view), referenceOf(scene, view)).max,
              referenceMax);
}

/// Tall and wide shapes at the picture's borders, whose squares reach beyond it.
TEST(Instances, LieAtTheBorders) {
    Scene scene;
    scene.width = side;
    scene.height = side / 2;
    for (int i = 0; i < 40; ++i) {
        Item shape;
        const bool tall = i % 2 == 0;
        shape.path = std::make_shared<const Path>(
            Path{scene::MoveTo{{0, 0}}, scene::CubicTo{{30, 1}, {30, 3}, {60, 4}}, scene::LineTo{{57, 4}},
                 scene::CubicTo{{33, 3}, {27, 1}, {0, 4}}, scene::Close{}});
        const Affine wide =
                         scene::translation((i / 2) % 4 * 64 + (i / 2 % 4 == 3 ? 4 : 0), 5.5 * (i / 2) + 4),
                     upright = scene::compose(
                         scene::translation(i / 2 % 2 == 0 ? 4 + i : side - i, 64 * (i % 4 / 2)),
                         Affine{0, 1, -1, 0, 0, 0});
        shape.transform = tall ? upright : wide;
        shape.geometry = scene::FillRule::NonZero;
        shape.paint = Color{0.5f, 0, 0.2f, 1};
        scene.root.children.push_back({shape});
    }
    const asset::Asset placed = compiler::compile(scene).asset;
    EXPECT_GT(placed.instances.size(), 10u);
    for (const unsigned seed : {0u, 1u}) {
        const asset::View view = viewOf(seed, 400, 0.9);
        EXPECT_LE(compare::compare(asset::Scanner(placed).draw(view), referenceOf(scene, view)).max,
                  referenceMax);
    }
}

TEST(Instances, PatternsArePlaced) {
    Gl gl;
    std::size_t nested = 0;
    double worst = 0;
    for (unsigned seed = 0; seed < scenes() / 8; ++seed) {
        const Scene scene = patterned(seed, 1.5, 5);
        const asset::Asset placed = compiler::compile(scene).asset;
        nested += innerMaps(placed) > 1;
        const asset::Scanner scanner(placed);
        for (const auto& [pixels, zoom] : {std::pair(128, 1.0), std::pair(96, 5.0)}) {
            SCOPED_TRACE(fmt::format("scene {} on {} pixels, zoom {}", seed, pixels, zoom));
            const asset::View view = viewOf(seed, pixels, zoom);
            const image::Raster drawn = scanner.draw(view);
            EXPECT_LE(compare::compare(drawn, asset::evaluate(placed, view)).max, assetMax);
            const double difference = compare::compare(drawn, referenceOf(scene, view)).max;
            EXPECT_LE(difference, referenceMax);
            worst = std::max(worst, difference);
            if (seed % 8 == 1) {
                EXPECT_LE(compare::compare(gl.render(placed, view), drawn).max, referenceMax);
            }
            if (seed == 1 && zoom > 1) {
                EXPECT_LE(compare::compare(gl::test::TextureCanvas(placed).draw(view), drawn).max,
                          referenceMax);
            }
        }
    }
    fmt::print("{} of {} scenes have maps in maps; largest difference {:.2f}/255\n", nested, scenes() / 8,
               worst);
    EXPECT_GT(nested, scenes() / 32);
}

/// Also tiles of patterns that are few. What a clip cuts must not appear, and what lies outside of the
/// picture at one place must at the others.
TEST(Instances, ClipsAndBordersCutThem) {
    std::size_t withInstances = 0;
    double worst = 0;
    for (unsigned seed = 0; seed < scenes() / 2; ++seed) {
        const Scene scene = seed % 2 == 0 ? Repeats(seed).cut() : patterned(seed, 12, 40);
        const asset::Asset placed = compiler::compile(scene).asset;
        withInstances += !placed.instances.empty();
        const asset::View view = viewOf(seed, 160, 1);
        const double difference =
            compare::compare(asset::Scanner(placed).draw(view), referenceOf(scene, view)).max;
        EXPECT_LE(difference, referenceMax) << "scene " << seed;
        worst = std::max(worst, difference);
    }
    fmt::print("{} of {} scenes have instances; largest difference {:.2f}/255\n", withInstances, scenes() / 2,
               worst);
    EXPECT_GT(withInstances, scenes() / 16);
}

/// Two that were wrong: a tile's clip was taken for a part of the tile before, and of a shape that lies
/// outside of the picture at one place nothing was left at the others.
TEST(Instances, ClipsAndBordersCutTheseToo) {
    for (
        const std::string_view text :
        {R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200"><pattern id="p" width="27.85"
             height="25.89" viewBox="0 0 40 40" patternUnits="userSpaceOnUse"><rect width="6.86"
             height="9.45"/><circle cy="15" r="3.53"/></pattern><circle r="40.51"/><path fill="url(#p)"
             d="M136.34 157.54 13.62 28.54 148.78 29.16z"/></svg>)svg",
         R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200"><defs><g id="s"><ellipse cy="26.57"
             ry="2.63"/><path d="M-4 2c2.63-13 13-9 17.5 0s-9 12.25-17.5 0z"/></g></defs><use href="#s"
             transform="translate(40 4) scale(.93)"/><use href="#s" transform="translate(75-11) scale(.83)"/><use
             href="#s" transform="translate(150 150) scale(.88)"/></svg>)svg"}) {
        const Scene scene =
            svg::load({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).scene;
        const asset::View view{200, 200, scene::identity};
        EXPECT_LE(compare::compare(asset::Scanner(compiler::compile(scene).asset).draw(view),
                                   referenceOf(scene, view))
                      .max,
                  referenceMax);
    }
}

TEST(Instances, FourThousandShapesInGroupsOfGroupsAreAFewKilobytes) {
    const auto outline = Repeats(5).outline(1);
    const auto grid = [](const scene::Node& node, double step) {
        Group group;
        for (int i = 0; i < 16; ++i) {
            Group member;
            member.children.push_back(node);
            const Affine to =
                scene::compose(scene::translation(step * (i % 4) + 0.1 * step * (i / 4), step * (i / 4)),
                               scene::scaling(0.8, 0.8));
            Repeats::transform(member, to);
            group.children.push_back({std::move(member)});
        }
        return scene::Node{std::move(group)};
    };
    Item shape;
    shape.path = outline;
    shape.geometry = scene::FillRule::NonZero;
    shape.paint = Color{0, 0, 0, 1};
    Scene scene;
    scene.width = scene.height = side;
    scene.root.children.push_back(grid(grid(grid({shape}, 3), 12), 48));
    Repeats::transform(scene.root, scene::translation(10, 10));
    const asset::Asset placed = compiler::compile(scene).asset;
    EXPECT_GE(innerMaps(placed), 2u);
    EXPECT_LE(asset::write(placed).size(), 8192u);
    const asset::View view = viewOf(0, 300, 1);
    EXPECT_LE(compare::compare(asset::Scanner(placed).draw(view), referenceOf(scene, view)).max,
              referenceMax);
}

TEST(Instances, AMillionTilesAreAFewKilobytes) {
    scene::Pattern pattern{{0, 0}, {1, 1}, nullptr, scene::identity};
    Item tile;
    tile.path = std::make_shared<const Path>(scene::rectangle({0.1, 0.2}, {0.6, 0.9}));
    tile.geometry = scene::FillRule::NonZero;
    tile.paint = Color{0, 0, 0, 1};
    Group content;
    content.children.push_back({tile});
    pattern.content = std::make_shared<const Group>(std::move(content));
    Scene scene;
    scene.width = scene.height = 1000;
    Item filled;
    filled.path = std::make_shared<const Path>(scene::rectangle({0, 0}, {1000, 1000}));
    filled.geometry = scene::FillRule::NonZero;
    filled.paint = pattern;
    scene.root.children.push_back({filled});
    EXPECT_LE(asset::write(compiler::compile(scene).asset).size(), 65536u);
}

/// The whole asset as a map that is placed a few times in a new one: smaller, turned, one with other colours.
asset::Asset wrapped(asset::Asset asset, std::mt19937& random) {
    const auto paints = std::uint16_t(asset.paints.size());
    asset.paints.push_back({0x3F000000u, 0, 0x3F000000u, 0x3F800000u});
    for (asset::Symbol& symbol : asset.symbols)
        ++symbol.map;
    const auto symbols = std::uint16_t(asset.symbols.size());
    const auto palette = std::uint32_t(asset.palettes.size());
    for (std::uint16_t i = 1; i < paints; ++i)
        asset.palettes.push_back(i);
    for (std::uint16_t i = 1; i < paints; ++i)
        asset.palettes.push_back(i % 2 == 0 ? i : paints);
    asset.symbols.push_back({1, 0, palette, 0.5f, 0});
    asset.symbols.push_back({1, 0, palette + paints - 1, 0.5f, 0});
    const auto firstInstance = std::uint32_t(asset.instances.size());
    const double sizes[] = {0.9, 0.5, 0.7};
    for (unsigned i = 0; i < 3; ++i) {
        const double angle = std::uniform_real_distribution<double>(0, 6)(random);
        const auto coefficient = [&](double value) {
            return std::int16_t(std::lround(sizes[i] * value * double(asset::slopeScale)));
        };
        const std::uint32_t at = 1u << 22;  // a fourth of the side
        asset.instances.push_back(asset::Instance::make(
            std::uint16_t(symbols + i % 2), {at + 2 * at * (i % 2), at + 2 * at * (i / 2)},
            {coefficient(std::cos(angle)), coefficient(std::sin(angle)), coefficient(-0.8 * std::sin(angle)),
             coefficient(0.8 * std::cos(angle))}));
    }
    asset.instanceTrees.push_back({asset::InstanceRange::entry(firstInstance, 3), 0.5f, 0, 0});
    asset::Map root{0, 0, side, asset::Entry::make(asset::Entry::Kind::Solid, 0),
                    std::uint32_t(asset.instanceTrees.size())};
    asset.maps.insert(asset.maps.begin(), root);
    return asset;
}

TEST(Instances, MayBeNested) {
    Gl gl;
    for (unsigned seed = 0; seed < 6; ++seed) {
        std::mt19937 random(seed);
        asset::Asset nested = compiler::compile(Repeats(seed).scene()).asset;
        for (unsigned depth = 2; depth < asset::maxMapDepth && depth < 3 + seed; ++depth) {
            nested = wrapped(std::move(nested), random);
            SCOPED_TRACE(fmt::format("scene {}, depth {}", seed, depth));
            const asset::View view = viewOf(seed + depth, 96, 1.0 + 0.5 * depth);
            const asset::Asset again = asset::read(asset::write(nested));
            const image::Raster drawn = asset::Scanner(again).draw(view);
            EXPECT_LE(compare::compare(drawn, asset::evaluate(again, view)).max, assetMax);
            if (depth <= 4) {  // then a million pieces, and three times as many with every depth
                EXPECT_LE(
                    compare::compare(drawn, asset::Scanner(asset::planarMaps(again), again).draw(view)).max,
                    assetMax);
            }
            EXPECT_LE(compare::compare(drawn, gl.render(again, view)).max, referenceMax);
            if (depth == 3) {  // close enough for the prefilter to have no share
                const asset::View close = viewOf(seed, 96, 12);
                EXPECT_LE(compare::compare(asset::Scanner(again).draw(close),
                                           gl::test::TextureCanvas(again).draw(close))
                              .max,
                          referenceMax);
            }
        }
    }
}

}  // namespace
}  // namespace vtm::cases
