// Section 10.8: drawing images.

#include <algorithm>
#include <array>
#include <cmath>

#include <VG/vgext.h>

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/image/images.hpp"
#include "api/openvg/paint/paint_color.hpp"
#include "api/openvg/path/projective.hpp"
#include "api/openvg/record/record.hpp"
#include "api/openvg/state/matrix.hpp"

namespace vtm::openvg {

namespace {

/// The rows of a rectangle along the axes: shares of columns times shares of rows.
void coverRectangle(glm::dvec2 min, glm::dvec2 max, const Rectangle& clip, const RowSink& row) {
    const auto share = [](double low, double high, int i) {
        return std::min(high, i + 1.0) - std::max(low, double(i));
    };
    const auto within = [](double v, int minimum, int maximum) {
        return int(std::clamp(v, double(minimum), double(maximum)));
    };
    if (clip.empty())
        return;
    const int x0 = within(std::floor(min.x), clip.x0, clip.x1),
              x1 = within(std::ceil(max.x), clip.x0, clip.x1),
              y0 = within(std::floor(min.y), clip.y0, clip.y1),
              y1 = within(std::ceil(max.y), clip.y0, clip.y1);
    if (x0 >= x1)
        return;
    // Only the first and the last column may be covered in part.
    const double left = share(min.x, max.x, x0), right = share(min.x, max.x, x1 - 1);
    const int first = left < 1 ? x0 + 1 : x0, end = right < 1 ? std::max(x1 - 1, first) : x1;
    std::vector<CoverageRun> runs;
    for (int y = y0; y < y1; ++y) {
        const double high = share(min.y, max.y, y);
        runs.clear();
        const auto add = [&](int from, int to, double width) {
            if (from < to && width * high > 0)
                runs.push_back({from, to, float(width * high)});
        };
        add(x0, first, left);
        add(first, end, 1);
        add(end, x1, right);
        if (!runs.empty())
            row(y, runs);
    }
}

void coverPolygon(const std::vector<glm::dvec2>& corners, bool antialiased, const Rectangle& clip,
                  const RowSink& row) {
    const bool isUpright =
        corners.size() == 4 && ((corners[0].x == corners[3].x && corners[1].x == corners[2].x &&
                                 corners[0].y == corners[1].y && corners[2].y == corners[3].y) ||
                                (corners[0].y == corners[3].y && corners[1].y == corners[2].y &&
                                 corners[0].x == corners[1].x && corners[2].x == corners[3].x));
    if (antialiased && isUpright)
        return coverRectangle(glm::min(corners[0], corners[2]), glm::max(corners[0], corners[2]), clip, row);
    PathMask mask(scene::polygon(corners), scene::FillRule::NonZero);
    if (antialiased)
        mask.scan(glm::mat3(1), clip, row);
    else
        mask.scanCenters(glm::mat3(1), clip, row);
}

/// The clipped outline on the surface; nothing if no part of it is seen, or a corner not before the viewer.
std::vector<glm::dvec2> cornersOf(const Image& image, const glm::mat3& toSurface, const State& state) {
    const std::vector<Segment> outline =
        segmentsOf(scene::rectangle(glm::dvec2(0), glm::dvec2(image.width(), image.height())));
    const std::vector<ClipLine> lines = clipLines(state);
    RationalPath path = mapped(outline, toSurface);
    if (state.clipMode == VG_CLIPMODE_CULL_NDS ? !isWithin(path, lines)
                                               : (path = clippedArea(std::move(path), lines)).empty())
        return {};
    std::vector<glm::dvec2> corners;
    const auto take = [&](glm::dvec3 p) {
        corners.push_back(glm::dvec2(p) / p.z);
        return p.z > 0 && std::isfinite(corners.back().x) && std::isfinite(corners.back().y);
    };
    bool isSeen = take(path[0].start);
    for (const RationalCurve& side : path[0].curves)
        isSeen = (side.end() == path[0].start || take(side.end())) && isSeen;
    return isSeen ? corners : std::vector<glm::dvec2>();
}

}  // namespace

void drawImage(Context& context, const Image& image, const glm::mat3& toSurface, VGMatrixMode matrix) {
    const State& state = context.state;
    if (context.recorder)
        return context.recorder->drawImage(state, image, toSurface);
    const std::vector<glm::dvec2> corners = cornersOf(image, toSurface, state);
    if (corners.empty())
        return;
    std::unique_ptr<PixelSource> pixels = imageSource(image, toSurface, state);
    if (!pixels)
        return;
    const bool antialiased = state.renderingQuality != VG_RENDERING_QUALITY_NONANTIALIASED;
    const auto draw = [&](const Layer& layer) {
        compositorOf(context).draw(context, layer, [&](const Rectangle& clip, const RowSink& row) {
            coverPolygon(corners, antialiased, clip, row);
        });
    };
    const VGint mode = isProjective(toSurface) && !state.isProjective(matrix) ? VGint(VG_DRAW_IMAGE_NORMAL)
                                                                              : state.imageMode;
    if (mode == VG_DRAW_IMAGE_NORMAL)
        return draw({*pixels});
    if (mode == VG_DRAW_IMAGE_COLOR_MATRIX_NDS)
        return draw(
            {*transformedSource(std::move(pixels), ColorTransform(currentPaint(state, VG_FILL_PATH)))});
    std::unique_ptr<PixelSource> paint = paintSource(
        currentPaint(state, VG_FILL_PATH), toSurface * state.matrix(VG_MATRIX_FILL_PAINT_TO_USER), state);
    if (!paint)
        return;
    if (mode == VG_DRAW_IMAGE_MULTIPLY)
        return draw({*productSource(std::move(pixels), std::move(paint))});
    draw({*paint, pixels.get()});
}

}  // namespace vtm::openvg

using namespace vtm::openvg;

void vgDrawImage(VGImage handle) {
    call([&](Context& context) {
        const glm::mat3& toSurface = context.state.matrix(VG_MATRIX_IMAGE_USER_TO_SURFACE);
        drawImage(context, *freeImage(context, handle), toSurface, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    });
}
