#include "compiler/view.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "compiler/compile/compile_excerpt.hpp"
#include "compiler/compile/settings.hpp"

namespace vtm::compiler {
namespace {

/// Pixels round the raster that are compiled with it: what filters and rounded sides of the view reach.
constexpr double margin = 2;

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
    return {std::max(0.0, from - margin * pixel), std::min(picture, from + size + margin * pixel)};
}

void check(const Part& part, int width, int height) {
    const bool isFinite = std::isfinite(part.x) && std::isfinite(part.y) &&
                          std::isfinite(part.x + part.width) && std::isfinite(part.y + part.height);
    if (!(isFinite && part.width > 0 && part.height > 0))
        throw std::invalid_argument("part must be finite and not empty");
    if (width < 1 || height < 1)
        throw std::invalid_argument("raster must not be empty");
    asset::validate({width, height});
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
    ViewCompiler(const scene::Scene& scene, const Part& part, int width, int height, const Options& options)
        : scene_(scene),
          part_(part),
          view_{width, height},
          pixel_{part.width / width, part.height / height},
          options_(options),
          x_(seen(part.x, part.width, pixel_.width, scene.width)),
          y_(seen(part.y, part.height, pixel_.height, scene.height)) {}

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
        const double sx = 1 / pixel_.width, sy = 1 / pixel_.height;
        view.toPixels = {
            sx / scale.x, 0, 0, sy / scale.y, (origin.x - part_.x) * sx, (origin.y - part_.y) * sy};
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
    const Part& part_;
    const asset::View view_;
    const Pixel pixel_;
    const Options& options_;
    const Span x_, y_;
};

}  // namespace

ViewResult compileView(const scene::Scene& scene, const Part& part, int width, int height,
                       const Options& options) {
    check(part, width, height);
    checkOptions(options);
    scene::validate(scene);
    return ViewCompiler(scene, part, width, height, options).run();
}

}  // namespace vtm::compiler
