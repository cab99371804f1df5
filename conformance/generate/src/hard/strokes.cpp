#include "conformance/generate/src/hard/families.hpp"

namespace vtm::generate {

using namespace scene;

namespace {

Path arc(Sketch& s, Point radii) {
    const Point a = s.inside();
    return {MoveTo{a}, ArcTo{radii, s.random.uniform(0, pi), s.random.chance(0.5), s.random.chance(0.5),
                             a + s.random.point(-1.2, 1.2) * std::max(radii.x, radii.y)}};
}

/// Lines and curves, closed or not.
Path line(Sketch& s, int maxSegments) {
    Path path{MoveTo{s.point()}};
    for (int i = s.random.integer(1, maxSegments); i > 0; --i) {
        const Point a = s.point(), b = s.point();
        switch (s.random.integer(0, 3)) {
            case 0:
                path.push_back(QuadTo{a, b});
                break;
            case 1:
                path.push_back(CubicTo{a, s.point(), b});
                break;
            default:
                path.push_back(LineTo{a});
        }
    }
    if (s.random.chance(0.4))
        path.push_back(Close{});
    return path;
}

std::vector<double> dashLengths(Sketch& s) {
    std::vector<double> lengths;
    for (int i = s.random.integer(1, 5); i > 0; --i)
        lengths.push_back(s.random.chance(0.3) ? 0 : s.random.magnitude(1e-3, 0.5) * s.side());
    lengths.push_back(s.random.uniform(0.03, 0.2) * s.side());
    if (lengths.size() % 2 == 1) {
        const std::vector<double> once = lengths;
        lengths.insert(lengths.end(), once.begin(), once.end());
    }
    return lengths;
}

/// Turns by pi less an angle that goes down to rounding.
std::vector<Point> zigzag(Sketch& s) {
    std::vector<Point> points{s.inside(), s.inside()};
    for (int i = s.random.integer(1, 4); i > 0; --i) {
        const Point to = points.back(), back = points[points.size() - 2] - to;
        const double sign = s.random.chance(0.5) ? 1 : -1;
        const double off = s.random.chance(0.3) ? 0 : sign * s.random.magnitude(1e-16, 0.3);
        points.push_back(to + s.random.uniform(0.3, 1.2) * (back + off * across(back)));
    }
    return points;
}

}  // namespace

Scene hairlines(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(2, 15); i > 0; --i) {
        const StrokeStyle style = s.style(1e-7, 1e-2);
        s.add(line(s, 3), style);
    }
    return s.scene;
}

Scene dashes(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 4); i > 0; --i) {
        StrokeStyle style = s.style(1e-3, 0.3);
        style.dashes = dashLengths(s);
        style.dashPhase = s.random.uniform(-3, 3) * s.side();
        s.add(s.random.chance(0.3) ? s.anyCircle() : line(s, 4), style);
    }
    return s.scene;
}

Scene strokedArcs(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 5); i > 0; --i) {
        const double radius = s.random.magnitude(1e-3, 1) * s.side();
        const double flat = s.random.chance(0.5) ? 1 : s.random.magnitude(1e-3, 1);
        const double times = s.random.chance(0.2) ? 2 : s.random.magnitude(0.1, 4);
        const StrokeStyle style = s.style(times, times, radius);
        s.add(arc(s, radius * Point(1, flat)), style);
    }
    return s.scene;
}

Scene turningMiters(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 3); i > 0; --i) {
        StrokeStyle style = s.style(1e-3, 0.2);
        style.join = s.random.chance(0.5) ? Join::Miter : Join::MiterClip;
        style.miterLimit = s.random.magnitude(1, 1e6);
        Path path = polygon(zigzag(s));
        if (s.random.chance(0.7))
            path.pop_back();
        s.add(std::move(path), style);
    }
    return s.scene;
}

Scene emptySegments(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 6); i > 0; --i) {
        const Point a = s.inside(), b = s.inside(), c = s.inside();
        const Path parts[] = {{MoveTo{a}, LineTo{a}},
                              {MoveTo{a}, Close{}},
                              {MoveTo{a}},
                              {MoveTo{a}, CubicTo{a, a, a}},
                              {MoveTo{a}, QuadTo{a, b}, QuadTo{b, c}},
                              {MoveTo{a}, LineTo{b}, LineTo{b}, LineTo{c}},
                              {MoveTo{a}, LineTo{b}, ArcTo{{9, 9}, 0, true, true, b}, LineTo{c}, Close{}},
                              {MoveTo{a}, CubicTo{a, c, c}, CubicTo{c, b, b}},
                              {MoveTo{a}, QuadTo{b, a}, LineTo{c}},
                              {MoveTo{a}, CubicTo{b, b, a}}};
        Path path;
        for (int k = s.random.integer(1, 3); k > 0; --k)
            append(path, parts[s.random.integer(0, 9)]);
        StrokeStyle style = s.style(1e-2, 0.3);
        if (s.random.chance(0.3))
            style.dashes = dashLengths(s);
        s.add(std::move(path), style);
    }
    return s.scene;
}

Scene strokedCurves(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 3); i > 0; --i) {
        const double size = s.random.magnitude(0.02, 1) * s.side();
        const Point a = s.inside();
        const auto near = [&] { return a + s.random.point(-size, size); };
        Path path{MoveTo{a}};
        for (int k = s.random.integer(1, 3); k > 0; --k) {
            const Point b = near(), c = near();
            path.push_back(CubicTo{b, c, near()});
        }
        s.add(std::move(path), s.style(0.1, 3, size));
    }
    return s.scene;
}

Scene extremeStrokes(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 4); i > 0; --i) {
        StrokeStyle style = s.style(1e-6, 1e6);
        style.miterLimit = s.random.magnitude(1, 1e12);
        // Curves far narrower than their strokes take the reference minutes: it sweeps them in small steps.
        const bool isFarWider = style.width > 4 * s.side();
        s.add(isFarWider ? polygon({s.point(), s.point(), s.point()}) : line(s, 3), style);
    }
    return s.scene;
}

Scene pens(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 4); i > 0; --i) {
        const double flat = s.random.magnitude(1e-6, 1);
        const double turn = s.random.uniform(0, pi), size = s.random.uniform(0.5, 2);
        StrokeStyle style = s.style(1e-3, 0.5);
        if (s.random.chance(0.3))
            style.dashes = dashLengths(s);
        s.add(line(s, 4), style).transform = about(s.size() * 0.5, turn, size, flat);
    }
    return s.scene;
}

}  // namespace vtm::generate
