#include <vtm/compiler/view.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "compiler/compile/settings.hpp"

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

/// Where a transparent picture of one unit will do.
ViewResult nothing(int width, int height, const Options& options) {
    scene::Scene empty;
    empty.width = empty.height = 1;
    return {compile(empty, options), {width, height}, scene::identity};
}

class ViewCompiler {
public:
    ViewCompiler(const scene::Scene& scene, const scene::Frame& frame, const Options& options)
        : scene_(scene),
          frame_(frame),
          part_(frame.seen()),
          view_(rasterOf(frame)),
          pixel_(pixelOf(frame)),
          options_(options),
          x_(seen(part_.x, part_.width, pixel_.width, scene.width)),
          y_(seen(part_.y, part_.height, pixel_.height, scene.height)) {}

    ViewResult run() {
        const bool isAll = x_.size() == scene_.width && y_.size() == scene_.height;
        if (needed(scene_.width, scene_.height, pixel_.shorter()) >= options_.tolerance || isAll)
            return whole();
        if (x_.isEmpty() || y_.isEmpty())
            return empty();
        return cut();
    }

private:
    /// The tolerance for a picture of that size. Finer ones than there are may be asked for.
    static double needed(double width, double height, double pixel) {
        return asset::finestShare * pixel / std::max(width, height);
    }
    Options optionsFor(double tolerance) const {
        constexpr double finest = 0x1p-26;  // of Options::tolerance
        Options options = options_;
        options.tolerance = std::min(options_.tolerance, std::max(finest, tolerance));
        return options;
    }

    /// Where nothing of the picture is seen, or doubles cannot tell the view's sides apart.
    ViewResult empty() const {
        ViewResult made = nothing(view_.width, view_.height, options_);
        const bool isOutside = part_.x + part_.width <= 0 || part_.y + part_.height <= 0 ||
                               part_.x >= scene_.width || part_.y >= scene_.height;
        if (!isOutside)
            made.result.warnings.push_back(
                "nothing is drawn: double precision cannot tell the sides of the view apart");
        return made;
    }

    ViewResult whole() {
        const Options options = optionsFor(needed(scene_.width, scene_.height, pixel_.shorter()));
        return {compile(scene_, options), viewFrom({0, 0}, {1, 1}), scene::identity};
    }

    ViewResult cut() {
        const scene::Point scale{roundedScale(1 / pixel_.width), roundedScale(1 / pixel_.height)},
            origin{x_.from, y_.from};
        Excerpt excerpt{{scale.x, 0, 0, scale.y, -scale.x * origin.x, -scale.y * origin.y},
                        x_.size() * scale.x,
                        y_.size() * scale.y,
                        true};
        const double pixel = std::min(pixel_.width * scale.x, pixel_.height * scale.y);
        ViewResult made{
            compileExcerpt(scene_, excerpt, optionsFor(needed(excerpt.width, excerpt.height, pixel))),
            viewFrom(origin, scale), excerpt.fromScene};
        addRoundings(made.result, scale, pixel);
        return made;
    }

    /// From a picture whose origin shows that place of the scene.
    asset::View viewFrom(scene::Point origin, scene::Point scale) const {
        asset::View view = view_;
        view.toPixels = frame_.toPixels(origin, scale);
        return view;
    }

    /// Beside them the tolerance means nothing from some zoom on.
    void addRoundings(Result& result, scene::Point scale, double pixel) const {
        constexpr double rounding = 0x1p-53;
        const double off = roundings * rounding * std::max(x_.to * scale.x, y_.to * scale.y);
        result.asset.finestPixel = *result.asset.finestPixel + off / asset::finestShare;
        if (off > asset::finestShare * pixel)
            result.warnings.push_back("boundaries may be off by " + std::to_string(off / pixel) +
                                      " pixels: at this zoom the roundings of double precision show");
    }

    const scene::Scene& scene_;
    const scene::Frame& frame_;
    const scene::Rect part_;  ///< that is seen
    const asset::View view_;
    const Pixel pixel_;
    const Options& options_;
    const Span x_, y_;
};

}  // namespace

ViewResult compileView(const scene::Scene& scene, const scene::Frame& frame, const Options& options) {
    check(frame);
    checkOptions(options);
    scene::validate(scene);
    return ViewCompiler(scene, frame, options).run();
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
