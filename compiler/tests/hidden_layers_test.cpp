// Layers that others hide: of outlines that nearly coincide most, and none that shows at some point.

#include "compiler/direct/hidden_layers.hpp"

#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <glm/common.hpp>

#include <vtm/scene/scene.hpp>
#include "compiler/lower/lower.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {
namespace {

using scene::Point;

/// So many that squares are as small as they may be.
constexpr int side = 128, count = 10'000;

struct Shape {
    std::vector<Point> corners;
    float alpha;

    /// By the even-odd rule.
    bool contains(Point p) const {
        bool isInside = false;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Point a = corners[i], b = corners[(i + 1) % corners.size()];
            if ((a.y <= p.y) != (b.y <= p.y) && a.x + (p.y - a.y) * ((b.x - a.x) / (b.y - a.y)) < p.x)
                isInside = !isInside;
        }
        return isInside;
    }
};

class Numbers {
public:
    explicit Numbers(unsigned seed) : random_(seed) {}
    double number(double from, double to) { return from + (to - from) * double(random_()) / 4294967296.0; }

private:
    std::mt19937 random_;
};

/// Each corner is within `apart` of where that of the others is.
std::vector<Shape> nearlyEqualShapes(const std::vector<Point>& corners, double apart, Numbers& numbers) {
    std::vector<Shape> shapes(count);
    for (Shape& shape : shapes) {
        shape.alpha = float(numbers.number(0.3, 1));
        const Point moved(numbers.number(-apart, apart), numbers.number(-apart, apart));
        for (const Point& corner : corners)
            shape.corners.push_back(corner + moved +
                                    Point(numbers.number(-apart, apart), numbers.number(-apart, apart)));
    }
    return shapes;
}

/// With corners anywhere.
std::vector<Shape> randomShapes(Numbers& numbers) {
    std::vector<Shape> shapes(count);
    for (Shape& shape : shapes) {
        shape.alpha = float(numbers.number(0.3, 1));
        for (int corner = 0; corner < 4; ++corner)
            shape.corners.emplace_back(numbers.number(-20, side + 20), numbers.number(-20, side + 20));
    }
    return shapes;
}

scene::Scene sceneOf(const std::vector<Shape>& shapes) {
    scene::Scene scene;
    scene.width = scene.height = side;
    for (const Shape& shape : shapes) {
        scene::Path path{scene::MoveTo{shape.corners[0]}};
        for (std::size_t i = 1; i < shape.corners.size(); ++i)
            path.push_back(scene::LineTo{shape.corners[i]});
        path.push_back(scene::Close{});
        scene::Item item;
        item.path = std::make_shared<const scene::Path>(std::move(path));
        item.geometry = scene::FillRule::EvenOdd;
        item.paint = scene::Color{0, 0, 0, shape.alpha};
        scene.root.children.push_back({item});
    }
    return scene;
}

Point pointNearAnEdge(const std::vector<Shape>& shapes, Numbers& numbers) {
    const auto one = [&](std::size_t of) { return std::size_t(numbers.number(0, double(of))); };
    const std::vector<Point>& corners = shapes[one(shapes.size())].corners;
    const std::size_t from = one(corners.size());
    const Point onEdge = glm::mix(corners[from], corners[(from + 1) % corners.size()], numbers.number(0, 1));
    return onEdge + Point(numbers.number(-0.3, 0.3), numbers.number(-0.3, 0.3));
}

/// The share of the chains in bands that are hidden. Checks some points.
double hiddenShare(const std::vector<Shape>& shapes, Numbers& numbers) {
    const scene::Scene scene = sceneOf(shapes);
    const Lattice lattice(side, side, 20);
    const LoweredScene picture =
        lower(scene, wholeOf(scene), lattice, ErrorBudget(1.0 / 4096, 20), Sharing::All);
    const ViewChains chains(picture, lattice, {side, side});
    const HiddenLayers hidden(picture, chains, side, side);
    for (int i = 0; i < 1000; ++i) {
        const Point p = pointNearAnEdge(shapes, numbers);
        if (p.x < 0 || p.y < 0 || p.x >= side || p.y >= side)
            continue;
        float light = 1;
        for (std::size_t item = shapes.size(); item-- > 0 && light > 2 * unseen;)
            if (shapes[item].contains(p)) {
                EXPECT_FALSE(hidden.isHidden(picture.items[item].layer, int(p.y) / asset::bandRows))
                    << item << " at " << p.x << ", " << p.y;
                light *= 1 - shapes[item].alpha;
            }
    }
    return double(hidden.hiddenInBands()) / double(chains.inBands());
}

/// Of upright squares those under slanting sides would hide half of them at most.
TEST(HiddenLayers, AreMostOfNearlyEqualOutlines) {
    Numbers numbers(1);
    constexpr double share = 2.0 / 3;
    // Sides go up and down, and slant either way.
    EXPECT_GE(hiddenShare(nearlyEqualShapes({{20, 4}, {90, 5}, {92, 124}, {19, 125}}, 0.5, numbers), numbers),
              share);
    EXPECT_GE(hiddenShare(nearlyEqualShapes({{64, 3}, {125, 66}, {66, 124}, {4, 61}}, 0.5, numbers), numbers),
              share);
    EXPECT_GE(
        hiddenShare(nearlyEqualShapes({{5, 10}, {60, 12}, {124, 120}, {70, 118}}, 0.5, numbers), numbers),
        share);
    // Four sides side by side: all of them tell.
    EXPECT_GE(
        hiddenShare(nearlyEqualShapes({{4, 4}, {28, 4}, {64, 92}, {100, 4}, {124, 4}, {76, 124}, {52, 124}},
                                      0.5, numbers),
                    numbers),
        share);
}

/// What lies beside the picture shows nowhere.
TEST(HiddenLayers, AreMostThatReachBeyondThePicture) {
    Numbers numbers(5);
    for (const bool isCut : {false, true}) {  // at the right side and at the bottom, in the picture
        std::vector<Shape> shapes(count);
        for (Shape& shape : shapes) {
            const auto beyond = [&] { return side + numbers.number(1, 40); };
            const auto end = [&] { return isCut ? numbers.number(side / 2, side) : beyond(); };
            const double right = end(), bottom = end();
            shape.alpha = 0.5;
            shape.corners = {{-beyond() + side, -beyond() + side},
                             {right, -beyond() + side},
                             {right, bottom},
                             {-beyond() + side, bottom}};
        }
        EXPECT_GE(hiddenShare(shapes, numbers), isCut ? 0.5 : 0.999);
    }
}

TEST(HiddenLayers, ShowNowhere) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        Numbers numbers(seed);
        hiddenShare(randomShapes(numbers), numbers);
        std::vector<Point> corners;
        for (int i = 0; i < 7; ++i)
            corners.emplace_back(numbers.number(-10, side + 10), numbers.number(-10, side + 10));
        hiddenShare(nearlyEqualShapes(corners, numbers.number(0.01, 2), numbers), numbers);
    }
}

}  // namespace
}  // namespace vtm::compiler
