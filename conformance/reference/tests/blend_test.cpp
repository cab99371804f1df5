/// Blend modes against values worked out from the formulas of W3C Compositing and Blending Level 1.
#include "conformance/reference/tests/scenes.hpp"

namespace vtm::reference {
namespace {

struct Case {
    BlendMode mode;
    std::array<double, 3> expected;  ///< B(Cb, Cs)
};

constexpr Color backdrop{0.8f, 0.4f, 0.2f, 1}, source{0.3f, 0.6f, 0.5f, 1};

// Lum(backdrop) = .498, Lum(source) = .499; their saturations are .6 and .3.
const std::array cases{
    Case{BlendMode::Normal, {0.3, 0.6, 0.5}},      Case{BlendMode::Multiply, {0.24, 0.24, 0.1}},
    Case{BlendMode::Screen, {0.86, 0.76, 0.6}},    Case{BlendMode::Overlay, {0.72, 0.48, 0.2}},
    Case{BlendMode::Darken, {0.3, 0.4, 0.2}},      Case{BlendMode::Lighten, {0.8, 0.6, 0.5}},
    Case{BlendMode::ColorDodge, {1, 1, 0.4}},      Case{BlendMode::ColorBurn, {1.0 / 3, 0, 0}},
    Case{BlendMode::HardLight, {0.48, 0.52, 0.2}}, Case{BlendMode::SoftLight, {0.736, 0.4464911, 0.2}},
    Case{BlendMode::Difference, {0.5, 0.2, 0.3}},  Case{BlendMode::Exclusion, {0.62, 0.52, 0.5}},
    Case{BlendMode::Hue, {0.1, 0.7, 0.5}},         Case{BlendMode::Saturation, {0.649, 0.449, 0.349}},
    Case{BlendMode::Color, {0.299, 0.599, 0.499}}, Case{BlendMode::Luminosity, {0.801, 0.401, 0.201}},
};

Scene blended(BlendMode mode, Color below, Color above) {
    Group top = group({{fillAll(above)}});
    top.blend = mode;
    return sceneOf({{fillAll(below)}, {top}});
}

class Blending : public BothModes {};
INSTANTIATE_TEST_SUITE_P(Render, Blending, testing::Values(Mode::Exact, Mode::Compat),
                         [](const auto& mode) { return mode.param == Mode::Exact ? "Exact" : "Compat"; });

TEST_P(Blending, OpaqueColours) {
    for (const auto& [mode, b] : cases) {
        SCOPED_TRACE(int(mode));
        expectPixel(draw(blended(mode, backdrop, source)), 3, 3, {b[0], b[1], b[2], 1});
    }
}

TEST_P(Blending, HalfTransparentColours) {
    Color below = backdrop, above = source;
    below.a = above.a = 0.5;
    for (const auto& [mode, b] : cases) {
        SCOPED_TRACE(int(mode));
        // co = (1 - αb)·αs·Cs + (1 - αs)·αb·Cb + αb·αs·B, all three weights 1/4.
        const auto mixed = [&](float cb, float cs, double both) { return (cb + cs + both) / 4; };
        expectPixel(draw(blended(mode, below, above)), 3, 3,
                    {mixed(below.r, above.r, b[0]), mixed(below.g, above.g, b[1]),
                     mixed(below.b, above.b, b[2]), 0.75});
    }
}

TEST_P(Blending, PlusLighterAddsUpToOne) {
    expectPixel(draw(blended(BlendMode::PlusLighter, {0.8f, 0.4f, 0.2f, 0.5f}, {0.2f, 0.6f, 1, 0.25f})), 3, 3,
                {0.45, 0.35, 0.35, 0.75});
    expectPixel(draw(blended(BlendMode::PlusLighter, backdrop, source)), 3, 3, {1, 1, 0.7, 1});
}

TEST_P(Blending, DodgeAndBurnAtTheirPoles) {
    expectPixel(draw(blended(BlendMode::ColorDodge, black, white)), 3, 3, {0, 0, 0, 1});
    expectPixel(draw(blended(BlendMode::ColorDodge, red, white)), 3, 3, {1, 0, 0, 1});
    expectPixel(draw(blended(BlendMode::ColorBurn, white, black)), 3, 3, {1, 1, 1, 1});
    expectPixel(draw(blended(BlendMode::ColorBurn, red, black)), 3, 3, {1, 0, 0, 1});
}

TEST_P(Blending, NonSeparableModesClipTheirColour) {
    // SetLum(blue, Lum(white) = 1) leaves the range and is clipped to white.
    expectPixel(draw(blended(BlendMode::Color, white, blue)), 3, 3, {1, 1, 1, 1});
    // SetLum(white, .11): all channels equal.
    expectPixel(draw(blended(BlendMode::Color, blue, white)), 3, 3, {0.11, 0.11, 0.11, 1});
    // SetLum(yellow, .3): (.3 - .89) added gives (.41, .41, -.59), clipped about .3 by .3 / .89.
    expectPixel(draw(blended(BlendMode::Color, red, {1, 1, 0, 1})), 3, 3,
                {0.3 + 0.11 * 0.3 / 0.89, 0.3 + 0.11 * 0.3 / 0.89, 0, 1});
}

TEST_P(Blending, NothingBelowOrAboveChangesNothing) {
    for (const Case& c : cases) {
        expectPixel(draw(blended(c.mode, {0, 0, 0, 0}, source)), 3, 3, {0.3, 0.6, 0.5, 1});
        expectPixel(draw(blended(c.mode, backdrop, {0, 0, 0, 0})), 3, 3, {0.8, 0.4, 0.2, 1});
    }
}

TEST_P(Blending, GroupsIsolateTheirChildren) {
    Group multiplied = group({{fillAll(green)}});
    multiplied.blend = BlendMode::Multiply;
    // Straight over red: black. Inside a group of its own there is nothing to multiply with.
    expectPixel(draw(sceneOf({{fillAll(red)}, {multiplied}})), 3, 3, {0, 0, 0, 1});
    expectPixel(draw(sceneOf({{fillAll(red)}, {group({{multiplied}})}})), 3, 3, {0, 1, 0, 1});
    expectPixel(draw(sceneOf({{fillAll(red)}, {group({{group({{multiplied}})}})}})), 3, 3, {0, 1, 0, 1});
}

}  // namespace
}  // namespace vtm::reference
