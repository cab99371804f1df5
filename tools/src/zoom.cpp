#include "tools/src/zoom.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "compiler/view.hpp"

namespace vtm::tools {

namespace {

asset::View compileSeen(Source& source, const std::string& path, const SourceOptions& options,
                        const Framing& framing, const asset::View& view) {
    const Rectangle part = framing.part.value_or(Rectangle{0, 0, source.width, source.height});
    compiler::ViewResult made = timed(source.stages, "compile", [&] {
        return compiler::compileView(*source.scene, {part.x, part.y, part.width, part.height}, view.width,
                                     view.height, options.compiler);
    });
    const scene::Affine& m = made.fromScene;
    for (compiler::UnprovenSquare& s : made.result.unproven)
        s = {(s.x - m[2].x) / m[0].x, (s.y - m[2].y) / m[1].y, s.side / std::min(m[0].x, m[1].y)};
    take(source, path, std::move(made.result));
    return made.view;
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

void warnIfTooCoarse(const Source& source, const std::string& path, const SourceOptions& options,
                     const asset::View& view) {
    const double finest = finestPixel(source, options), pixel = pixelOf(view);
    if (finest > pixel * (1 + 1e-9))
        printWarning(fmt::format("{}: warning: at this zoom boundaries may be off by {:.3g} pixels; {}", path,
                                 asset::finestShare * finest / pixel,
                                 source.scene ? options.paper ? "paper mode does not follow the view"
                                                              : "without --tolerance they would not be"
                                              : "compile it anew with a finer --tolerance, or draw the SVG"));
}

}  // namespace

asset::View prepareView(Source& source, const std::string& path, const SourceOptions& options,
                        const Framing& framing, bool compile) {
    const asset::View view = frame(framing, source.width, source.height);
    if (!compile)
        return view;
    const bool followsView = source.scene && !options.paper && !options.hasTolerance;
    if (followsView)  // warns itself
        return compileSeen(source, path, options, framing, view);
    if (source.scene)
        compileSource(source, path, options);
    warnIfTooCoarse(source, path, options, view);
    return view;
}

}  // namespace vtm::tools
