#include "raster/filter/run_filter.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/matrix.hpp>

#include <vtm/limits/limits.hpp>
#include "raster/filter/operations.hpp"

namespace vtm::asset {

void cut(Layer& layer, const PixelRect& to) {
    const auto share = [](int pixel, double from, double end) {
        return float(std::clamp(std::min(pixel + 1.0, end) - std::max(double(pixel), from), 0.0, 1.0));
    };
    constexpr float whole = 1 - 1e-5f;
    const PixelBox& box = layer.box;
    if (box.empty())
        return;
    std::vector<std::pair<int, float>> columns;  ///< those that are cut
    for (int x = box.min.x; x < box.max.x; ++x)
        if (const float column = share(x, to.min.x, to.max.x); column < whole)
            columns.emplace_back(x - box.min.x, column);
    for (int y = box.min.y; y < box.max.y; ++y) {
        Float4* pixels = layer.row(y);
        for (const auto& [x, column] : columns)
            pixels[x] *= column;
        if (const float row = share(y, to.min.y, to.max.y); row < whole)
            for (int x = 0; x < box.width(); ++x)
                pixels[x] *= row;
    }
}

namespace {

/// A picture whose view shows a box of the filter's raster.
Layer layerOf(Canvas&& canvas, const PixelBox& box) {
    auto [drawn, pixels] = canvas.takeBox();
    return {drawn.moved(box.min), false, std::move(pixels)};
}

class FilterRun {
public:
    FilterRun(const AssetView& asset, const Filter& filter, const FilterPlace& place,
              std::vector<Canvas> pictures)
        : asset_(asset),
          primitives_(primitivesOf(asset, filter)),
          place_(place),
          results_(primitives_.size()) {
        for (std::size_t i = 0; i < pictures.size(); ++i)
            pictures_.push_back(layerOf(std::move(pictures[i]), place.pictures[i]));
        cut(pictures_[0], place.region);
        for (std::size_t i = 0; i < primitives_.size(); ++i)
            for (const std::uint32_t input : inputsOf(asset, primitives_[i]))
                (input >= firstResult ? results_[resultOf(input)].lastReader : lastSourceReader_) = i;
    }

    Layer run() {
        const limits::Stage stage("filtering");
        for (std::size_t i = 0; i < primitives_.size(); ++i) {
            limits::check();
            if (!place_.needed[i].empty())
                results_[i].layer = primitive(i);
            for (const std::uint32_t input : inputsOf(asset_, primitives_[i]))
                if (input >= firstResult && results_[resultOf(input)].lastReader == i)
                    results_[resultOf(input)].layer = {};
            if (lastSourceReader_ == i)
                sources_.clear();
        }
        return converted(std::move(results_.back().layer), false);
    }

private:
    struct Result {
        Layer layer;
        std::size_t lastReader = 0;
    };

    Layer primitive(std::size_t index) {
        const FilterPrimitive& primitive = primitives_[index];
        const bool linear = primitive.linear != 0;
        Inputs made;
        std::vector<const Layer*> pointers;
        std::vector<PixelRect> regions;
        const auto inputs = inputsOf(asset_, primitive);
        for (std::size_t k = 0; k < inputs.size(); ++k) {
            const bool isMoved = primitive.op == FilterOp::DisplacementMap && k == 0;
            const bool space = isMoved ? spaceOf(inputs[k]) : linear;
            pointers.push_back(&input(inputs[k], space, made));
            regions.push_back(inputs[k] < firstResult ? place_.region : place_.regions[resultOf(inputs[k])]);
        }
        if (regions.empty())
            regions.push_back(place_.regions[index]);
        const FilterStep step{parametersOf(asset_, primitive),
                              pointers,
                              regions,
                              place_.needed[index],
                              linear,
                              place_.scale,
                              place_.origin,
                              place_.inWholePixels};
        Layer result = operation(primitive.op, step);
        cut(result, place_.regions[index]);
        return result;
    }

    bool spaceOf(std::uint32_t input) const {
        return input >= firstResult && results_[resultOf(input)].layer.linear;
    }

    /// By number and whether they are in linear light.
    using Inputs = std::map<std::pair<std::uint32_t, bool>, Layer>;

    /// What is made of it, once, is kept: of the source until its last reader, of results in `made`.
    const Layer& input(std::uint32_t number, bool linear, Inputs& made) {
        const Layer& layer = number < firstResult ? pictures_[0] : results_[resultOf(number)].layer;
        if (number != sourceAlpha && layer.linear == linear)
            return layer;
        const auto [entry, isNew] = (number < firstResult ? sources_ : made).try_emplace({number, linear});
        if (isNew)
            entry->second = number == sourceAlpha ? alphaOf(layer) : converted(layer, linear);
        return entry->second;
    }

    Layer picture(std::size_t index, const FilterStep& step) const {
        const PixelBox box = step.box.intersection(pictures_[index].box);
        return converted(cropped(pictures_[index], box), step.linear);
    }

    Layer operation(FilterOp op, const FilterStep& step) const {
        switch (op) {
            case FilterOp::Blend:
                return blendLayers(step);
            case FilterOp::ColorMatrix:
                return colorMatrix(step);
            case FilterOp::ComponentTransfer:
                return componentTransfer(step);
            case FilterOp::Composite:
                return composite(step);
            case FilterOp::ConvolveMatrix:
                return convolve(step);
            case FilterOp::Lighting:
                return lighting(step);
            case FilterOp::DisplacementMap:
                return displace(step);
            case FilterOp::DropShadow:
                return dropShadow(step);
            case FilterOp::Flood:
                return flood(step);
            case FilterOp::GaussianBlur:
                return gaussianBlur(step);
            case FilterOp::Picture:
                return picture(std::size_t(step.parameters[0]), step);
            case FilterOp::Merge:
                return merge(step);
            case FilterOp::Morphology:
                return morphology(step);
            case FilterOp::Offset:
                return offset(step);
            case FilterOp::Tile:
                return tile(step);
            case FilterOp::Turbulence:
                return turbulence(step);
        }
        return Layer(step.box, step.linear);
    }

    const AssetView& asset_;
    const std::span<const FilterPrimitive> primitives_;
    const FilterPlace& place_;
    std::vector<Layer> pictures_;
    std::size_t lastSourceReader_ = 0;
    Inputs sources_;
    std::vector<Result> results_;
};

/// Those pixels of `whole` in a row whose places, `start` + x · `step`, lie between two corners, and up to
/// one more on each side.
PixelRun runBetween(glm::dvec2 min, glm::dvec2 max, glm::dvec2 start, glm::dvec2 step, PixelRun whole) {
    for (int axis = 0; axis < 2; ++axis) {
        const double low = min[axis] - start[axis], high = max[axis] - start[axis];
        const double a = low / step[axis], b = high / step[axis];
        if (std::isfinite(a) && std::isfinite(b)) {
            const auto pixel = [&](double x) {
                return int(std::clamp(x, double(whole.first), double(whole.end)));
            };
            whole = {pixel(std::floor(std::min(a, b))), pixel(std::ceil(std::max(a, b)))};
        } else if (!(low <= 0 && high >= 0)) {
            return {whole.first, whole.first};
        }
    }
    return whole;
}

/// A filter's result, seen by the picture below.
class ResultRows {
public:
    ResultRows(const Layer& result, const FilterPlace& place)
        : result_(result),
          isSampled_(place.isSampled),
          back_(glm::inverse(glm::dmat2(place.toBelow[0], place.toBelow[1]))),
          origin_(place.toBelow[2]) {}

    /// Those pixels of a row below that may show some of it.
    PixelRun seen(int y, const PixelRun& row) const {
        return runBetween(glm::dvec2(result_.box.min) - 1.0, glm::dvec2(result_.box.max) + 1.0, placeOf(0, y),
                          back_[0], row);
    }
    void read(int y, const PixelRun& run, Float4* pixel) const {
        const PixelRun inside = isSampled_ ? insideOf(y, run) : PixelRun{run.end, run.end};
        for (int x = run.first; x < inside.first; ++x)
            *pixel++ = at(x, y);
        const glm::dvec2 start = placeOf(0, y) - glm::dvec2(result_.box.min) - 0.5;
        for (int x = inside.first; x < inside.end; ++x) {
            const glm::dvec2 from = start + double(x) * back_[0];
            *pixel++ = bilinearInside(result_, from.x, from.y);
        }
        for (int x = inside.end; x < run.end; ++x)
            *pixel++ = at(x, y);
    }

private:
    glm::dvec2 placeOf(int x, int y) const { return back_ * (glm::dvec2(x + 0.5, y + 0.5) - origin_); }
    /// Those that are surely between centres of the result's pixels.
    PixelRun insideOf(int y, const PixelRun& run) const {
        constexpr double room =
            0.5 + 1e-6;  // places have an error of 2^-24 (largestPixel in filter_place.cpp)
        const PixelRun inside = runBetween(glm::dvec2(result_.box.min) + room,
                                           glm::dvec2(result_.box.max) - room, placeOf(0, y), back_[0], run);
        const int first = std::min(inside.first + 1, run.end);
        return {first, std::max(first, inside.end - 1)};
    }
    Float4 at(int x, int y) const {
        const glm::dvec2 from = placeOf(x, y);
        return isSampled_ ? bilinear(result_, float(from.x), float(from.y))
                          : result_.at(int(std::floor(from.x)), int(std::floor(from.y)));
    }

    const Layer& result_;
    const bool isSampled_;
    const glm::dmat2 back_;
    const glm::dvec2 origin_;
};

}  // namespace

PixelBox shownOf(const FilterPlace& place, const View& below) {
    return mapped(place.needed.back(), place.toBelow)
        .grown(glm::ivec2(place.isSampled ? 1 : 0))
        .intersection({{0, 0}, {below.width, below.height}});
}

Canvas runFilter(const AssetView& asset, const Filter& filter, const FilterPlace& place,
                 std::vector<Canvas> pictures, const View& below) {
    Layer result = FilterRun(asset, filter, place, std::move(pictures)).run();
    const PixelBox box = shownOf(place, below);
    if (result.empty() || box.empty())
        return Canvas(below);
    if (!place.isSampled && place.toBelow[0] == glm::dvec2(1, 0) && place.toBelow[1] == glm::dvec2(0, 1)) {
        result = cropped(std::move(result), box.moved(-glm::ivec2(place.toBelow[2])));
        return {below, box, std::move(result.pixels)};
    }
    const ResultRows rows(result, place);
    Canvas canvas(below);
    canvas.reserve(box);
    eachRow(box, [&](int y) {
        limits::check();
        if (const PixelRun run = rows.seen(y, {box.min.x, box.max.x}); !run.empty())
            rows.read(y, run, canvas.beginRun(y, run));
    });
    return canvas;
}

}  // namespace vtm::asset
