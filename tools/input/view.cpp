#include "tools/input/view.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <vtm/compiler/view.hpp>
#include <vtm/limits/limits.hpp>
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

/// As fine as usual, as long as that takes no more than a third of the limit; then no finer than the raster
/// shows.
compiler::ViewResult compileInTime(const Source& source, const scene::Frame& frame,
                                   compiler::Options options) {
    double share = compiler::viewShare;
    const auto compile = [&] { return compiler::compileView(*source.scene, frame, options, share); };
    const double seconds = secondsForFirstTry();
    if (seconds <= 0)
        return compile();
    try {
        limits::Limits limits = limits::current().budget->limits();
        limits.seconds = seconds;
        limits.overrunHandler = {};
        limits::Budget budget(limits);
        const limits::Scope scope(budget);
        return compile();
    } catch (const limits::Exceeded& exceeded) {
        if (exceeded.limit() == limits::Limit::Cancelled)
            throw;
    }
    constexpr double coarsest = 0x1p-6;  // compiler::Options::tolerance; a raster wants a finer one
    options.tolerance = coarsest;
    share = asset::finestShare;
    compiler::ViewResult result = compile();
    warn(
        fmt::format("{}: warning: compiling took too long, so it is drawn less exactly: edges may be off by "
                    "up to 1/16 pixel",
                    source.name));
    return result;
}

asset::View compileSeen(Source& source, const SourceOptions& options, const scene::Frame& frame) {
    compiler::ViewResult made =
        timed(source.stages, "compile", [&] { return compileInTime(source, frame, options.compiler); });
    const scene::Affine& m = made.fromScene;
    for (compiler::UnprovenSquare& s : made.result.unproven)
        s = {(s.x - m[2].x) / m[0].x, (s.y - m[2].y) / m[1].y, s.side / std::min(m[0].x, m[1].y)};
    take(source, std::move(made.result));
    return made.view;
}

bool lowersFor(Source& source, const SourceOptions& options, const scene::Frame& frame) {
    source.drawing = timed(source.stages, "lower", [&] {
        return compiler::ViewDrawing::make(*source.scene, frame, options.compiler);
    });
    if (source.drawing)
        for (const std::string& warning : source.drawing->warnings())
            warn(fmt::format("{}: warning: {}", source.name, warning));
    return source.drawing != nullptr;
}

/// The shorter side of a pixel, in the picture's units.
double pixelOf(const asset::View& view) {
    return 1 / std::max(glm::length(view.toPixels[0]), glm::length(view.toPixels[1]));
}

/// The finest pixels of what was compiled; before files told, nearly all were compiled with the usual
/// tolerance.
double finestPixel(const Source& source, const SourceOptions& options) {
    const double tolerance = source.paper ? options.compiler.tolerance : compiler::Options().tolerance;
    const double usual = tolerance * std::max(source.width, source.height) / asset::finestShare;
    return source.paper ? usual : source.asset->finestPixel.value_or(usual);
}

void warnIfTooCoarse(const Source& source, const SourceOptions& options, const asset::View& view) {
    const double finest = finestPixel(source, options), pixel = pixelOf(view);
    if (finest > pixel * (1 + 1e-9))
        warn(fmt::format("{}: warning: at this zoom boundaries may be off by {:.3g} pixels; {}", source.name,
                         asset::finestShare * finest / pixel,
                         source.scene ? options.paper ? "paper mode does not follow the view"
                                                      : "omit --tolerance to avoid this"
                                      : "compile it again with a smaller --tolerance, or draw the SVG file"));
}

/// Throws std::length_error beyond asset::maxViewSide and maxViewPixels, with what to do about it.
scene::Frame frameOf(const scene::Framing& framing, double pictureWidth, double pictureHeight) {
    const scene::Frame frame = scene::frame(framing, pictureWidth, pictureHeight);
    if (frame.width > asset::maxViewSide || frame.height > asset::maxViewSide ||
        frame.width * frame.height > double(asset::maxViewPixels))
        throw std::length_error(fmt::format(
            "{} x {} pixels are too many (the limit is {} per side and {} in all); choose a smaller --width, "
            "--height or --zoom",
            readable(frame.width), readable(frame.height), readable(asset::maxViewSide),
            readable(double(asset::maxViewPixels))));
    return frame;
}

}  // namespace

asset::View prepareView(Source& source, const SourceOptions& options, const scene::Framing& framing,
                        Preparation preparation) {
    const scene::Frame frame = frameOf(framing, source.width, source.height);
    if (preparation == Preparation::None)
        return compiler::viewOf(frame);
    const bool followsView = source.scene && !options.paper && !options.hasTolerance;
    if (followsView && preparation == Preparation::Drawing && lowersFor(source, options, frame))
        return {source.drawing->width(), source.drawing->height()};
    if (followsView)  // warns itself
        return compileSeen(source, options, frame);
    if (source.scene)
        compileSource(source, options);
    const asset::View view = compiler::viewOf(frame);
    warnIfTooCoarse(source, options, view);
    return view;
}

}  // namespace vtm::tools
