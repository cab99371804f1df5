// vgDrawPath against exact coverage (specification sections 6 and 8.7): fills of both rules, strokes of all
// styles, under random affine matrices; borders of shapes without antialiasing.

#include <map>

#include "conformance/cases/openvg/support.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases::openvg {

namespace {

using scene::Point;

/// The same outline for OpenVG and for the reference, in a unit square.
struct Outline {
    VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    scene::Path reference;

    Outline() = default;
    Outline(const Outline&) = delete;
    Outline& operator=(const Outline&) = delete;
    ~Outline() { vgDestroyPath(path); }

    void append(VGubyte command, std::vector<VGfloat> numbers) {
        numbers.push_back(0);  // closing takes none, but its pointer must be one
        vgAppendPathData(path, 1, &command, numbers.data());
    }
    void moveTo(Point p) {
        append(VG_MOVE_TO_ABS, {VGfloat(p.x), VGfloat(p.y)});
        reference.push_back(scene::MoveTo{p});
    }
    void lineTo(Point p) {
        append(VG_LINE_TO_ABS, {VGfloat(p.x), VGfloat(p.y)});
        reference.push_back(scene::LineTo{p});
    }
    void quadTo(Point a, Point p) {
        append(VG_QUAD_TO_ABS, {VGfloat(a.x), VGfloat(a.y), VGfloat(p.x), VGfloat(p.y)});
        reference.push_back(scene::QuadTo{a, p});
    }
    void cubicTo(Point a, Point b, Point p) {
        append(VG_CUBIC_TO_ABS,
               {VGfloat(a.x), VGfloat(a.y), VGfloat(b.x), VGfloat(b.y), VGfloat(p.x), VGfloat(p.y)});
        reference.push_back(scene::CubicTo{a, b, p});
    }
    void arcTo(Point radii, double degrees, bool large, bool counterClockwise, Point p) {
        const VGubyte command = large ? (counterClockwise ? VG_LCCWARC_TO_ABS : VG_LCWARC_TO_ABS)
                                      : (counterClockwise ? VG_SCCWARC_TO_ABS : VG_SCWARC_TO_ABS);
        append(command, {VGfloat(radii.x), VGfloat(radii.y), VGfloat(degrees), VGfloat(p.x), VGfloat(p.y)});
        reference.push_back(
            scene::ArcTo{radii, degrees * 3.14159265358979 / 180, large, counterClockwise, p});
    }
    void close() {
        append(VG_CLOSE_PATH, {});
        reference.push_back(scene::Close{});
    }
};

class CoverageCase : public VgCase {
protected:
    CoverageCase() { usePaint(white()); }

    /// A multiple of 1/256: floats and doubles have it alike.
    double grid(double low = 0, double high = 1) { return std::round(uniform(low, high) * 256) / 256; }
    Point point() {
        const double x = grid();
        return {x, grid()};
    }

    void random(Outline& outline, bool isOpen) {
        for (int subpath = 0; subpath < 2; ++subpath) {
            outline.moveTo(point());
            for (int i = 0; i < 4; ++i) {
                const Point a = point(), b = point(), p = point();
                const unsigned kind = random_() % 4;
                if (kind == 0)
                    outline.lineTo(p);
                else if (kind == 1)
                    outline.quadTo(a, p);
                else if (kind == 2)
                    outline.cubicTo(a, b, p);
                else
                    outline.arcTo({grid(0.1, 0.5), grid(0.1, 0.5)}, 32, a.x > 0.5, a.y > 0.5, p);
            }
            if (!isOpen)
                outline.close();
        }
    }

    double worst(const std::vector<double>& coverage) {
        const std::vector<std::uint32_t> words = pixels(VG_lRGBA_8888_PRE);
        double maximum = 0;
        for (std::size_t i = 0; i < words.size(); ++i)
            maximum = std::max(maximum, std::abs(double(words[i] & 255) - 255 * coverage[i]));
        return maximum;
    }
};

TEST_F(CoverageCase, Fills) {
    for (int i = 0; i < 24; ++i) {
        Outline outline;
        random(outline, i % 3 == 0);
        const scene::Affine view = randomView(60);
        load(VG_MATRIX_PATH_USER_TO_SURFACE, view);
        const bool nonZero = i % 2 == 0;
        vgSeti(VG_FILL_RULE, nonZero ? VG_NON_ZERO : VG_EVEN_ODD);
        clear();
        vgDrawPath(outline.path, VG_FILL_PATH);
        const auto coverage = reference::fillCoverage(
            outline.reference, view, nonZero ? scene::FillRule::NonZero : scene::FillRule::EvenOdd,
            {side, side, scene::identity});
        EXPECT_LE(worst(coverage), fillBound) << "case " << i;
    }
}

class StrokeCase : public CoverageCase, public ::testing::WithParamInterface<int> {};

TEST_P(StrokeCase, Strokes) {
    const int kind = GetParam();
    const std::array caps{scene::Cap::Butt, scene::Cap::Round, scene::Cap::Square};
    const std::array joins{scene::Join::Miter, scene::Join::Round, scene::Join::Bevel};
    for (int i = 0; i < 6; ++i) {
        Outline outline;
        random(outline, i % 2 == 0);
        scene::StrokeStyle style;
        style.width = grid(0.02, 0.15);
        style.cap = caps[std::size_t(kind % 3)];
        style.join = joins[std::size_t(kind / 3 % 3)];
        style.miterLimit = i % 2 == 0 ? 4 : 1.5;
        const bool isDashed = i >= 3;
        if (isDashed) {
            style.dashes = {grid(0.05, 0.3), grid(0.02, 0.2), grid(0, 0.1), grid(0.1, 0.3)};
            style.dashPhase = grid(-1, 1);
        }
        const scene::Affine view = randomView(60);
        load(VG_MATRIX_PATH_USER_TO_SURFACE, view);
        vgSetf(VG_STROKE_LINE_WIDTH, VGfloat(style.width));
        vgSeti(VG_STROKE_CAP_STYLE, VG_CAP_BUTT + kind % 3);
        vgSeti(VG_STROKE_JOIN_STYLE, VG_JOIN_MITER + kind / 3 % 3);
        vgSetf(VG_STROKE_MITER_LIMIT, VGfloat(style.miterLimit));
        const std::vector<VGfloat> dashes(style.dashes.begin(), style.dashes.end());
        vgSetfv(VG_STROKE_DASH_PATTERN, VGint(dashes.size()), dashes.data());
        vgSetf(VG_STROKE_DASH_PHASE, VGfloat(style.dashPhase));
        vgSeti(VG_STROKE_DASH_PHASE_RESET, VG_TRUE);  // as the reference does: each subpath starts anew
        clear();
        vgDrawPath(outline.path, VG_STROKE_PATH);
        double sum = 0;
        for (const double dash : style.dashes)
            sum += dash;
        if (isDashed)  // the same place in the pattern
            style.dashPhase -= sum * std::floor(style.dashPhase / sum);
        const auto coverage =
            reference::strokeCoverage(outline.reference, view, style, {side, side, scene::identity});
        EXPECT_LE(worst(coverage), strokeBound) << "case " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Style, StrokeCase, ::testing::Range(0, 9));

TEST_F(CoverageCase, DashesGoOnFromSubpathToSubpath) {
    // Section 8.7.3, Dashing: without VG_STROKE_DASH_PHASE_RESET, moves and all.
    Outline two, moved;
    two.moveTo({0, 0});
    two.lineTo({0.7, 0});
    two.moveTo({0, 0.5});
    two.lineTo({0.9, 0.5});
    moved.moveTo({0, 0.5});
    moved.lineTo({0.9, 0.5});
    const std::array<VGfloat, 2> dashes{0.25f, 0.125f};
    vgSetfv(VG_STROKE_DASH_PATTERN, 2, dashes.data());
    vgSetf(VG_STROKE_LINE_WIDTH, 0.25f);
    const scene::Affine view{64, 0, 0, 64, 10, 20};
    load(VG_MATRIX_PATH_USER_TO_SURFACE, view);
    for (const bool resets : {false, true}) {
        vgSeti(VG_STROKE_DASH_PHASE_RESET, resets);
        clear();
        vgDrawPath(two.path, VG_STROKE_PATH);
        scene::StrokeStyle style;
        style.width = 0.25;
        style.dashes = {0.25, 0.125};
        scene::Path first(two.reference.begin(), two.reference.begin() + 2);
        std::vector<double> sum =
            reference::strokeCoverage(first, view, style, {side, side, scene::identity});
        style.dashPhase = resets ? 0 : 0.7;
        const auto second =
            reference::strokeCoverage(moved.reference, view, style, {side, side, scene::identity});
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += second[i];
        EXPECT_LE(worst(sum), strokeBound) << resets;
    }
}

TEST_F(CoverageCase, SharedEdgesLeaveEveryCentreToOne) {
    // Section 6, rule 3b: meshes of triangles and of curves, without antialiasing, added up.
    vgSeti(VG_RENDERING_QUALITY, VG_RENDERING_QUALITY_NONANTIALIASED);
    vgSeti(VG_BLEND_MODE, VG_BLEND_ADDITIVE);
    const VGPaint faint = vgCreatePaint();
    vgSetColor(faint, 0xffffff10);
    usePaint(faint);
    constexpr int cells = 5;
    for (int mesh = 0; mesh < 8; ++mesh) {
        const bool isCurved = mesh % 2 == 1;
        // So little that nothing folds over.
        const double jitter = isCurved ? 0.15 : 0.3;
        std::vector<Point> corners;
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i) {
                const bool isInner = i > 0 && j > 0 && i < cells && j < cells;
                const double x = (i + (isInner ? uniform(-jitter, jitter) : 0)) / cells;
                corners.emplace_back(x, (j + (isInner ? uniform(-jitter, jitter) : 0)) / cells);
            }
        // One control point for each edge, whichever way it is run along; outer edges are straight.
        std::map<std::pair<std::size_t, std::size_t>, Point> controls;
        const auto control = [&](std::size_t a, std::size_t b) {
            const auto key = std::minmax(a, b);
            const auto found = controls.find(key);
            if (found != controls.end())
                return found->second;
            const Point middle = 0.5 * (corners[a] + corners[b]);
            const auto isOuter = [](double v) { return v == 0 || v == 1; };
            const bool straight = (isOuter(corners[a].x) && corners[a].x == corners[b].x) ||
                                  (isOuter(corners[a].y) && corners[a].y == corners[b].y);
            const double bend = straight || !isCurved ? 0 : 0.015;
            return controls[key] = middle + Point(uniform(-bend, bend), uniform(-bend, bend));
        };
        const scene::Affine view = randomView(60);
        load(VG_MATRIX_PATH_USER_TO_SURFACE, view);
        clear();
        const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
            Outline outline;
            outline.moveTo(corners[a]);
            for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
                isCurved ? outline.quadTo(control(from, to), corners[to]) : outline.lineTo(corners[to]);
            vgDrawPath(outline.path, VG_FILL_PATH);
        };
        for (std::size_t j = 0; j < cells; ++j)
            for (std::size_t i = 0; i < cells; ++i) {
                const std::size_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
                triangle(a, b, d);
                // The second one the other way round: the direction must not matter.
                mesh % 4 < 2 ? triangle(a, d, c) : triangle(c, d, a);
            }
        const std::vector<double> inside = reference::fillCoverage(
            scene::rectangle({0, 0}, {1, 1}), view, scene::FillRule::NonZero, {side, side, scene::identity});
        const std::vector<std::uint32_t> words = pixels(VG_sRGBA_8888);
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (inside[i] == 1)
                EXPECT_EQ(words[i] & 255, 16u) << "mesh " << mesh << ", pixel " << i;
            else
                EXPECT_LE(words[i] & 255, 16u) << "mesh " << mesh << ", pixel " << i;
        }
    }
}

}  // namespace

}  // namespace vtm::cases::openvg
