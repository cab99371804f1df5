#include "conformance/reference/filter/filter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <vtm/limits/limits.hpp>
#include <vtm/scene/scene.hpp>
#include "conformance/reference/filter/operations.hpp"

namespace vtm::reference {
namespace {

/// Pixels round the picture in which a filter is computed at most. More may lie in its region; cases keep
/// within.
constexpr double farthest = 700;

/// How far from a pixel lies what a primitive reads for it, in user units.
struct Reach {
    static constexpr double deviations = 3;  ///< three boxes reach 2.82 (Filter Effects 1, section 9.15)

    glm::dvec2 operator()(const scene::GaussianBlurFilter& f) const {
        return deviations * glm::dvec2(f.deviationX, f.deviationY);
    }
    glm::dvec2 operator()(const scene::DropShadowFilter& f) const {
        return glm::abs(glm::dvec2(f.dx, f.dy)) + deviations * glm::dvec2(f.deviationX, f.deviationY);
    }
    glm::dvec2 operator()(const scene::ColorMatrixFilter&) const { return glm::dvec2(0); }
    glm::dvec2 operator()(const scene::ComponentTransferFilter&) const { return glm::dvec2(0); }
    /// Others may read anywhere: `farthest` bounds them.
    template <class Operation>
    glm::dvec2 operator()(const Operation&) const {
        return glm::dvec2(HUGE_VAL);
    }
};

/// The raster of a filter: axes of its user space, as fine as the view.
struct Raster {
    Frame frame;
    scene::Affine toView{1, 0, 0, 1, 0, 0};
    bool isGrid = false;  ///< its pixels are pixels of the view
};

bool isUnit(glm::dvec2 v) {
    v = glm::abs(v);
    return glm::length(v - glm::dvec2(1, 0)) < 1e-7 || glm::length(v - glm::dvec2(0, 1)) < 1e-7;
}

Raster rasterOf(const scene::Affine& userToView) {
    Raster raster;
    raster.frame.scale = {glm::length(userToView[0]), glm::length(userToView[1])};
    const glm::dvec2 x = userToView[0] / raster.frame.scale.x, y = userToView[1] / raster.frame.scale.y;
    raster.isGrid = isUnit(x) && isUnit(y);
    if (!raster.isGrid) {
        raster.toView = {x, y, userToView[2]};
        return raster;
    }
    const glm::dmat2 turn(glm::round(x), glm::round(y));
    raster.toView = {turn[0], turn[1], glm::dvec2(0)};
    raster.frame.origin = glm::transpose(turn) * userToView[2];
    return raster;
}

class Run {
public:
    Run(const scene::Filter& filter, const scene::Group& source, const scene::Affine& toView,
        const Pixels& place, bool wholePixels, const DrawPicture& draw)
        : filter_(filter), draw_(draw), wholePixels_(wholePixels), place_(place) {
        raster_ = rasterOf(scene::compose(toView, filter.transform));
        const Frame& f = raster_.frame;
        const scene::Affine toRaster{f.scale.x, 0, 0, f.scale.y, f.origin.x, f.origin.y};
        sceneToRaster_ = scene::compose(toRaster, *scene::inverse(filter.transform));
        region_ = rectangle(filter.min, filter.max);
        blank_ = seen();
        source_ = draw_(source, sceneToRaster_, blank_);
        cut(source_, region_);
    }

    Pixels run() {
        for (const scene::FilterPrimitive& primitive : filter_.primitives) {
            limits::check();
            Rectangle own = rectangle(primitive.min, primitive.max);
            own.min = glm::max(own.min, region_.min);
            own.max = glm::max(own.min, glm::min(own.max, region_.max));
            Pixels made = result(primitive, own);
            results_.push_back({std::move(made), own, spaceOf(primitive)});
        }
        return shown(inSpace(results_.back(), false));
    }

private:
    struct Result {
        Pixels pixels;
        Rectangle region;
        bool linear;
    };

    Rectangle rectangle(scene::Point min, scene::Point max) const {
        const Rectangle exact{raster_.frame.pixel(min), raster_.frame.pixel(max)};
        if (!wholePixels_)
            return exact;
        constexpr double rounding = 1e-6;
        return {glm::floor(exact.min + rounding), glm::ceil(exact.max - rounding)};
    }

    /// Pixels of the region, as far as they are near the picture.
    Pixels seen() const {
        const scene::Affine back = *scene::inverse(raster_.toView);
        glm::dvec2 min(HUGE_VAL), max(-HUGE_VAL);
        for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec3 p(place_.x0 + (corner & 1 ? place_.width : 0),
                               place_.y0 + (corner & 2 ? place_.height : 0), 1);
            min = glm::min(min, back * p);
            max = glm::max(max, back * p);
        }
        const glm::dvec2 far = reach();
        min = glm::max(glm::floor(min - far), glm::floor(region_.min + 1e-6));
        max = glm::min(glm::ceil(max + far), glm::ceil(region_.max - 1e-6));
        return {int(min.x), int(min.y), std::max(0, int(max.x - min.x)), std::max(0, int(max.y - min.y))};
    }

    /// How far from the picture lies what is seen in it.
    glm::dvec2 reach() const {
        glm::dvec2 sum(2);  // roundings of boxes and offsets to whole pixels
        for (const scene::FilterPrimitive& primitive : filter_.primitives)
            sum += raster_.frame.scale * std::visit(Reach(), primitive.operation) + 1.0;
        return glm::min(sum, glm::dvec2(farthest));
    }

    static void cut(Pixels& pixels, const Rectangle& region) {
        pixels.fill([&](int x, int y) { return pixels.get(x, y) * region.share(x, y); });
    }

    static Pixels inSpace(const Result& result, bool linear) {
        Pixels pixels = result.pixels;
        if (result.linear != linear)
            pixels.fill([&](int x, int y) {
                const Colour c = pixels.get(x, y);
                return linear ? linearised(c) : encoded(c);
            });
        return pixels;
    }

    Result input(const scene::FilterInput& named) const {
        if (named.kind == scene::FilterInput::Kind::Result)
            return results_[named.result];
        Pixels pixels = source_;
        if (named.kind == scene::FilterInput::Kind::SourceAlpha)
            pixels.fill([&](int x, int y) { return Colour(0, 0, 0, pixels.get(x, y).a); });
        return {std::move(pixels), region_, false};
    }

    /// What is displaced keeps its colour space.
    bool spaceOf(const scene::FilterPrimitive& primitive) const {
        if (!std::holds_alternative<scene::DisplacementMapFilter>(primitive.operation))
            return primitive.linear;
        const scene::FilterInput& moved = primitive.inputs[0];
        return moved.kind == scene::FilterInput::Kind::Result && results_[moved.result].linear;
    }

    Pixels result(const scene::FilterPrimitive& primitive, const Rectangle& own) {
        Pixels made;
        if (const auto* picture = std::get_if<scene::PictureFilter>(&primitive.operation)) {
            made = inSpace({draw_(*picture->content, sceneToRaster_, blank_), own, false}, primitive.linear);
        } else {
            std::vector<Pixels> inputs;
            std::vector<Rectangle> regions;
            for (const scene::FilterInput& named : primitive.inputs) {
                const Result read = input(named);
                inputs.push_back(inSpace(read, inputs.empty() ? spaceOf(primitive) : primitive.linear));
                regions.push_back(read.region);
            }
            if (regions.empty())
                regions.push_back(own);
            const Reading in{inputs, regions, raster_.frame, primitive.linear};
            made =
                std::visit([&](const auto& operation) { return apply(operation, in); }, primitive.operation);
        }
        cut(made, own);
        return made;
    }

    template <class Operation>
    Pixels apply(const Operation& operation, const Reading& in) const {
        if constexpr (std::is_same_v<Operation, scene::PictureFilter>) {
            throw std::logic_error("a picture is drawn, not computed");
        } else if constexpr (std::is_same_v<Operation, scene::OffsetFilter>) {
            scene::OffsetFilter whole = operation;
            if (wholePixels_) {
                whole.dx = float(std::round(operation.dx * in.frame.scale.x) / in.frame.scale.x);
                whole.dy = float(std::round(operation.dy * in.frame.scale.y) / in.frame.scale.y);
            }
            return operate(whole, in, blank_);
        } else {
            return operate(operation, in, blank_);
        }
    }

    Pixels shown(const Pixels& result) const {
        const scene::Affine back = *scene::inverse(raster_.toView);
        Pixels view = place_.blank();
        view.fill([&](int x, int y) {
            const glm::dvec2 at = back * glm::dvec3(x + 0.5, y + 0.5, 1);
            return raster_.isGrid ? result.get(int(std::floor(at.x)), int(std::floor(at.y)))
                                  : result.interpolated(at.x, at.y);
        });
        return view;
    }

    const scene::Filter& filter_;
    const DrawPicture& draw_;
    const bool wholePixels_;
    const Pixels& place_;
    Raster raster_;
    scene::Affine sceneToRaster_;
    Rectangle region_;
    Pixels blank_, source_;
    std::vector<Result> results_;
};

}  // namespace

Pixels filtered(const scene::Filter& filter, const scene::Group& source, const scene::Affine& toPixels,
                const Pixels& place, bool wholePixels, const DrawPicture& draw) {
    return Run(filter, source, toPixels, place, wholePixels, draw).run();
}

}  // namespace vtm::reference
