#include <vtm/compiler/view.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "compiler/compile/settings.hpp"
#include "compiler/compile/view_plan.hpp"

namespace vtm::compiler {
namespace {

/// Pixels round the raster that are compiled with it: what filters and rounded sides of the view reach.
constexpr double marginPixels = 2;

/// Roundings of coordinates on the way from the scene to the lattice: of a transform, of its product with the
/// lattice's, and of a point under it.
constexpr double roundings = 3;

struct Pixel {
    double width, height;  ///< user units
    double shorter() const { return std::min(width, height); }
};

/// What of one axis is seen, user units.
struct Span {
    double from, to;
    bool isEmpty() const { return !(from < to); }
    double size() const { return to - from; }
};

Span seen(double from, double size, double pixel, double picture) {
    return {std::max(0.0, from - marginPixels * pixel),
            std::min(picture, from + size + marginPixels * pixel)};
}

bool isFinite(scene::Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

void check(const scene::Frame& frame) {
    const scene::Rect seen = frame.seen();
    if (!(isFinite(frame.pixel) && isFinite(frame.turn) && isFinite({seen.x, seen.y}) &&
          isFinite({seen.x + seen.width, seen.y + seen.height}) && frame.pixel.x > 0 && frame.pixel.y > 0))
        throw std::invalid_argument("the visible part must be finite and not empty");
}

/// Of the raster alone.
asset::View rasterOf(const scene::Frame& frame) {
    if (!(frame.width >= 1 && frame.height >= 1))
        throw std::invalid_argument("raster must not be empty");
    // As doubles: a file may ask for 1e30 pixels.
    if (frame.width > asset::maxViewSide || frame.height > asset::maxViewSide)
        throw std::length_error("raster is wider or higher than " + std::to_string(asset::maxViewSide) +
                                " pixels");
    const asset::View raster{int(frame.width), int(frame.height)};
    asset::validate(raster);
    return raster;
}

/// In user units, along the axes of the scene.
Pixel pixelOf(const scene::Frame& frame) {
    if (!frame.isTurned())
        return {frame.pixel.x, frame.pixel.y};
    const double shorter = std::min(frame.pixel.x, frame.pixel.y);
    return {shorter, shorter};
}

/// The power of two next to it: products with it are exact.
double roundedScale(double pixelsPerUnit) { return std::exp2(std::round(std::log2(pixelsPerUnit))); }

/// The tolerance for a picture of that size. Finer ones than there are may be asked for.
double needed(double width, double height, double pixel, double share) {
    return share * pixel / std::max(width, height);
}

Options withTolerance(const Options& options, double tolerance) {
    constexpr double finest = 0x1p-26;  // of Options::tolerance
    Options finer = options;
    finer.tolerance = std::min(options.tolerance, std::max(finest, tolerance));
    return finer;
}

/// Where a transparent picture of one unit will do.
ViewResult nothing(const asset::View& raster, const Options& options) {
    scene::Scene empty;
    empty.width = empty.height = 1;
    return {compile(empty, options), raster, scene::identity};
}

}  // namespace

std::optional<std::string> ViewPlan::warning() const {
    if (off <= asset::finestShare * pixel)
        return std::nullopt;
    return "boundaries may be off by " + std::to_string(off / pixel) +
           " pixels: at this zoom the roundings of double precision show";
}

std::optional<std::string> warningOfNothing(const scene::Scene& scene, const scene::Frame& frame) {
    const scene::Rect part = frame.seen();
    const bool isOutside = part.x + part.width <= 0 || part.y + part.height <= 0 || part.x >= scene.width ||
                           part.y >= scene.height;
    if (isOutside)
        return std::nullopt;
    return "nothing is drawn: double precision cannot tell the sides of the view apart";
}

std::optional<ViewPlan> planView(const scene::Scene& scene, const scene::Frame& frame, const Options& options,
                                 double share) {
    check(frame);
    checkOptions(options);
    scene::validate(scene);
    ViewPlan plan{.excerpt = wholeOf(scene), .options = options, .view = rasterOf(frame)};
    const scene::Rect part = frame.seen();
    const Pixel pixel = pixelOf(frame);
    const Span x = seen(part.x, part.width, pixel.width, scene.width),
               y = seen(part.y, part.height, pixel.height, scene.height);
    const double whole = needed(scene.width, scene.height, pixel.shorter(), share);
    if (whole >= options.tolerance || (x.size() == scene.width && y.size() == scene.height)) {
        plan.options = withTolerance(options, whole);
        plan.view.toPixels = frame.toPixels({0, 0}, {1, 1});
        plan.pixel = pixel.shorter();
        return plan;
    }
    // Where nothing of the picture is seen, or doubles cannot tell the view's sides apart.
    if (x.isEmpty() || y.isEmpty())
        return std::nullopt;
    plan.isAll = false;
    const scene::Point scale{roundedScale(1 / pixel.width), roundedScale(1 / pixel.height)};
    plan.excerpt = {{scale.x, 0, 0, scale.y, -scale.x * x.from, -scale.y * y.from},
                    x.size() * scale.x,
                    y.size() * scale.y,
                    true};
    plan.pixel = std::min(pixel.width * scale.x, pixel.height * scale.y);
    plan.options = withTolerance(options, needed(plan.excerpt.width, plan.excerpt.height, plan.pixel, share));
    plan.view.toPixels = frame.toPixels({x.from, y.from}, scale);
    constexpr double rounding = 0x1p-53;
    plan.off = roundings * rounding * std::max(x.to * scale.x, y.to * scale.y);
    return plan;
}

ViewResult compileView(const scene::Scene& scene, const scene::Frame& frame, const Options& options,
                       double share) {
    const std::optional<ViewPlan> plan = planView(scene, frame, options, share);
    if (!plan) {
        ViewResult made = nothing(rasterOf(frame), options);
        if (auto warning = warningOfNothing(scene, frame))
            made.result.warnings.push_back(std::move(*warning));
        return made;
    }
    if (plan->isAll)
        return {compile(scene, plan->options), plan->view, scene::identity};
    ViewResult made{compileExcerpt(scene, plan->excerpt, plan->options), plan->view, plan->excerpt.fromScene};
    // Beside the roundings of doubles the tolerance means nothing from some zoom on.
    made.result.asset.finestPixel = *made.result.asset.finestPixel + plan->off / asset::finestShare;
    if (auto warning = plan->warning())
        made.result.warnings.push_back(std::move(*warning));
    return made;
}

ViewResult compileView(const scene::Scene& scene, const Part& part, int width, int height,
                       const Options& options) {
    if (width < 1 || height < 1)
        throw std::invalid_argument("raster must not be empty");
    scene::Framing framing;
    framing.width = width;
    framing.height = height;
    framing.part = {part.x, part.y, part.width, part.height};
    framing.placement.fit = scene::Fit::Stretch;
    return compileView(scene, scene::frame(framing, scene.width, scene.height), options);
}

asset::View viewOf(const scene::Frame& frame) {
    asset::View view = rasterOf(frame);
    view.toPixels = frame.toPixels();
    asset::validate(view);
    return view;
}

}  // namespace vtm::compiler
