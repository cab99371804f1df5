// A picture made of masks, materials and other pictures: road_sign PICTURE.svg OUT.png
//
// Every line of main() is a VTM: a material, a choice between two VTMs by a mask, or a VTM at another place.
// The landscape stands in it twice, the second time in the mirror.

#include <cmath>
#include <cstdio>
#include <exception>

#include <vtm/authoring.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>

using namespace vtm;
using scene::Color;
using scene::Point;

namespace {

constexpr double width = 400, height = 300;

// ---- Materials: p is a point of the picture -----------------------------------------------------------

constexpr const char* cloudsGlsl = R"(
float cloudsHash(ivec2 q) {
    uint h = uint(q.x) * 374761393u + uint(q.y) * 668265263u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return float(h >> 16) / 65535.0;
}

float cloudsNoise(vec2 p) {
    vec2 corner = floor(p), f = p - corner;
    ivec2 q = ivec2(corner);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(cloudsHash(q), cloudsHash(q + ivec2(1, 0)), f.x),
               mix(cloudsHash(q + ivec2(0, 1)), cloudsHash(q + ivec2(1, 1)), f.x), f.y);
}

vec4 clouds(vec2 p) {
    vec2 q = p * vec2(0.012, 0.03) + 7.0;
    float v = 0.55 * cloudsNoise(q) + 0.28 * cloudsNoise(q * 2.1) + 0.17 * cloudsNoise(q * 4.3);
    float cover = smoothstep(0.45, 0.75, v);
    vec3 sky = mix(vec3(0.86, 0.93, 0.98), vec3(0.32, 0.58, 0.86), clamp(1.0 - p.y / 170.0, 0.0, 1.0));
    return vec4(mix(sky, vec3(1.0), cover), 1.0);
})";

constexpr const char* grassGlsl = R"(
vec4 grass(vec2 p) {
    float blades = sin(p.x * 3.1 + sin(p.y * 1.7) * 2.0) * sin(p.y * 2.3 + p.x * 0.4);
    float near = clamp((p.y - 150.0) / 150.0, 0.0, 1.0);
    return vec4(mix(vec3(0.48, 0.66, 0.34), vec3(0.24, 0.47, 0.16), near) + 0.05 * near * blades, 1.0);
})";

constexpr const char* foilGlsl = R"(
// The honeycomb of retroreflective foil.
vec4 foil(vec2 p) {
    vec2 q = p * 0.5, cell = vec2(1.0, 1.7320508);
    vec2 a = mod(q, cell) - 0.5 * cell, b = mod(q - 0.5 * cell, cell) - 0.5 * cell;
    vec2 d = abs(dot(a, a) < dot(b, b) ? a : b);
    float rim = 0.5 - max(d.x, dot(d, normalize(cell)));
    return vec4(vec3(0.98, 0.97, 0.93) * mix(0.86, 1.0, smoothstep(0.02, 0.08, rim)), 1.0);
})";

// ---- Masks -----------------------------------------------------------------------------------------

Mask disc(Point c, double r) {
    return filled({scene::MoveTo{c - Point(r, 0)}, scene::ArcTo{{r, r}, 0, false, true, c + Point(r, 0)},
                   scene::ArcTo{{r, r}, 0, false, true, c - Point(r, 0)}, scene::Close{}});
}

Mask box(Point min, Point max) { return filled(scene::rectangle(min, max)); }

/// An equilateral triangle with round corners, standing on its side, `r` from its centre to the corners'
/// centres.
Mask warning(Point c, double r, double corner) {
    const auto at = [&](double degrees, double radius) {
        const double a = degrees * 3.14159265358979 / 180;
        return Point(radius * std::cos(a), radius * std::sin(a));
    };
    scene::Path path;
    for (const double turn : {-90.0, 30.0, 150.0}) {
        const Point from = c + at(turn, r) + at(turn - 60, corner),
                    to = c + at(turn, r) + at(turn + 60, corner);
        if (path.empty())
            path.push_back(scene::MoveTo{from});
        else
            path.push_back(scene::LineTo{from});
        path.push_back(scene::ArcTo{{corner, corner}, 0, false, true, to});
    }
    path.push_back(scene::Close{});
    return filled(path);
}

Mask hills() {
    return filled({scene::MoveTo{{0, 160}}, scene::CubicTo{{80, 120}, {150, 150}, {220, 158}},
                   scene::CubicTo{{290, 166}, {330, 120}, {400, 140}}, scene::LineTo{{400, 300}},
                   scene::LineTo{{0, 300}}, scene::Close{}});
}

Mask road() {
    return filled({scene::MoveTo{{216, 157}}, scene::LineTo{{224, 158}},
                   scene::CubicTo{{240, 190}, {190, 220}, {330, 300}}, scene::LineTo{{60, 300}},
                   scene::CubicTo{{150, 220}, {225, 190}, {216, 157}}, scene::Close{}});
}

Mask exclamation(Point c) {
    return filled({scene::MoveTo{c + Point(-5, -26)}, scene::LineTo{c + Point(5, -26)},
                   scene::LineTo{c + Point(3, 4)}, scene::LineTo{c + Point(-3, 4)}, scene::Close{},
                   scene::MoveTo{c + Point(-4.5, 13)},
                   scene::ArcTo{{4.5, 4.5}, 0, false, true, c + Point(4.5, 13)},
                   scene::ArcTo{{4.5, 4.5}, 0, false, true, c + Point(-4.5, 13)}, scene::Close{}});
}

scene::LinearGradient across(double from, double to, Color a, Color b) {
    return {{from, 0}, {to, 0}, {{0, a}, {0.4f, b}, {1, a}}};
}

// ---- The picture -----------------------------------------------------------------------------------

Vtm pictureIn(const scene::Scene& picture, Point corner, double toWidth) {
    const double scale = toWidth / picture.width;
    return Vtm::fromScene(picture).placed(
        scene::compose(scene::translation(corner.x, corner.y), scene::scaling(scale, scale)));
}

Vtm roadSign(const scene::Scene& poster) {
    const Vtm grey = Vtm::paint(Color{0.42f, 0.43f, 0.46f, 1}), white = Vtm::paint(Color{1, 1, 1, 1});
    const Vtm sky = Vtm::material("clouds", cloudsGlsl, {0.6f, 0.78f, 0.92f, 1});
    const Vtm grass = Vtm::material("grass", grassGlsl, {0.36f, 0.56f, 0.25f, 1});
    const Vtm ground = Vtm::select(road(), grey, grass);
    const Vtm landscape = Vtm::select(hills(), ground, sky);

    const double posterHeight = 90 * poster.height / poster.width;
    const Point corner{20, 150 - posterHeight};
    const Vtm board = Vtm::select(box(corner - Point(3, 3), corner + Point(93, posterHeight + 3)), white,
                                  Vtm::select(box({62, 140}, {68, 200}), grey, landscape));
    const Vtm scenery =
        Vtm::select(box(corner, corner + Point(90, posterHeight)), pictureIn(poster, corner, 90), board);

    // The mirror shows the scenery the wrong way round and darker.
    const Vtm mirrored = scenery.placed({-0.2, 0, 0, 0.2, 390, 85});
    const Vtm glass = Vtm::over(Vtm::paint(Color{0.05f, 0.1f, 0.2f, 0.2f}), mirrored);
    const Vtm rim = Vtm::paint(Color{0.93f, 0.36f, 0.1f, 1});
    const Vtm pole = Vtm::paint(across(-4, 4, {0.4f, 0.42f, 0.45f, 1}, {0.86f, 0.87f, 0.9f, 1}));
    const auto poleAt = [&](double x) { return pole.placed(scene::translation(x, 0)); };
    const Vtm withMirror = Vtm::select(disc({350, 115}, 32), Vtm::select(disc({350, 115}, 28), glass, rim),
                                       Vtm::select(box({346, 140}, {354, 280}), poleAt(350), scenery));

    const Point middle{258, 118};
    const Vtm foil = Vtm::material("foil", foilGlsl, {0.96f, 0.95f, 0.91f, 1});
    const Vtm plate =
        Vtm::select(exclamation(middle + Point(0, -2)), Vtm::paint(Color{0.08f, 0.08f, 0.1f, 1}), foil);
    const Vtm red = Vtm::paint(Color{0.8f, 0.07f, 0.1f, 1});
    const Vtm sign = Vtm::select(warning(middle, 42, 6), plate, red);
    return Vtm::select(warning(middle, 56, 8), sign,
                       Vtm::select(box({254, 140}, {262, 290}), poleAt(258), withMirror));
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::fprintf(stderr, "usage: road_sign PICTURE.svg OUT.png\n");
        return 2;
    }
    const Vtm picture = roadSign(svg::load(image::readFile(argv[1])).scene);
    const compiler::Result result = compile(picture, width, height);
    constexpr double scale = 2;
    const asset::View view{int(width * scale), int(height * scale), scene::scaling(scale, scale)};
    gl::Context context;
    gl::Renderer renderer;
    const image::Raster pixels = renderer.render(renderer.upload(result.asset), view);
    image::writeFile(argv[2], image::encodePng(image::toBitmap(pixels)));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "road_sign: %s\n", error.what());
    return 1;
}
