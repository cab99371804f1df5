#include "compiler/direct/hidden_layers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/small_sort.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {
namespace {

using asset::bandRows;

/// Squares are at least so large, in pixels.
constexpr float leastWidth = 1.0f / 8, leastHeight = 1.0f / 2;
/// And so high in bands that one of so many chains spans: where outlines go on, it is still little. Or
/// higher, where it would take too long.
constexpr float higher = 1, highest = 2;
constexpr std::ptrdiff_t spanningOfOthers = 8;
constexpr std::size_t manyChains = 1u << 17;
/// One for so many pixels, but no more in all.
constexpr double fewPixels = 4, fewSquares = 1u << 18;
/// Where chains meet bands so many times, as many squares for each time; but no more in all.
constexpr double manyInBands = 1u << 17, squaresOfChain = 8, mostSquares = 1u << 22;
/// Then layers cover no more, and only ask whether they are hidden.
constexpr std::size_t mostBlockVisits = 1u << 25;

/// Wider squares are upright: outlines bend among them.
constexpr float mostLeaningWidth = 1.0f / 4;
/// About so many chains of a band tell how its squares lean.
constexpr std::size_t chainsThatTell = 1u << 12;
/// By it, modulo 2³², numbers that follow each other are scattered evenly.
constexpr std::uint32_t goldenRatio = 0x9E3779B9u;

}  // namespace

HiddenLayers::HiddenLayers(const LoweredScene& picture, const ViewChains& chains, int width, int height)
    : picture_(picture), chains_(chains), width_(width) {
    for (const DownChain& chain : chains.all())
        at_.push_back(chain.first);
    const double pixels = double(width) * height, inBands = double(chains.inBands()),
                 few = std::min(fewSquares, pixels / fewPixels),
                 most = inBands < manyInBands ? few : std::clamp(squaresOfChain * inBands, few, mostSquares);
    isHidden_.resize(picture.layers.size() * std::size_t(chains.bands()));
    const std::vector<LayerCover> covers = layerCovers(picture);
    for (int band = 0; band < chains.bands(); ++band) {
        takeChains(band);
        makeSquares(band, most * bandRows / height);
        lookAt(band, covers);
    }
}

/// The numbers of the band's chains, those of the topmost layers first: layers ascend with them.
void HiddenLayers::takeChains(int band) {
    const auto top = float(band * bandRows);
    std::erase_if(numbers_, [&](std::uint32_t number) { return chains_[number].bottom < top; });
    const auto fromAbove = std::ptrdiff_t(numbers_.size());
    const std::span<const std::uint32_t> chains = chains_.inBand(band);
    numbers_.insert(numbers_.end(), chains.begin() + fromAbove, chains.end());
    std::ranges::sort(numbers_.begin() + fromAbove, numbers_.end(), std::greater());
    std::ranges::inplace_merge(numbers_, numbers_.begin() + fromAbove, std::greater());
}

/// No more of them than `most`.
void HiddenLayers::makeSquares(int band, double most) {
    const auto top = float(band * bandRows), bottom = float((band + 1) * bandRows);
    const auto spanning = std::ranges::count_if(numbers_, [&](std::uint32_t number) {
        return chains_[number].top <= top && chains_[number].bottom >= bottom;
    });
    const std::ptrdiff_t others = std::ptrdiff_t(numbers_.size()) - spanning;
    squareWidth_ = leastWidth;
    squareHeight_ = spanningOfOthers * spanning <= others ? leastHeight
                    : numbers_.size() <= manyChains       ? higher
                                                          : highest;
    while (double(width_) * bandRows > most * squareWidth_ * squareHeight_)
        (squareWidth_ < squareHeight_ || squareHeight_ == bandRows ? squareWidth_ : squareHeight_) *= 2;
    columns_ = std::int32_t(std::ceil(float(width_) / squareWidth_));
    const float shown = std::min(bottom, float(chains_.height())) - top;
    rows_ = std::int32_t(std::ceil(shown / squareHeight_));
    if (squares_.size() != std::size_t(rows_) || squares_[0].squares() != columns_)
        squares_.assign(std::size_t(rows_), CoveredRow(columns_));
    touches_.resize(std::size_t(rows_));
    leanings_.resize(std::size_t(rows_) * std::size_t(columns_ / leaningColumns + 1));
    above_.resize(std::size_t(rows_) * std::size_t(columns_));
}

void HiddenLayers::lookAt(int band, std::span<const LayerCover> covers) {
    limits::check();
    for (CoveredRow& row : squares_)
        row.clear();
    stepsLeft_ = mostBlockVisits / std::size_t(chains_.bands());
    leanSquares(float(band * bandRows));
    std::size_t hiddenRows = 0;  // from the top of the band
    for (std::size_t i = 0; i < numbers_.size();) {
        const std::size_t first = i;
        const std::uint32_t layer = chains_[numbers_[i]].layer;
        while (i < numbers_.size() && chains_[numbers_[i]].layer == layer)
            ++i;
        const std::span ofLayer = std::span(numbers_).subspan(first, i - first);
        if (!covers[layer].mayBeHidden ||
            (hiddenRows < squares_.size() && isShown(ofLayer, covers[layer], band)))
            continue;
        isHidden_[placeOf(layer, band)] = true;
        hiddenInBands_ += ofLayer.size();
        while (hiddenRows < squares_.size() && squares_[hiddenRows].isHidden())
            ++hiddenRows;
    }
}

/// Lays the layer of these chains under those before. Returns whether it shows in the band.
bool HiddenLayers::isShown(std::span<const std::uint32_t> ofLayer, const LayerCover& cover, int band) {
    for (std::vector<Touch>& touches : touches_)
        touches.clear();
    for (const std::uint32_t number : ofLayer)
        touch(chains_[number], at_[number], float(band * bandRows));
    const std::uint32_t layer = chains_[ofLayer[0]].layer;
    return add(cover, picture_.layers[layer].rule == scene::FillRule::EvenOdd);
}

/// Calls take(passage) for each row of the band that a chain meets.
template <class Take>
void HiddenLayers::follow(const DownChain& chain, std::uint32_t& at, float top, const Take& take) const {
    const glm::vec2* const vertices = chains_.vertices();
    const auto row = [&](float rows) { return std::int32_t(std::clamp(rows, 0.0f, float(rows_ - 1))); };
    const auto xAt = [&](float y) {
        const glm::vec2 a = vertices[at], b = vertices[at + 1];
        return a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y));
    };
    while (at + 1 < chain.end && vertices[at + 1].y <= top)
        ++at;
    float x = vertices[at].y < top && at + 1 < chain.end ? xAt(top) : vertices[at].x;
    const std::int32_t last = row(std::ceil((chain.bottom - top) / squareHeight_) - 1);
    for (std::int32_t r = row((chain.top - top) / squareHeight_); r <= last; ++r) {
        const float upper = top + float(r) * squareHeight_, lower = upper + squareHeight_,
                    middle = lower - 0.5f * squareHeight_, from = x;
        const std::uint32_t first = at;
        while (at + 1 < chain.end && vertices[at + 1].y <= lower)
            x = vertices[++at].x;
        if (at + 1 < chain.end && vertices[at].y < lower)
            x = xAt(lower);
        // Where it spans the row it strays from the line between its ends; else it is between upright lines.
        const bool spans = chain.top <= upper && lower <= chain.bottom;
        const float along = spans ? x - from : 0;
        float less = std::min(0.0f, x - along - from), more = std::max(0.0f, x - along - from);
        for (std::uint32_t v = first + 1; v <= at; ++v) {
            const float strays = vertices[v].x - (from + (vertices[v].y - upper) * (along / squareHeight_));
            less = std::min(less, strays);
            more = std::max(more, strays);
        }
        take(Passage{.row = r,
                     .left = from + less + glm::vec2(0, along),
                     .right = from + more + glm::vec2(0, along),
                     .spans = spans,
                     .isAtMiddle = chain.top <= middle && middle < chain.bottom});
    }
}

/// As some of the band's chains go: scattered ones, since every other chain of regular layers is a left side.
void HiddenLayers::leanSquares(float top) {
    std::ranges::fill(leanings_, Leaning{});
    const std::size_t all = numbers_.size(), telling = squareWidth_ > mostLeaningWidth ? 0 : chainsThatTell;
    for (const std::uint32_t number : numbers_) {
        if (std::uint64_t(number * goldenRatio) * all >= std::uint64_t(telling) << 32)
            continue;
        std::uint32_t at = at_[number];
        follow(chains_[number], at, top, [&](const Passage& p) {
            if (p.spans)
                leaningsOf(p.row)[std::size_t(columnOf(p.left[0]) / leaningColumns)].add(
                    double(p.left[1] - p.left[0]) / squareWidth_);
        });
    }
    for (std::int32_t row = 0; row < rows_; ++row)
        leanRow(row, leaningsOf(row));
}

/// Where too few chains tell, squares lean as the nearest ones do.
void HiddenLayers::leanRow(std::int32_t row, std::span<const Leaning> leanings) {
    const auto groups = std::int32_t(leanings.size());
    const auto nextThatTells = [&](std::int32_t g) {
        while (g < groups && !leanings[std::size_t(g)].tells())
            ++g;
        return g;
    };
    std::int32_t* const above = &above_[std::size_t(row) * std::size_t(columns_)];
    std::int32_t known = nextThatTells(0), next = nextThatTells(known + 1), done = 0;
    for (std::int32_t column = 0; column < columns_; ++column) {
        const std::int32_t group = column / leaningColumns;
        if (next < groups && next - group < group - known) {
            known = next;
            next = nextThatTells(known + 1);
        }
        const double shift = known < groups ? leanings[std::size_t(known)].mean() : 0;
        // Where squares would overlap below, those on the right have no width there.
        for (const double left = std::min(column + std::round(shift), double(columns_)); done < left; ++done)
            above[done] = std::max(column - 1, 0);
    }
    std::fill(above + done, above + columns_, columns_ - 1);
}

/// Notes the squares that a chain touches in the band.
void HiddenLayers::touch(const DownChain& chain, std::uint32_t& at, float top) {
    follow(chain, at, top, [&](const Passage& p) {
        // What is not met in the middle adds nothing on its right.
        const std::int32_t winding = p.isAtMiddle ? chain.winding : 0;
        std::vector<Touch>& touches = touches_[std::size_t(p.row)];
        if (std::max(p.right[0], p.right[1]) <= 0)
            touches.push_back(Touch::before(winding, !p.spans));
        else if (std::min(p.left[0], p.left[1]) >= float(width_))
            touches.push_back(Touch::behind(columns_, winding, !p.spans));
        else
            touches.push_back({std::min(columnOf(p.left[0]), squareAbove(p.row, p.left[1])),
                               std::max(columnOf(p.right[0]), squareAbove(p.row, p.right[1])), winding,
                               !p.spans});
    });
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
        isShown = squares_[std::size_t(row)].add(touches, cover, isEvenOdd, stepsLeft_) || isShown;
    }
    return isShown;
}

}  // namespace vtm::compiler
