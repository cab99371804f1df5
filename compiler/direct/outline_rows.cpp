#include "compiler/direct/outline_rows.hpp"

#include <algorithm>

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
OutlineRows::OutlineRows(const ViewChains& chains, RegionState& state, int width)
    : chains_(chains),
      vertices_(chains.vertices()),
      state_(state),
      width_(width),
      evenOdd_(scene::FillRule::EvenOdd, width),
      nonZero_(scene::FillRule::NonZero, width) {}

/// All others must run down beside the view.
void OutlineRows::findOutline() {
    isAsked_ = true;
    for (const DownChain& chain : chains_.all())
        if (chain.layer != outline_ && !runsBeside(chain, true) && !runsBeside(chain, false)) {
            if (outline_ != noIndex) {
                outline_ = noIndex;
                return;
            }
            outline_ = chain.layer;
        }
    isEvenOdd_ = outline_ != noIndex && state_.isEvenOdd(outline_);
}

bool OutlineRows::runsBeside(const DownChain& chain, bool onLeft) const {
    for (const glm::vec2* v = vertices_ + chain.first; v + 1 < vertices_ + chain.end; ++v)
        if (const auto [low, high] = std::minmax(v[0].x, v[1].x);
            v[0].y < v[1].y && (onLeft ? high > 0 : low < float(width_)))
            return false;
    return true;
}

/// The upper end of the chain's edge there.
const glm::vec2* OutlineRows::edgeAt(const DownChain& chain, float y) const {
    const glm::vec2 *const first = vertices_ + chain.first, *const last = vertices_ + chain.end - 1;
    return std::max(first, std::partition_point(first, last, [&](glm::vec2 v) { return v.y <= y; }) - 1);
}

/// False if they are not two colours.
bool OutlineRows::findColors(std::span<const std::uint32_t> numbers, float top, float bottom) {
    const auto crossLeft = [&](std::int32_t times) {
        for (const std::uint32_t number : numbers)
            if (const DownChain& chain = chains_[number]; chain.layer != outline_ && runsBeside(chain, true))
                state_.cross(chain.layer, times * chain.winding);
    };
    for (const std::uint32_t number : numbers)
        if (const DownChain& chain = chains_[number];
            chain.layer != outline_ && (chain.top > top || chain.bottom < bottom))
            return false;
    crossLeft(1);
    RegionPaint paints[2];
    for (const std::int32_t way : {0, 1}) {
        state_.cross(outline_, way);
        paints[way] = state_.region().paint;
        state_.cross(outline_, -way);
    }
    crossLeft(-1);
    for (const std::size_t i : {0, 1}) {
        if ((paints[i] & programBit) != 0)
            return false;
        colors_[i] = state_.colors()[paints[i]];
    }
    return true;
}

bool OutlineRows::draw(std::span<const std::uint32_t> numbers, float top, float bottom,
                       std::vector<asset::Chord>& chords) {
    bottom = std::min(bottom, float(chains_.height()));
    if (!isAsked_)
        findOutline();
    if (outline_ == noIndex || !findColors(numbers, top, bottom))
        return false;
    strands_.clear();
    std::size_t next = 0;
    for (float y = top; y < bottom; ++y) {
        limits::check();
        PixelRow& row = isEvenOdd_ ? evenOdd_ : nonZero_;
        row.begin(int(y));
        for (; next < numbers.size() && chains_[numbers[next]].top < y + 1; ++next) {
            const DownChain& chain = chains_[numbers[next]];
            if (chain.layer != outline_ || chain.bottom <= y)
                continue;
            const glm::vec2 *const edge = edgeAt(chain, y), *const last = vertices_ + chain.end - 1;
            ChainStrand& strand = strands_.emplace_back(edge, last, 1, chain.winding);
            if (strand.y < y) {
                strand.x += (y - strand.y) * strand.across;
                strand.y = y;
            }
        }
        std::erase_if(strands_, [&](ChainStrand& s) { return !row.follow(s); });
        drawRow(int(y), chords);
    }
    return true;
}

/// The row's pixels as paints.
void OutlineRows::drawRow(int y, std::vector<asset::Chord>& chords) {
    RegionPaint left = 0;
    const auto change = [&](int x, float share) {
        const RegionPaint right = state_.paintOf(glm::mix(colors_[0], colors_[1], share));
        if (right != left)
            chords.push_back({{x, y}, {x, y + 1}, left, right});
        left = right;
    };
    int done = 0;
    for (const asset::CoverageRun& run : (isEvenOdd_ ? evenOdd_ : nonZero_).runs()) {
        if (run.first > done)
            change(done, 0);
        change(run.first, run.share);
        done = run.end;
    }
    if (done < width_)
        change(done, 0);
    if (left != 0)
        chords.push_back({{width_, y}, {width_, y + 1}, left, 0});
}

}  // namespace vtm::compiler
