#include <cmath>
#include <numbers>

#include "scene/center_form.hpp"
#include "svg/geometry/path_data.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/geometry/path_measure.hpp"
#include "svg/geometry/stroke_box.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

using namespace scene;

const ParsedPath parse(std::string_view text) { return parsePathData(text); }
std::size_t commands(std::string_view text) { return parse(text).path.size(); }
template <class T>
T command(std::string_view text, std::size_t index) {
    return std::get<T>(parse(text).path.at(index));
}

TEST(PathData, RelativeCommandsStartAtTheCurrentPoint) {
    expectNear(command<LineTo>("m 10 20 l 1 2", 1).to, {11, 22});
    expectNear(command<LineTo>("M 10 20 h 5 v -5", 2).to, {15, 15});
}
TEST(PathData, MoveToGoesOnAsLines) { expectNear(command<LineTo>("m 1 1 2 2 3 3", 2).to, {6, 6}); }
TEST(PathData, CloseReturnsToTheStart) { expectNear(command<LineTo>("M 1 2 L 5 5 Z l 1 0", 3).to, {2, 2}); }
TEST(PathData, SmoothCubicMirrorsTheControlPoint) {
    expectNear(command<CubicTo>("M 0 0 C 0 1 2 3 4 4 S 8 8 9 9", 2).control1, {6, 5});
    expectNear(command<CubicTo>("M 1 1 S 8 8 9 9", 1).control1, {1, 1});
}
TEST(PathData, SmoothQuadraticMirrorsTheControlPoint) {
    expectNear(command<QuadTo>("M 0 0 Q 1 2 4 0 T 8 0 T 12 0", 3).control, {9, 2 * 1.0});
    expectNear(command<QuadTo>("M 1 1 T 9 9", 1).control, {1, 1});
}
TEST(PathData, SmoothCommandsOfTheOtherKindDoNotMirror) {
    expectNear(command<CubicTo>("M 0 0 Q 1 2 4 0 S 8 8 9 9", 2).control1, {4, 0});
}
TEST(PathData, ArcFlagsNeedNoSeparators) {
    const ArcTo arc = command<ArcTo>("M0 0a10 20 90 1020 30", 1);
    EXPECT_TRUE(arc.largeArc);
    EXPECT_FALSE(arc.sweep);
    expectNear(arc.to, {20, 30});
    EXPECT_NEAR(arc.rotation, std::numbers::pi / 2, 1e-12);
}
TEST(PathData, NumbersMayTouch) { expectNear(command<LineTo>("M.5.5L-1-2", 1).to, {-1, -2}); }
TEST(PathData, DrawsUpToTheFirstError) {
    EXPECT_EQ(commands("M 0 0 L 1 1 L 2"), 2u);
    EXPECT_EQ(commands("M 0 0 L 1 1 X 5 5 L 2 2"), 2u);
    EXPECT_EQ(commands("M 0 0 A 1 1 0 2 0 5 5"), 1u);
    EXPECT_FALSE(parse("M 0 0 L 1 1 L 2").complete);
}
TEST(PathData, MustBeginWithMoveTo) {
    EXPECT_EQ(commands("L 1 1"), 0u);
    EXPECT_FALSE(parse("L 1 1").complete);
    EXPECT_TRUE(parse(" ").complete);
}
/// What relative commands leave when they come back is no segment.
TEST(PathData, ClosingSnapsTheLastDigits) {
    expectNear(command<LineTo>("m 87.413638,64.165656 10,0 0,10 -10.000001,0 z", 3).to,
               {87.413637, 74.165656});
    EXPECT_EQ(command<LineTo>("m 87.413638,64.165656 10,0 0,10 -10,0 0,-9.999999 z", 4).to,
              (Point{87.413638, 64.165656}));
    EXPECT_EQ(command<CubicTo>("m 1,1 10,0 c 0,10 0,10 -10.000001,1e-6 z", 2).to, (Point{1, 1}));
    EXPECT_EQ(command<ArcTo>("m 1,1 10,0 a 5 5 0 0 0 -10.000001,0 z", 2).to, (Point{1, 1}));
    // Edges that somebody drew, and an arc that nearly comes back to where it began.
    EXPECT_NE(command<LineTo>("m 1,1 10,0 0,10 -10.001,-10 z", 3).to, (Point{1, 1}));
    EXPECT_NE(command<LineTo>("m 1,1 1e-7,0 z", 1).to, (Point{1, 1}));
    EXPECT_NE(command<ArcTo>("m 1,1 10,0 -10,0 a 5 5 0 1 1 -0.000001,0 z", 3).to, (Point{1, 1}));
    EXPECT_NE(command<LineTo>("m 1,1 10,0 z l 1e-6,0 z", 3).to, (Point{1, 1}));
}
TEST(PathData, ClosingTwiceIsClosingOnce) { EXPECT_EQ(commands("M 0 0 L 1 1 Z z Z"), 3u); }
TEST(PathData, MalformedDataIsReported) {
    EXPECT_EQ(loadBody("<path d='M 0 0 L 9 9 9' stroke='red'/>").warnings.size(), 1u);
}

TEST(Points, OddNumbersLoseTheLast) { EXPECT_EQ(parsePoints("0,0 1,1 2").path.size(), 2u); }
TEST(Points, StopAtAnError) { EXPECT_EQ(parsePoints("0 0 1 1 x 2 2").path.size(), 2u); }

TEST(PathGeometry, BoxOfACubicIsTight) {
    const Box box = boundingBox(parse("M 0 0 C 0 4 4 4 4 0").path, identity);
    expectNear(box.min, {0, 0});
    expectNear(box.max, {4, 3});
}
TEST(PathGeometry, BoxOfAnArcIsTight) {
    const Box box = boundingBox(parse("M 10 0 A 10 10 0 0 1 -10 0").path, identity);
    expectNear(box.min, {-10, 0});
    expectNear(box.max, {10, 10});
}
TEST(PathGeometry, BoxOfAMappedCircleIsTheEllipses) {
    const Path circle = parse("M 1 0 A 1 1 0 0 1 -1 0 A 1 1 0 0 1 1 0 Z").path;
    const Box box = boundingBox(circle, {1, 1, -1, 1, 0, 0});
    expectNear(box.max, glm::dvec2(std::numbers::sqrt2));
    expectNear(box.min, -glm::dvec2(std::numbers::sqrt2));
}
TEST(PathGeometry, CenterFormMatchesTheEndpoints) {
    const Point from(3, 4), to(-2, 7);
    for (const bool large : {false, true})
        for (const bool sweep : {false, true}) {
            const auto arc = scene::centerForm(from, {{5, 9}, 0.7, large, sweep, to});
            ASSERT_TRUE(arc);
            expectNear(arc->at(arc->start), from);
            expectNear(arc->at(arc->start + arc->sweep), to);
            EXPECT_EQ(arc->sweep > 0, sweep);
            EXPECT_EQ(std::abs(arc->sweep) > std::numbers::pi, large);
        }
}
TEST(PathGeometry, SmallRadiiGrow) {
    const auto arc = scene::centerForm({0, 0}, {{1, 1}, 0, false, true, {10, 0}});
    ASSERT_TRUE(arc);
    expectNear(arc->center, {5, 0});
    EXPECT_NEAR(arc->axisX.x, 5, 1e-12);
}
TEST(PathGeometry, ArcsWithoutARadiusAreLines) {
    EXPECT_FALSE(scene::centerForm({0, 0}, {{0, 5}, 0, false, true, {1, 1}}));
}
TEST(PathGeometry, LengthOfACircle) {
    EXPECT_NEAR(PathMeasure(parse("M 1 0 A 1 1 0 0 1 -1 0 A 1 1 0 0 1 1 0").path).length(),
                2 * std::numbers::pi, 1e-3);
    EXPECT_DOUBLE_EQ(PathMeasure(parse("M 0 0 L 3 4 L 3 0 Z").path).length(), 12);
}
TEST(PathGeometry, MappedArcsStayOnTheEllipse) {
    const Path mapped = mapPath(scaling(2, 3), parse("M 1 0 A 1 1 0 0 1 -1 0").path);
    for (std::size_t i = 1; i < mapped.size(); ++i) {
        const Point p = std::get<CubicTo>(mapped[i]).to;
        EXPECT_NEAR(p.x * p.x / 4 + p.y * p.y / 9, 1, 1e-9);
    }
}

double degrees(glm::dvec2 d) { return std::atan2(d.y, d.x) * 180 / std::numbers::pi; }

TEST(Vertices, DirectionsAreThoseOfTheSegments) {
    const auto vertices = verticesOf(parse("M 0 0 L 5 0 L 5 5").path);
    ASSERT_EQ(vertices.size(), 3u);
    EXPECT_DOUBLE_EQ(degrees(vertices[0].outgoing), 0);
    EXPECT_DOUBLE_EQ(degrees(vertices[1].incoming), 0);
    EXPECT_DOUBLE_EQ(degrees(vertices[1].outgoing), 90);
    EXPECT_DOUBLE_EQ(degrees(vertices[2].incoming), 90);
}
TEST(Vertices, CurvesTakeTheirControlPoints) {
    const auto vertices = verticesOf(parse("M 0 0 C 0 0 0 5 5 5").path);
    EXPECT_DOUBLE_EQ(degrees(vertices[0].outgoing), 90);
    EXPECT_DOUBLE_EQ(degrees(vertices[1].incoming), 0);
}
TEST(Vertices, ArcsTakeTheirTangents) {
    const auto vertices = verticesOf(parse("M 10 0 A 10 10 0 0 1 0 10").path);
    EXPECT_NEAR(degrees(vertices[0].outgoing), 90, 1e-9);
    EXPECT_NEAR(std::abs(degrees(vertices[1].incoming)), 180, 1e-9);
}
Box strokeBoxOf(std::string_view text, Join join, Cap cap) {
    StrokeStyle stroke;
    stroke.width = 2;
    stroke.join = join;
    stroke.cap = cap;
    return strokeBox(parse(text).path, stroke);
}

TEST(StrokeBox, HasJoinsAndCaps) {
    const std::string_view corner = "M 0 0 H 10 V 10";
    const Box butt = strokeBoxOf(corner, Join::Bevel, Cap::Butt);
    expectNear(butt.min, {0, -1});
    expectNear(butt.max, {11, 10});
    const Box square = strokeBoxOf(corner, Join::Miter, Cap::Square);
    expectNear(square.min, {-1, -1});
    expectNear(square.max, {11, 11});
    // The mitre of a right angle that points up is 1 / sin 45° half widths high.
    expectNear(strokeBoxOf("M 0 10 L 10 0 L 20 10", Join::Miter, Cap::Butt).min,
               {-std::sqrt(0.5), -std::numbers::sqrt2});
    expectNear(strokeBoxOf("M 0 10 L 10 0 L 20 10", Join::Round, Cap::Butt).min, {-std::sqrt(0.5), -1});
    expectNear(strokeBoxOf("M 0 10 L 10 0 L 20 10", Join::Bevel, Cap::Butt).min,
               {-std::sqrt(0.5), -std::sqrt(0.5)});
}
TEST(StrokeBox, CurvesTurnBackBetweenTheirEnds) {
    const Box arc = strokeBoxOf("M 0 0 A 10 10 0 0 1 20 0", Join::Miter, Cap::Butt);
    expectNear(arc.min, {-1, -11});
    expectNear(arc.max, {21, 0});
    const Box cubic = strokeBoxOf("M 0 0 C 0 -8 12 -8 12 0", Join::Miter, Cap::Butt);
    expectNear(cubic.min, {-1, -7});
    expectNear(cubic.max, {13, 0});
}
TEST(StrokeBox, ClosedAndEmptySubpaths) {
    const Box closed = strokeBoxOf("M 0 0 H 10 V 10 Z", Join::Miter, Cap::Butt);
    expectNear(closed.max, {11, 10 + 1 + std::numbers::sqrt2});
    EXPECT_TRUE(strokeBoxOf("M 5 5", Join::Miter, Cap::Round).empty());
    EXPECT_TRUE(strokeBoxOf("M 5 5 Z", Join::Miter, Cap::Butt).empty());
    expectNear(strokeBoxOf("M 5 5 Z", Join::Miter, Cap::Round).min, {4, 4});
}

TEST(Vertices, SegmentsWithoutLengthTakeTheirNeighboursDirection) {
    const auto vertices = verticesOf(parse("M 0 0 L 0 0 L 0 5 L 0 5").path);
    EXPECT_DOUBLE_EQ(degrees(vertices[0].outgoing), 90);
    EXPECT_DOUBLE_EQ(degrees(vertices[3].incoming), 90);
}

}  // namespace
}  // namespace vtm::svg
