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
    std::vector<float> columns;
    bool isCut = false;
    for (int x = box.min.x; x < box.max.x; ++x) {
        columns.push_back(share(x, to.min.x, to.max.x));
        isCut = isCut || columns.back() < whole;
    }
    for (int y = box.min.y; y < box.max.y; ++y) {
        const float row = share(y, to.min.y, to.max.y);
        if (!isCut && row >= whole)
            continue;
        Float4* pixels = layer.row(y);
        for (std::size_t x = 0; x < columns.size(); ++x)
            pixels[x] *= row * columns[x];
    }
}

namespace {

/// What a picture has of the box that its view shows.
Layer layerOf(const Canvas& canvas, const PixelBox& box) {
    const PixelBox drawn = canvas.bounds();
    Layer layer(drawn.moved(box.min), false);
    for (int y = drawn.min.y; y < drawn.max.y; ++y)
        if (const PixelRun run = canvas.run(y); !run.empty())
            std::copy(canvas.at(y, run.first), canvas.at(y, run.end),
                      layer.row(y + box.min.y) + (run.first - drawn.min.x));
    return layer;
}

class FilterRun {
public:
    FilterRun(const AssetView& asset, const Filter& filter, const FilterPlace& place,
              std::span<const Canvas> pictures)
        : asset_(asset),
          primitives_(primitivesOf(asset, filter)),
          place_(place),
          pictures_(pictures),
          results_(primitives_.size()) {
        for (std::size_t i = 0; i < primitives_.size(); ++i)
            for (const std::uint32_t input : inputsOf(asset, primitives_[i]))
                if (input >= firstResult)
                    results_[resultOf(input)].lastReader = i;
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
        std::map<std::pair<std::uint32_t, bool>, Layer> layers;  ///< each once, however often it is read
        std::vector<const Layer*> pointers;
        std::vector<PixelRect> regions;
        const auto inputs = inputsOf(asset_, primitive);
        for (std::size_t k = 0; k < inputs.size(); ++k) {
            const bool isMoved = primitive.op == FilterOp::DisplacementMap && k == 0;
            const bool space = isMoved ? spaceOf(inputs[k]) : linear;
            const auto [layer, isNew] = layers.try_emplace({inputs[k], space});
            if (isNew)
                layer->second = input(inputs[k], space);
            pointers.push_back(&layer->second);
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

    Layer input(std::uint32_t input, bool linear) const {
        if (input >= firstResult)
            return converted(results_[resultOf(input)].layer, linear);
        Layer source = picture(0);
        cut(source, place_.region);
        return converted(input == sourceAlpha ? alphaOf(std::move(source)) : std::move(source), linear);
    }

    Layer picture(std::size_t index) const { return layerOf(pictures_[index], place_.pictures[index]); }

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
                return converted(cropped(picture(std::size_t(step.parameters[0])), step.box), step.linear);
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
    const std::span<const Canvas> pictures_;
    std::vector<Result> results_;
};

}  // namespace

Canvas runFilter(const AssetView& asset, const Filter& filter, const FilterPlace& place,
                 std::span<const Canvas> pictures, const View& below) {
    Layer result = FilterRun(asset, filter, place, pictures).run();
    const PixelBox box = mapped(result.box, place.toBelow)
                             .grown(glm::ivec2(place.isSampled ? 1 : 0))
                             .intersection({{0, 0}, {below.width, below.height}});
    if (result.empty() || box.empty())
        return Canvas(below);
    if (!place.isSampled && place.toBelow[0] == glm::dvec2(1, 0) && place.toBelow[1] == glm::dvec2(0, 1)) {
        result = cropped(std::move(result), box.moved(-glm::ivec2(place.toBelow[2])));
        return {below, box, std::move(result.pixels)};
    }
    const glm::dmat2 back = glm::inverse(glm::dmat2(place.toBelow[0], place.toBelow[1]));
    PixelMemory pixels;
    pixels.reserve(box.area());
    for (int y = box.min.y; y < box.max.y; ++y) {
        limits::check();
        for (int x = box.min.x; x < box.max.x; ++x) {
            const glm::dvec2 at = back * (glm::dvec2(x + 0.5, y + 0.5) - place.toBelow[2]);
            pixels.push_back(place.isSampled ? bilinear(result, float(at.x), float(at.y))
                                             : result.at(int(std::floor(at.x)), int(std::floor(at.y))));
        }
    }
    return {below, box, std::move(pixels)};
}

}  // namespace vtm::asset
