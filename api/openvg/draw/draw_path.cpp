// Sections 8.7.5 and 8.8: filling and stroking paths.

#include "api/openvg/draw/draw_path.hpp"

#include <cmath>

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/draw/pixel_source.hpp"
#include "api/openvg/path/projective.hpp"
#include "api/openvg/record/record.hpp"
#include "api/openvg/state/matrix.hpp"

namespace vtm::openvg {

namespace {

scene::Cap capOf(VGint style) {
    return style == VG_CAP_ROUND    ? scene::Cap::Round
           : style == VG_CAP_SQUARE ? scene::Cap::Square
                                    : scene::Cap::Butt;
}

scene::Join joinOf(VGint style) {
    return style == VG_JOIN_ROUND   ? scene::Join::Round
           : style == VG_JOIN_BEVEL ? scene::Join::Bevel
                                    : scene::Join::Miter;
}

}  // namespace

bool hasStroke(const State& state) { return state.lineWidth > 0 && std::isfinite(state.lineWidth); }

StrokeParameters strokeParameters(const State& state) {
    StrokeParameters p;
    p.style.width = double(state.lineWidth);
    p.style.cap = capOf(state.capStyle);
    p.style.join = joinOf(state.joinStyle);
    p.style.miterLimit = state.miterLimit >= 1 ? std::min(double(state.miterLimit), 1e30) : 1;
    // The last one of an odd number counts for nothing.
    const std::size_t count = state.dashPattern.size() / 2 * 2;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto length = double(state.dashPattern[i]);
        p.style.dashes.push_back(length > 0 && std::isfinite(length) ? length : 0);
        sum += p.style.dashes.back();
    }
    if (!(sum > 0) || !std::isfinite(sum))
        p.style.dashes.clear();
    if (!p.style.dashes.empty()) {
        const auto phase = double(state.dashPhase);
        p.style.dashPhase = std::isfinite(phase) ? phase - sum * std::floor(phase / sum) : 0;
        p.dashPhaseReset = state.dashPhaseReset;
    }
    return p;
}

void requirePaintModes(VGbitfield modes) {
    require(modes != 0 && (modes & ~VGbitfield(VG_FILL_PATH | VG_STROKE_PATH)) == 0);
}

PathMask& maskOf(const State& state, Path& path, VGPaintMode mode) {
    if (mode == VG_STROKE_PATH)
        return path.masks.stroked(path.data, strokeParameters(state));
    return path.masks.filled(
        path.data, state.fillRule == VG_EVEN_ODD ? scene::FillRule::EvenOdd : scene::FillRule::NonZero);
}

void coverPath(const Context& context, Path& path, VGPaintMode mode, const glm::mat3& toSurface,
               const Rectangle& clip, const RowSink& row, GlyphCache* cache) {
    const State& state = context.state;
    if (path.data.commands().empty() || clip.empty())
        return;
    if (mode == VG_STROKE_PATH && !hasStroke(state))
        return;
    PathMask& mask = maskOf(state, path, mode);
    const bool antialiased = state.renderingQuality != VG_RENDERING_QUALITY_NONANTIALIASED;
    const auto scan = [&](PathMask& of, const glm::mat3& matrix) {
        antialiased ? of.scan(matrix, clip, row) : of.scanCenters(matrix, clip, row);
    };
    const std::vector<ClipLine> lines = clipLines(state);
    if (lines.empty() && !isProjective(toSurface)) {
        std::vector<PlacedGlyph> placed;
        if (cache && antialiased && cache->place(mask, toSurface, clip, placed)) {
            for (const PlacedGlyph& glyph : placed)
                glyph.play(clip, row);
            return cache->trim();
        }
        return scan(mask, toSurface);
    }
    if (state.clipMode == VG_CLIPMODE_CULL_NDS && !isWithin(mapped(path.data.segments(), toSurface), lines))
        return;
    scan(mask.seen(toSurface, lines, clip), glm::mat3(1));
}

void drawPath(Context& context, Path& path, VGbitfield modes, const glm::mat3& toSurface, GlyphCache* cache) {
    const State& state = context.state;
    if (context.recorder)
        return context.recorder->drawPath(state, path, modes, toSurface);
    if (!inverseOf(toSurface))
        return;
    for (const VGPaintMode mode : {VG_FILL_PATH, VG_STROKE_PATH}) {
        if (!(modes & VGbitfield(mode)))
            continue;
        const glm::mat3& paintToUser = state.matrix(mode == VG_FILL_PATH ? VG_MATRIX_FILL_PAINT_TO_USER
                                                                         : VG_MATRIX_STROKE_PAINT_TO_USER);
        const std::unique_ptr<PixelSource> paint =
            paintSource(currentPaint(state, mode), toSurface * paintToUser, state);
        if (!paint)
            continue;
        compositorOf(context).draw(context, {*paint}, [&](const Rectangle& clip, const RowSink& row) {
            coverPath(context, path, mode, toSurface, clip, row, cache);
        });
    }
}

}  // namespace vtm::openvg

using namespace vtm::openvg;

void vgDrawPath(VGPath handle, VGbitfield paintModes) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = context.objects->get<Path>(handle);
        requirePaintModes(paintModes);
        const glm::mat3& toSurface = context.state.matrix(VG_MATRIX_PATH_USER_TO_SURFACE);
        drawPath(context, *path, paintModes, toSurface);
    });
}
