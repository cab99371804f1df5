#include "conformance/generate/src/hard/families.hpp"

#include "conformance/generate/generate.hpp"

namespace vtm::generate {

using namespace scene;

scene::Path circle(Point centre, Point radii) {
    const Point left = centre - Point(radii.x, 0), right = centre + Point(radii.x, 0);
    return {MoveTo{left}, ArcTo{radii, 0, false, true, right}, ArcTo{radii, 0, false, true, left}, Close{}};
}

Color Sketch::color() {
    const auto channel = [&] { return float(random.integer(0, 255)) / 255; };
    const float r = channel(), g = channel(), b = channel();
    return {r, g, b, random.chance(0.5) ? 1 : channel()};
}

Item& Sketch::add(Path path, std::variant<FillRule, StrokeStyle> geometry, Group* group) {
    auto& children = (group ? *group : scene.root).children;
    children.push_back(
        {Item{std::make_shared<Path>(std::move(path)), identity, std::move(geometry), color()}});
    return std::get<Item>(children.back().value);
}

Path Sketch::anyCircle(double smallest) {
    const Point centre = inside();
    return circle(centre, random.point(smallest, 0.5) * size());
}

Path Sketch::anyRectangle() {
    const Point corner = point();
    return rectangle(corner, point());
}

StrokeStyle Sketch::style(double thinnest, double widest, double length) {
    StrokeStyle style;
    style.width = random.magnitude(thinnest, widest) * length;
    style.cap = random.any(Cap::Square);
    style.join = random.any(Join::Bevel);
    style.miterLimit = random.magnitude(1, 100);
    return style;
}

namespace {

constexpr Family families[] = {{"slivers", slivers},
                               {"fans", fans},
                               {"nearly-coincident", nearlyCoincident},
                               {"cusps", cusps},
                               {"concentric", concentric},
                               {"self-overlaps", selfOverlaps},
                               {"huge", huge},
                               {"tiny", tiny},
                               {"hairline-grids", hairlineGrids},
                               {"abutting", abutting},
                               {"hairlines", hairlines},
                               {"dashes", dashes},
                               {"stroked-arcs", strokedArcs},
                               {"turning-miters", turningMiters},
                               {"empty-segments", emptySegments},
                               {"stroked-curves", strokedCurves},
                               {"extreme-strokes", extremeStrokes},
                               {"pens", pens},
                               {"transforms", transforms},
                               {"nested-clips", nestedClips},
                               {"blends", blends},
                               {"crowds", crowds},
                               {"selections", selections},
                               {"masks", masks},
                               {"patterns", patterns},
                               {"hard-stops", hardStops},
                               {"ramps", ramps},
                               {"cell-borders", cellBorders},
                               {"cell-corners", cellCorners},
                               {"border-runs", borderRuns},
                               {"border-curves", borderCurves},
                               {"lattice-steps", latticeSteps},
                               {"long-pictures", longPictures},
                               {"scaled-pictures", scaledPictures},
                               {"far-arcs", farArcs}};

}  // namespace

std::span<const Family> hardFamilies() { return families; }

}  // namespace vtm::generate
