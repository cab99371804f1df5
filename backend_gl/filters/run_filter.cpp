#include "backend_gl/filters/run_filter.hpp"

#include <map>
#include <utility>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <vtm/limits/limits.hpp>
#include "backend_gl/filters/operations.hpp"

namespace vtm::gl {

namespace {

using asset::FilterOp;
using asset::FilterPrimitive;

FilterLayer converted(FilterLayers& layers, const FilterLayer& layer, bool linear) {
    FilterLayer result = layers.make(layer.box, linear);
    FilterLayers::Pass pass = layers.pass(FilterProgram::PerPixel, result, FilterVariant(FilterOp::Picture));
    pass.first(layer);
    glUniform1i(pass.uniform("isLight"), linear);
    pass.draw();
    return result;
}

class FilterRun {
public:
    FilterRun(FilterLayers& layers, const asset::AssetView& asset, const asset::Filter& filter,
              const asset::FilterPlace& place, std::span<const Target> pictures)
        : layers_(layers),
          asset_(asset),
          primitives_(primitivesOf(asset, filter)),
          place_(place),
          pictures_(pictures),
          results_(primitives_.size()) {
        for (std::size_t i = 0; i < primitives_.size(); ++i)
            for (const std::uint32_t input : inputsOf(asset, primitives_[i]))
                if (input >= asset::firstResult)
                    results_[asset::resultOf(input)].lastReader = i;
    }
    ~FilterRun() {
        for (Result& result : results_)
            layers_.giveBack(std::move(result.layer));
    }
    FilterRun(const FilterRun&) = delete;
    FilterRun& operator=(const FilterRun&) = delete;

    const FilterLayer& run() {
        for (std::size_t i = 0; i < primitives_.size(); ++i) {
            limits::check();
            if (!place_.needed[i].empty())
                results_[i].layer = primitive(i);
            for (const std::uint32_t input : inputsOf(asset_, primitives_[i]))
                if (input >= asset::firstResult && results_[asset::resultOf(input)].lastReader == i)
                    layers_.giveBack(std::move(results_[asset::resultOf(input)].layer));
        }
        return results_.back().layer;
    }

private:
    struct Result {
        FilterLayer layer;
        std::size_t lastReader = 0;
    };

    /// What a primitive reads: a result as it is, or a layer of its own.
    struct Input {
        const FilterLayer* layer = nullptr;
        FilterLayer own;
    };

    FilterLayer primitive(std::size_t index) {
        const FilterPrimitive& primitive = primitives_[index];
        const bool linear = primitive.linear != 0;
        const asset::FilterParameters parameters = parametersOf(asset_, primitive);
        if (primitive.op == FilterOp::Picture) {
            FilterLayer result = layers_.make(place_.needed[index], linear);
            drawSource(std::size_t(parameters[0]), false, place_.regions[index], result);
            return result;
        }
        std::map<std::pair<std::uint32_t, bool>, Input> inputs;  ///< each once, however often it is read
        std::vector<const FilterLayer*> pointers;
        std::vector<asset::PixelRect> regions;
        const auto numbers = inputsOf(asset_, primitive);
        bool isLinear = linear;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const std::uint32_t number = numbers[k];
            const bool isMoved = primitive.op == FilterOp::DisplacementMap && k == 0;
            const bool space = isMoved ? spaceOf(number) : linear;
            if (isMoved)
                isLinear = space;
            const auto [entry, isNew] = inputs.try_emplace({number, space});
            if (isNew)
                read(number, space, entry->second);
            pointers.push_back(entry->second.layer);
            regions.push_back(number < asset::firstResult ? place_.region
                                                          : place_.regions[asset::resultOf(number)]);
        }
        if (regions.empty())
            regions.push_back(place_.regions[index]);
        FilterLayer result = layers_.make(place_.needed[index], isLinear);
        drawStep(layers_, {primitive, parameters, pointers, regions, place_, place_.regions[index]}, result);
        for (auto& [key, input] : inputs)
            layers_.giveBack(std::move(input.own));
        return result;
    }

    bool spaceOf(std::uint32_t input) const {
        return input >= asset::firstResult && results_[asset::resultOf(input)].layer.linear;
    }

    void read(std::uint32_t number, bool linear, Input& input) {
        if (number < asset::firstResult) {
            input.own = layers_.make(place_.pictures[0], linear);
            drawSource(0, number == asset::sourceAlpha, place_.region, input.own);
            input.layer = &input.own;
            return;
        }
        const FilterLayer& layer = results_[asset::resultOf(number)].layer;
        input.layer = &layer;
        if (layer.linear == linear || layer.empty())
            return;
        input.own = converted(layers_, layer, linear);
        input.layer = &input.own;
    }

    void drawSource(std::size_t picture, bool alphaOnly, const asset::PixelRect& cut,
                    const FilterLayer& result) {
        if (result.empty())
            return;
        const PixelBox& box = place_.pictures[picture];
        FilterLayers::Pass pass = layers_.pass(FilterProgram::Source, result);
        pass.cut(cut);
        glActiveTexture(GL_TEXTURE0 + GLenum(Unit::Layer));
        glBindTexture(GL_TEXTURE_2D, pictures_[picture].texture.get());
        const glm::ivec2 shift = result.box.min - box.min;
        glUniform4i(pass.uniform("layerBox"), shift.x, shift.y, box.width(), box.height());
        glUniform1i(pass.uniform("alphaOnly"), alphaOnly);
        glUniform1i(pass.uniform("toLight"), result.linear);
        pass.draw();
    }

    FilterLayers& layers_;
    const asset::AssetView& asset_;
    const std::span<const FilterPrimitive> primitives_;
    const asset::FilterPlace& place_;
    const std::span<const Target> pictures_;
    std::vector<Result> results_;
};

/// A filter's result on the raster of the picture below.
void show(FilterLayers& layers, const FilterLayer& result, const asset::FilterPlace& place,
          const PixelBox& box, Target& below) {
    const Program& program = layers.programs().filter(FilterProgram::Result, place.isSampled ? 1 : 0);
    below.bind();
    below.touch(box);
    glViewport(0, 0, below.size.x, below.size.y);
    glEnable(GL_SCISSOR_TEST);
    glScissor(box.min.x, box.min.y, box.width(), box.height());
    program.use();
    glActiveTexture(GL_TEXTURE0 + GLenum(Unit::Layer));
    glBindTexture(GL_TEXTURE_2D, result.target.texture.get());
    glUniform4i(program.uniform("firstBox"), 0, 0, result.box.width(), result.box.height());
    const glm::dmat2 back = glm::inverse(glm::dmat2(place.toBelow[0], place.toBelow[1]));
    const glm::dvec2 origin = -(back * place.toBelow[2]) - glm::dvec2(result.box.min);
    glUniform4f(program.uniform("toLayer"), float(back[0].x), float(back[0].y), float(back[1].x),
                float(back[1].y));
    glUniform2f(program.uniform("layerOrigin"), float(origin.x), float(origin.y));
    glUniform1i(program.uniform("isLight"), result.linear);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace

void drawFilter(FilterLayers& layers, const asset::AssetView& asset, const asset::Filter& filter,
                const asset::FilterPlace& place, std::span<const Target> pictures, Target& below) {
    glDisable(GL_BLEND);
    FilterRun run(layers, asset, filter, place, pictures);
    const FilterLayer& result = run.run();
    const PixelBox box = asset::mapped(result.box, place.toBelow)
                             .grown(glm::ivec2(place.isSampled ? 1 : 0))
                             .intersection({{0, 0}, below.size});
    if (!result.empty() && !box.empty()) {
        // Encoded once instead of at four pixels.
        FilterLayer own;
        if (place.isSampled && result.linear)
            own = converted(layers, result, false);
        show(layers, own.empty() ? result : own, place, box, below);
        layers.giveBack(std::move(own));
    }
    glEnable(GL_BLEND);
}

}  // namespace vtm::gl
