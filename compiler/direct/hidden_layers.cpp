#include "compiler/direct/hidden_layers.hpp"

#include <algorithm>
#include <functional>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/small_sort.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {
namespace {

using asset::bandRows;

/// Squares are at least so large, in pixels.
constexpr float leastWidth = 1.0f / 8, leastHeight = 1.0f / 2;
/// Or twice as high, where chains are higher than this in the mean: then it is still little.
constexpr double highChains = 8;
/// One for so many pixels, but no more in all.
constexpr double fewPixels = 4, fewSquares = 1u << 18;
/// Where chains meet bands so many times, as many squares for each time; but no more in all.
constexpr double manyInBands = 1u << 17, squaresOfChain = 8, mostSquares = 1u << 22;
/// Then layers cover no more, and only ask whether they are hidden.
constexpr std::size_t mostSquareVisits = 1u << 26;

}  // namespace

HiddenLayers::HiddenLayers(const LoweredScene& picture, const ViewChains& chains, int width, int height)
    : picture_(picture), chains_(chains), squareWidth_(leastWidth), squareHeight_(leastHeight) {
    double rows = 0;
    for (const DownChain& chain : chains.all()) {
        at_.push_back(chain.first);
        rows += std::min(double(chain.bottom), double(height)) - std::max(double(chain.top), 0.0);
    }
    if (rows > highChains * double(at_.size()))
        squareHeight_ *= 2;
    const double pixels = double(width) * height, inBands = double(chains.inBands()),
                 few = std::min(fewSquares, pixels / fewPixels),
                 most = inBands < manyInBands ? few : std::clamp(squaresOfChain * inBands, few, mostSquares);
    while (pixels > most * squareWidth_ * squareHeight_)
        (squareWidth_ < squareHeight_ || squareHeight_ == bandRows ? squareWidth_ : squareHeight_) *= 2;
    columns_ = std::int32_t(float(width) / squareWidth_) + 1;
    rows_ = std::int32_t(bandRows / squareHeight_);
    squares_.resize(std::size_t(rows_) * std::size_t(columns_ + 1));
    touches_.resize(std::size_t(rows_));
    isHidden_.resize(picture.layers.size() * std::size_t(chains.bands()));
    const std::vector<LayerCover> covers = layerCovers(picture);
    for (int band = 0; band < chains.bands(); ++band)
        lookAt(band, covers);
}

void HiddenLayers::lookAt(int band, std::span<const LayerCover> covers) {
    limits::check();
    for (std::int32_t row = 0; row < rows_; ++row)
        squaresOf(row).clear();
    stepsLeft_ = mostSquareVisits / std::size_t(chains_.bands());
    numbers_.assign(chains_.inBand(band).begin(), chains_.inBand(band).end());
    std::ranges::sort(numbers_, std::greater());  // layers ascend with them
    for (std::size_t i = 0; i < numbers_.size();) {
        const std::size_t before = i;
        const std::uint32_t layer = chains_[numbers_[i]].layer;
        for (std::vector<Touch>& touches : touches_)
            touches.clear();
        for (; i < numbers_.size() && chains_[numbers_[i]].layer == layer; ++i)
            touch(chains_[numbers_[i]], at_[numbers_[i]], float(band * bandRows));
        const bool isEvenOdd = picture_.layers[layer].rule == scene::FillRule::EvenOdd;
        if (!covers[layer].mayBeHidden || add(covers[layer], isEvenOdd))
            continue;
        isHidden_[placeOf(layer, band)] = true;
        hiddenInBands_ += i - before;
    }
}

/// Where a chain goes in the band.
void HiddenLayers::touch(const DownChain& chain, std::uint32_t& at, float top) {
    const glm::vec2* const vertices = chains_.vertices();
    const auto within = [](float place, std::int32_t count) {
        return std::int32_t(std::clamp(place, 0.0f, float(count - 1)));
    };
    const auto column = [&](float x) { return within(x / squareWidth_, columns_); };
    const auto row = [&](float y) { return within((y - top) / squareHeight_, rows_); };
    const auto xAt = [&](float y) {
        const glm::vec2 a = vertices[at], b = vertices[at + 1];
        return a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y));
    };
    while (at + 1 < chain.end && vertices[at + 1].y <= top)
        ++at;
    float x = vertices[at].y < top && at + 1 < chain.end ? xAt(top) : vertices[at].x;
    const std::int32_t last = row(chain.bottom);
    for (std::int32_t r = row(chain.top); r <= last; ++r) {
        const float bottom = top + float(r + 1) * squareHeight_, middle = bottom - 0.5f * squareHeight_;
        float left = x, right = x;
        const auto add = [&](float to) {
            left = std::min(left, to);
            right = std::max(right, to);
            x = to;
        };
        while (at + 1 < chain.end && vertices[at + 1].y <= bottom)
            add(vertices[++at].x);
        if (at + 1 < chain.end && vertices[at].y < bottom)
            add(xAt(bottom));
        // What is not met in the middle adds nothing on its right.
        touches_[std::size_t(r)].push_back(
            {column(left), column(right), chain.top <= middle && middle < chain.bottom ? chain.winding : 0});
    }
}

/// Whether the layer shows in the band.
bool HiddenLayers::add(const LayerCover& cover, bool isEvenOdd) {
    bool isShown = false;
    for (std::int32_t row = 0; row < rows_; ++row) {
        std::vector<Touch>& touches = touches_[std::size_t(row)];
        if (touches.empty())
            continue;
        sortStably(touches.begin(), touches.end(),
                   [](const Touch& a, const Touch& b) { return a.first < b.first; });
        isShown = squaresOf(row).add(touches, cover, isEvenOdd, stepsLeft_) || isShown;
    }
    return isShown;
}

}  // namespace vtm::compiler
