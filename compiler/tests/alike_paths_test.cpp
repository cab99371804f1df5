// Paths that are images of each other, as programs write them with so many decimals, and paths that are not.

#include "compiler/instances/alike_paths.hpp"

#include <cmath>
#include <deque>
#include <random>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Path;
using scene::Point;

constexpr double slack = 1e-3, decimals = 1e3;

Path randomPath(std::mt19937& random) {
    const auto point = [&] {
        std::uniform_real_distribution<double> uniform(-40, 40);
        return Point(uniform(random), uniform(random));
    };
    Path path{scene::MoveTo{point()}};
    for (int i = 0; i < 6; ++i)
        if (random() % 2 == 0)
            path.push_back(scene::LineTo{point()});
        else
            path.push_back(scene::CubicTo{point(), point(), point()});
    path.push_back(scene::Close{});
    return path;
}

Path mapped(const Path& path, const Affine& by) {
    const auto point = [&](Point p) { return glm::round(scene::apply(by, p) * decimals) / decimals; };
    Path image = path;
    for (scene::Command& command : image)
        if (auto* move = std::get_if<scene::MoveTo>(&command))
            move->to = point(move->to);
        else if (auto* line = std::get_if<scene::LineTo>(&command))
            line->to = point(line->to);
        else if (auto* cubic = std::get_if<scene::CubicTo>(&command))
            *cubic = {point(cubic->control1), point(cubic->control2), point(cubic->to)};
    return image;
}

Affine similarity(double scale, double angle, bool isMirrored, Point offset) {
    const Point x = scale * Point(std::cos(angle), std::sin(angle)), y(-x.y, x.x);
    return {x, isMirrored ? -y : y, offset};
}

/// Keeps the paths that it is given.
class Paths {
public:
    AlikePaths::Image add(Path path, double within) {
        return alike_.add(paths_.emplace_back(std::move(path)), within);
    }

private:
    std::deque<Path> paths_;
    AlikePaths alike_;
};

TEST(AlikePaths, AreImagesOfEachOther) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    Paths paths;
    for (std::uint32_t kind = 0; kind < 50; ++kind) {
        const Path path = randomPath(random);
        const AlikePaths::Image first = paths.add(path, slack);
        EXPECT_EQ(first.kind, kind);
        for (int i = 0; i < 20; ++i) {
            const Affine by = similarity(0.3 + 2 * uniform(random), 7 * uniform(random), i % 2 == 1,
                                         {300 * uniform(random), 300 * uniform(random)});
            const AlikePaths::Image image = paths.add(mapped(path, by), slack);
            ASSERT_EQ(image.kind, kind) << i;
            EXPECT_NEAR(image.scale, glm::length(by[0]), 1e-3);
            for (const Point p : {Point(0, 0), Point(first.size, 0), Point(0, first.size)})
                EXPECT_LT(glm::distance(scene::apply(image.fromKind, p),
                                        scene::apply(scene::compose(by, first.fromKind), p)),
                          4 * slack);
        }
    }
}

TEST(AlikePaths, AreMovedByTheirExactTurns) {
    std::mt19937 random(2);
    Paths paths;
    const Path path = randomPath(random);
    const Affine first = paths.add(path, slack).fromKind;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const Affine by = similarity(1, std::acos(-1) / 2 * quarter, false, {100, 7});
        const AlikePaths::Image image = paths.add(mapped(path, by), slack);
        EXPECT_EQ(image.kind, 0u);
        EXPECT_EQ(image.scale, 1);
        EXPECT_EQ(image.fromKind[0], glm::round(by[0])) << quarter;
    }
    EXPECT_EQ(first[0], Point(1, 0));
}

TEST(AlikePaths, DifferByMoreThanTheSlack) {
    std::mt19937 random(3);
    Paths paths;
    Path path = randomPath(random);
    paths.add(path, slack);
    std::get<scene::MoveTo>(path.front()).to.x += 0.1;
    EXPECT_EQ(paths.add(path, slack).kind, 1u);
    path.pop_back();
    EXPECT_EQ(paths.add(path, slack).kind, 2u) << "open";
    const Path ellipse{scene::MoveTo{{0, 0}}, scene::ArcTo{{5, 4}, 0, false, true, {6, 0}}};
    Path other = ellipse;
    std::get<scene::ArcTo>(other.back()).radii.y = 4.1;
    EXPECT_EQ(paths.add(ellipse, slack).kind, 3u);
    EXPECT_EQ(paths.add(other, slack).kind, 4u);
    std::get<scene::ArcTo>(other.back()) = {{5, 4}, 0, true, true, {6, 0}};
    EXPECT_EQ(paths.add(other, slack).kind, 5u);
}

/// Many of one kind of drawing: stars with eight points, the inner radius as they like.
TEST(AlikePaths, AreFoundAmongManyOfTheirCommands) {
    const auto star = [](double inner) {
        Path path;
        for (int i = 0; i < 16; ++i) {
            const double angle = std::acos(-1) / 8 * i, radius = i % 2 == 0 ? 10 : inner;
            const Point p = radius * Point(std::cos(angle), 0.7 * std::sin(angle));
            path.push_back(i == 0 ? scene::Command(scene::MoveTo{p}) : scene::Command(scene::LineTo{p}));
        }
        return path;
    };
    Paths paths;
    constexpr std::uint32_t count = 1000;
    const auto innerOf = [](std::uint32_t i) { return 1 + 8.0 * i / count; };
    for (std::uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(paths.add(star(innerOf(i)), slack).kind, i);
    for (std::uint32_t i = 0; i < count; ++i)
        EXPECT_EQ(
            paths.add(mapped(star(innerOf(i)), similarity(1.5, 0.1 * i, i % 2 == 0, {200, 3})), slack).kind,
            i);
}

TEST(AlikePaths, ArcsTurn) {
    Paths paths;
    paths.add({scene::MoveTo{{0, 0}}, scene::ArcTo{{5, 4}, 0.3, false, true, {6, 0}}}, slack);
    const double quarter = std::acos(-1) / 2;
    EXPECT_EQ(
        paths.add({scene::MoveTo{{9, 9}}, scene::ArcTo{{10, 8}, 0.3 + quarter, false, true, {9, 21}}}, slack)
            .kind,
        0u);
    EXPECT_EQ(
        paths.add({scene::MoveTo{{9, 9}}, scene::ArcTo{{5, 4}, -0.3, false, false, {15, 9}}}, slack).kind, 0u)
        << "mirrored";
}

TEST(AlikePaths, OfOnePoint) {
    Paths paths;
    EXPECT_EQ(paths.add({scene::MoveTo{{3, 4}}, scene::LineTo{{3, 4}}}, slack).kind, 0u);
    EXPECT_EQ(paths.add({scene::MoveTo{{8, 4}}, scene::LineTo{{8, 4}}}, slack).kind, 0u);
    EXPECT_EQ(paths.add({scene::MoveTo{{8, 4}}, scene::LineTo{{9, 4}}}, slack).kind, 1u);
}

}  // namespace
}  // namespace vtm::compiler
