// Drawings that put very much into few pixels, made small: where shaders run out of what a driver allows.

#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <string>

#include <fmt/core.h>
#include <fmt/format.h>

#include <vtm/scene/path.hpp>
#include <vtm/svg/load.hpp>
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"

namespace vtm::conformance {

namespace {

struct CrowdedScene {
    const char* name;
    const char* about;
    /// Gradients that go through many shades within a pixel: engines are also compared with each other.
    bool varies;
    std::string (*svg)();
};

/// All are so many units a side.
constexpr double side = 64, middle = side / 2, reach = 30;

std::string document(const std::string& content) {
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\">{1}</svg>",
                       side, content);
}

std::string color(unsigned i) { return fmt::format("#{:06x}", i * 2654435761u >> 8); }

/// Content of n elements.
template <class Element>
std::string repeat(unsigned n, Element&& element) {
    std::string content;
    for (unsigned i = 0; i < n; ++i)
        content += element(i);
    return content;
}

using scene::Point;

Point onCircle(double turns, double radius) {
    return {middle + radius * std::cos(2 * std::numbers::pi * turns),
            middle + radius * std::sin(2 * std::numbers::pi * turns)};
}
std::string text(Point p) { return fmt::format("{:.5f},{:.5f} ", p.x, p.y); }

/// Uniform in [0, 1), the same on every machine.
class UnitRandom {
public:
    explicit UnitRandom(std::uint64_t seed) : engine_(seed) {}
    double operator()() { return std::ldexp(double(engine_() >> 11), -53); }
    Point point() {
        const double x = (*this)();
        return {side * x, side * (*this)()};
    }

private:
    std::mt19937_64 engine_;
};

// ---- Fans ---------------------------------------------------------------------------------------------

std::string fan(unsigned n, double widths, const char* style) {
    return document(repeat(n, [&](unsigned i) {
        return fmt::format("<path d=\"M{} {} L{}L{}Z\" fill=\"{}\" {}/>", middle, middle,
                           text(onCircle(double(i) / n, reach)), text(onCircle((i + widths) / n, reach)),
                           color(i), style);
    }));
}
std::string fanTriangles() { return fan(1200, 1, ""); }
std::string fanManyTriangles() { return fan(4000, 1, ""); }
std::string fanTranslucent() { return fan(900, 3, "opacity=\".4\""); }

std::string fanCurves() {
    return document(repeat(900, [](unsigned i) {
        const double a = i / 900.0, b = (i + 1) / 900.0;
        return fmt::format("<path d=\"M32 32 Q{}{}L{}Q{}32 32Z\" fill=\"{}\"/>", text(onCircle(a + 0.1, 15)),
                           text(onCircle(a, reach)), text(onCircle(b, reach)), text(onCircle(b + 0.1, 15)),
                           color(i));
    }));
}
std::string fansInARow() {
    return document(repeat(4, [](unsigned k) {
        return fmt::format("<g transform=\"translate({} {}) scale(.25)\">{}</g>", 4 + 16 * k, 24,
                           repeat(600, [](unsigned i) {
                               return fmt::format("<path d=\"M32 32L{}L{}Z\" fill=\"{}\"/>",
                                                  text(onCircle(i / 600.0, reach)),
                                                  text(onCircle((i + 1) / 600.0, reach)), color(i));
                           }));
    }));
}

// ---- Rays and stars -----------------------------------------------------------------------------------

std::string rays() {
    std::string d = repeat(600, [](unsigned i) {
        return "M" + text(onCircle(i / 600.0, 2)) + "L" + text(onCircle(i / 600.0, reach));
    });
    return document("<path d=\"" + d + "\" stroke=\"#024\" stroke-width=\".01\"/>");
}
std::string raysThroughAPoint() {
    std::string d = repeat(90, [](unsigned i) {
        return "M" + text(onCircle(i / 180.0, reach)) + "L" + text(onCircle(i / 180.0 + 0.5, reach));
    });
    return document("<path d=\"" + d + "\" stroke=\"#a31\" stroke-width=\".1\"/>");
}
std::string star(unsigned points, unsigned step, const char* rule) {
    const std::string d = repeat(points, [&](unsigned i) {
        return (i == 0 ? "M" : "L") + text(onCircle(double(i * step % points) / points, reach));
    });
    return document(fmt::format("<path d=\"{}Z\" fill=\"#136\" fill-rule=\"{}\"/>", d, rule));
}
std::string starEvenOdd() { return star(201, 100, "evenodd"); }
std::string starNonzero() { return star(151, 60, "nonzero"); }
std::string starsNested() {
    return document(repeat(60, [](unsigned k) {
        const double radius = reach * std::pow(0.93, k);
        const std::string d = repeat(24, [&](unsigned i) {
            return (i == 0 ? "M" : "L") +
                   text(onCircle(i / 24.0 + k * 0.013, i % 2 == 0 ? radius : radius * 0.4));
        });
        return fmt::format("<path d=\"{}Z\" fill=\"{}\"/>", d, color(k));
    }));
}

// ---- Grids --------------------------------------------------------------------------------------------

std::string grid() {
    return document(repeat(90 * 90, [](unsigned i) {
        return fmt::format("<rect x=\"{:.4f}\" y=\"{:.4f}\" width=\".72\" height=\".72\" fill=\"{}\"/>",
                           i % 90 * 0.71, i / 90 * 0.71, color(i % 7));
    }));
}
std::string mesh() {
    UnitRandom random(7);
    const unsigned n = 60;
    std::vector<Point> points;
    for (unsigned i = 0; i < (n + 1) * (n + 1); ++i) {
        const double x = i % (n + 1) + 0.7 * random();
        points.push_back({x, i / (n + 1) + 0.7 * random()});
    }
    return document(repeat(n * n * 2, [&](unsigned i) {
        const unsigned a = i / 2 / n * (n + 1) + i / 2 % n, c = a + n + 2, b = i % 2 == 0 ? a + 1 : a + n + 1;
        return fmt::format("<path d=\"M{}L{}L{}Z\" fill=\"{}\"/>", text(points[a]), text(points[b]),
                           text(points[c]), color(i));
    }));
}
std::string hatching() {
    return document(repeat(3, [](unsigned k) {
        const std::string d =
            repeat(120, [](unsigned i) { return fmt::format("M-20 {0}L84 {0}", -20 + i * 0.9); });
        return fmt::format(
            "<path d=\"{}\" stroke=\"{}\" stroke-width=\".2\" transform=\"rotate({} 32 32)\"/>", d,
            color(k + 1), 11 + 53 * k);
    }));
}

// ---- Rings --------------------------------------------------------------------------------------------

std::string rings() {
    return document(repeat(500, [](unsigned i) {
        return fmt::format("<circle cx=\"32\" cy=\"32\" r=\"{:.4f}\" fill=\"{}\"/>", 30 - i * 0.06,
                           i % 2 == 0 ? "#fff" : color(i).c_str());
    }));
}
std::string ringsSmall() {
    return document("<g transform=\"translate(31 31) scale(.03)\">" +
                    repeat(300,
                           [](unsigned i) {
                               return fmt::format("<circle cx=\"32\" cy=\"32\" r=\"{:.4f}\" fill=\"{}\"/>",
                                                  31 - i * 0.1, color(i));
                           }) +
                    "</g>");
}
std::string ringsDashed() {
    return document(repeat(40, [](unsigned i) {
        return fmt::format(
            "<circle cx=\"32\" cy=\"32\" r=\"{:.3f}\" fill=\"none\" stroke=\"{}\" "
            "stroke-width=\".3\" stroke-dasharray=\".4 .3\"/>",
            1 + i * 0.7, color(i));
    }));
}

// ---- Clutter ------------------------------------------------------------------------------------------

std::string glyphs() {
    UnitRandom random(11);
    return document(repeat(1500, [&](unsigned i) {
        const Point p = random.point();
        return fmt::format(
            "<path transform=\"translate({:.4f} {:.4f}) scale(.12)\" fill=\"{}\" d=\"M0 0h5v1H1.2v2"
            "C4 2 6 4 5.5 6S2 9 0 7.5L.4 6.6C2 8 4.6 7.5 4.6 5.5S2.4 3.6 0 4.2Z\"/>",
            p.x, p.y, i % 3 == 0 ? "#a02" : "#111");
    }));
}
std::string glyphsInACorner() {
    UnitRandom random(12);
    return document("<g transform=\"translate(20 20) scale(.04)\">" +
                    repeat(1200,
                           [&](unsigned i) {
                               const Point p = random.point();
                               return fmt::format(
                                   "<path transform=\"translate({:.4f} {:.4f}) scale(.3)\" fill=\"{}\" "
                                   "d=\"M0 0h5v1H1.2v2C4 2 6 4 5.5 6S2 9 0 7.5Z\"/>",
                                   p.x, p.y, color(i));
                           }) +
                    "</g>");
}
std::string scribble() {
    UnitRandom random(13);
    const std::string d =
        repeat(200, [&](unsigned i) { return (i == 0 ? "M" : "L") + text(random.point()); });
    return document("<path d=\"" + d + "Z\" fill=\"#0a5\" fill-rule=\"evenodd\"/>");
}
std::string slivers() {
    UnitRandom random(14);
    return document(repeat(700, [&](unsigned i) {
        const double y = random() * 60, lean = random() * 0.8;
        return fmt::format("<path d=\"M1 {:.5f}L63 {:.5f}L63 {:.5f}Z\" fill=\"{}\"/>", y, y + lean,
                           y + lean + 0.02, color(i));
    }));
}
std::string discsTranslucent() {
    UnitRandom random(15);
    return document(repeat(24, [&](unsigned i) {
        const Point p = random.point();
        return fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\" fill=\"{}\" opacity=\".3\"/>",
                           p.x, p.y, 8 + 10 * random(), color(i));
    }));
}

// ---- Gradients ----------------------------------------------------------------------------------------

std::string stops(unsigned n) {
    return repeat(n, [&](unsigned i) {
        return fmt::format("<stop offset=\"{:.6f}\" stop-color=\"{}\"/>", double(i) / (n - 1), color(i));
    });
}
/// Slow along the picture, so that a pixel sees little of it.
std::string discsWithGradients() {
    UnitRandom random(16);
    return document(repeat(18, [&](unsigned i) {
        const Point p = random.point();
        return fmt::format(
            "<linearGradient id=\"g{0}\" gradientUnits=\"userSpaceOnUse\" x1=\"-400\" x2=\"400\" "
            "y2=\"{1}\"><stop stop-color=\"{2}\"/><stop offset=\"1\" stop-color=\"{3}\"/>"
            "</linearGradient><circle cx=\"{4:.3f}\" cy=\"{5:.3f}\" r=\"{6:.3f}\" "
            "fill=\"url(#g{0})\" opacity=\".5\"/>",
            i, 40 * i, color(i), color(i + 1), p.x, p.y, 8 + 12 * random());
    }));
}
std::string fanOfGradients() {
    return document(repeat(120, [](unsigned i) {
        return fmt::format(
            "<linearGradient id=\"g{0}\" gradientUnits=\"userSpaceOnUse\" x1=\"-400\" x2=\"400\" "
            "y2=\"{1}\"><stop stop-color=\"{2}\"/><stop offset=\"1\" stop-color=\"{3}\"/>"
            "</linearGradient><path d=\"M32 32L{4}L{5}Z\" fill=\"url(#g{0})\"/>",
            i, 10 * i, color(i), color(i + 1), text(onCircle(i / 120.0, reach)),
            text(onCircle((i + 1) / 120.0, reach)));
    }));
}
std::string manyStops() {
    return document("<linearGradient id=\"g\">" + stops(20000) +
                    "</linearGradient><rect x=\"2\" y=\"2\" width=\"60\" height=\"60\" fill=\"url(#g)\"/>");
}
std::string manyStopsRepeated() {
    return document("<radialGradient id=\"g\" r=\".2\" spreadMethod=\"reflect\">" + stops(3000) +
                    "</radialGradient><path d=\"M2 2h60L50 62H10Z\" fill=\"url(#g)\" opacity=\".8\"/>"
                    "<circle cx=\"32\" cy=\"32\" r=\"20\" fill=\"url(#g)\" opacity=\".5\"/>");
}

constexpr CrowdedScene scenes[] = {
    {"fan.triangles", "1200 triangles with a common corner.", false, fanTriangles},
    {"fan.many-triangles", "4000 triangles with a common corner.", false, fanManyTriangles},
    {"fan.translucent", "900 translucent triangles with a common corner, each over two others.", false,
     fanTranslucent},
    {"fan.curves", "900 curved petals with a common corner.", false, fanCurves},
    {"fan.row", "Four fans of 600 triangles.", false, fansInARow},
    {"rays.from-a-point", "600 hairlines, nearly from a point.", false, rays},
    {"rays.through-a-point", "90 hairlines through a point.", false, raysThroughAPoint},
    {"star.even-odd", "A star of 201 points that crosses itself 19 899 times, even-odd.", false, starEvenOdd},
    {"star.nonzero", "A star of 151 points, nonzero.", false, starNonzero},
    {"star.nested", "60 stars in each other.", false, starsNested},
    {"grid.squares", "8100 abutting squares.", false, grid},
    {"grid.mesh", "7200 triangles of a crooked mesh.", false, mesh},
    {"grid.hatching", "Three layers of 120 lines that cross.", false, hatching},
    {"rings.discs", "500 discs about one point.", false, rings},
    {"rings.small", "300 discs about one point, within two units.", false, ringsSmall},
    {"rings.dashed", "40 dashed circles about one point.", false, ringsDashed},
    {"clutter.glyphs", "1500 glyph-like shapes.", false, glyphs},
    {"clutter.glyphs-in-a-corner", "1200 glyph-like shapes within three units.", false, glyphsInACorner},
    {"clutter.scribble", "A polygon of 200 random points, even-odd.", false, scribble},
    {"clutter.slivers", "700 slivers, nearly parallel.", false, slivers},
    {"layers.translucent", "24 translucent discs.", false, discsTranslucent},
    {"layers.gradients", "18 translucent discs with gradients.", false, discsWithGradients},
    {"fan.gradients", "120 triangles with a gradient each and a common corner.", false, fanOfGradients},
    {"stops.linear", "A gradient of 20 000 stops.", true, manyStops},
    {"stops.reflected", "Two layers of a reflected radial gradient of 3000 stops.", true, manyStopsRepeated},
};

std::span<const CrowdedScene> crowdedScenes() { return scenes; }

Outcome run(const CrowdedScene& crowded, SceneSettings settings, int size, const Setting& setting) {
    const std::string text = crowded.svg();
    const scene::Scene scene =
        svg::load({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).scene;
    settings.views.way = ViewPlan::Way::Whole;
    settings.views.raster = size;
    // Of very many curves in a pixel the evaluator's chords are no yardstick for the others.
    if (!crowded.varies)
        settings.bounds.twin = Bounds::any;
    SceneSubject subject(scene, settings, viewsOf(settings.views, scene, ""), setting.fault);
    return judge(subject, setting);
}

}  // namespace

std::vector<Case> crowdedCases(const Folder& folder) {
    const SceneSettings settings = sceneSettings(folder.settings);
    std::vector<Case> cases;
    for (const CrowdedScene& crowded : crowdedScenes())
        for (const int size : folder.settings.at("sizes").get<std::vector<int>>())
            cases.push_back({fmt::format("{}.{}.{}px", folder.name, crowded.name, size),
                             (folder.path / "suite.json").string(), crowded.about,
                             [=](const Setting& setting) { return run(crowded, settings, size, setting); }});
    return cases;
}

}  // namespace vtm::conformance
