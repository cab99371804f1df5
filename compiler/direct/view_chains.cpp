#include "compiler/direct/view_chains.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vtm/limits/limits.hpp>
#include "compiler/paint/composite.hpp"
#include "geometry/box.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {
namespace {

using asset::bandRows;
using geometry::Box;

/// Whether they have a point within both.
bool overlap(const Box& a, const Box& b) {
    return a.min.x < b.max.x && a.max.x > b.min.x && a.min.y < b.max.y && a.max.y > b.min.y;
}

/// Around what is seen of items in groups with clips, and around what clips may let through.
class ShownBoxes {
public:
    ShownBoxes(const LoweredScene& picture, const scene::Affine& toPixels, const asset::View& view)
        : picture_(picture),
          toPixels_(toPixels),
          all_{{0, 0}, {view.width, view.height}},
          isClipped_(clippedGroups(picture)),
          known_(picture.clips.size()) {
        for (const LoweredGroup& group : picture.groups) {  // parents come first
            const Box outer = group.parent == noIndex ? all_ : groups_[group.parent];
            groups_.push_back(group.clip == noIndex ? outer : outer.intersection(ofClip(group.clip)));
        }
        if (!picture.clips.empty())
            findClipped();
    }

    /// Null for items in groups without clips, of which all of the view is seen; an empty box for layers of
    /// neither items nor clips, as of patterns that are not seen.
    const Box* ofLayer(std::uint32_t layer) const {
        const std::uint32_t item = picture_.itemOfLayer[layer];
        if (item == noIndex)
            return clipLayers_.empty() ? &nothing_ : &clipLayers_[layer];
        const std::uint32_t group = picture_.items[item].group;
        return isClipped_[group] ? &groups_[group] : nullptr;
    }
    const Box& view() const { return all_; }

private:
    /// Where what is in groups with clips may be seen.
    void findClipped() {
        std::vector<Box> content(picture_.groups.size()), clips(picture_.clips.size());
        for (const LoweredItem& item : picture_.items)
            if (isClipped_[item.group]) {
                limits::check();
                content[item.group].add(
                    ofOutline(picture_.layers[item.layer]).intersection(groups_[item.group]));
            }
        for (std::size_t g = picture_.groups.size(); g-- > 0;) {  // children before parents
            const LoweredGroup& group = picture_.groups[g];
            if (group.clip != noIndex)
                clips[group.clip].add(content[g]);
            if (group.parent != noIndex)
                content[group.parent].add(content[g]);
        }
        clipLayers_.resize(picture_.layers.size());
        for (std::size_t c = clips.size(); c-- > 0;) {  // those within others come before
            const ClipExpression& clip = picture_.clips[c];
            if (clip.outer != noIndex)
                clips[clip.outer].add(clips[c]);
            for (const ClipExpression::Term& term : clip.terms) {
                clipLayers_[term.layer].add(clips[c]);
                if (term.clip != noIndex)
                    clips[term.clip].add(clips[c]);
            }
        }
    }
    Box ofClip(std::uint32_t index) {
        if (known_[index])
            return *known_[index];
        limits::check();
        const ClipExpression& clip = picture_.clips[index];
        Box box;
        for (const ClipExpression::Term& term : clip.terms) {
            const Box shape = term.inverted ? all_ : ofOutline(picture_.layers[term.layer]);
            box.add(term.clip == noIndex ? shape : shape.intersection(ofClip(term.clip)));
        }
        if (clip.outer != noIndex)
            box = box.intersection(ofClip(clip.outer));
        return known_[index].emplace(box);
    }
    /// Pixels of its own on all sides, since what is cut is moved there.
    Box ofOutline(const Layer& layer) const {
        constexpr double more = 1;
        Box box;
        for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r)
            for (std::uint32_t i = picture_.outlines.runs[r].first; i <= picture_.outlines.runs[r].last;
                 ++i) {
                const LatticePoint p = picture_.outlines.points[i];
                box.add(glm::vec2(toPixels_[0] * double(p.x) + toPixels_[1] * double(p.y) + toPixels_[2]));
            }
        return {box.min - more, box.max + more};
    }

    const LoweredScene& picture_;
    const scene::Affine& toPixels_;
    const Box all_;
    const std::vector<std::uint8_t> isClipped_;  ///< by group
    std::vector<Box> groups_;
    std::vector<Box> clipLayers_;  ///< by layer; none without clips
    const Box nothing_;
    std::vector<std::optional<Box>> known_;  ///< by clip
};

/// Where the line from a to b crosses a line across that axis. The same for both directions.
glm::vec2 onLine(glm::vec2 a, glm::vec2 b, int axis, float at) {
    const int along = 1 - axis;
    if (b[axis] < a[axis])
        std::swap(a, b);
    glm::vec2 p;
    p[axis] = at;
    const auto [low, high] = std::minmax(a[along], b[along]);
    p[along] =
        std::clamp(a[along] + (b[along] - a[along]) * ((at - a[axis]) / (b[axis] - a[axis])), low, high);
    return p;
}

}  // namespace

/// Makes chains of contours.
class ViewChains::Builder {
public:
    explicit Builder(ViewChains& into) : into_(into) {}

    /// What is seen of the contours to come, and whether that is less than the view.
    void show(const Box& box, bool isCut) {
        shown_ = box;
        cutsRows_ = isCut;
    }

    /// Where the next contour's points go; the last is equal to the first.
    std::vector<glm::vec2>& points() { return points_; }

    void add(std::uint32_t layer) {
        Box box;
        std::size_t top = 0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            box.add(points_[i]);
            if (points_[i].y < points_[top].y)
                top = i;
        }
        if (!overlap(box, shown_))
            return;
        // Rows above and below the view are left out later.
        if (cutsRows_ && (box.min.y < shown_.min.y || box.max.y > shown_.max.y)) {
            clip(1, float(shown_.min.y), float(shown_.max.y));
            top = highest();
        }
        const float left = float(shown_.min.x) - beside, right = float(shown_.max.x) + beside;
        if (box.min.x < left || box.max.x > right) {
            clip(0, left, right);
            top = highest();
        }
        divide(top, layer);
    }

private:
    std::size_t highest() const {
        return std::size_t(std::ranges::min_element(points_, {}, &glm::vec2::y) - points_.begin());
    }

    /// From an upper end on, so that chains are whole.
    void divide(std::size_t top, std::uint32_t layer) {
        if (points_.size() < 3)
            return;
        points_.pop_back();
        const std::size_t count = points_.size();
        const auto at = [&](std::size_t i) { return points_[i < count ? i : i - count]; };
        std::vector<glm::vec2>& vertices = into_.vertices_;
        for (std::size_t i = top; i < top + count;) {
            const auto first = std::uint32_t(vertices.size());
            glm::vec2 last = at(i);
            vertices.push_back(last);
            bool down = true, isLevel = true;
            for (; i < top + count; ++i) {
                const glm::vec2 next = at(i + 1);
                if (next.y != last.y) {
                    if (!isLevel && (next.y > last.y) != down)
                        break;
                    down = next.y > last.y;
                    isLevel = false;
                }
                if (next != last)
                    vertices.push_back(next);
                last = next;
            }
            if (!down)
                std::reverse(vertices.begin() + first, vertices.end());
            if (isLevel || vertices.back().y <= shown_.min.y || vertices[first].y >= shown_.max.y) {
                vertices.resize(first);
                continue;
            }
            into_.chains_.push_back({first, std::uint32_t(vertices.size()), layer, down ? 1 : -1,
                                     vertices[first].y, vertices.back().y});
        }
    }

    /// Moves what lies outside of low to high, in x (0) or y (1), onto these lines.
    void clip(int axis, float low, float high) {
        clipped_.clear();
        const auto cut = [&](glm::vec2 a, glm::vec2 b, float at) {
            if ((a[axis] < at && b[axis] > at) || (a[axis] > at && b[axis] < at))
                clipped_.push_back(onLine(a, b, axis, at));
        };
        for (std::size_t i = 0; i < points_.size(); ++i) {
            glm::vec2 p = points_[i];
            if (i > 0) {
                const glm::vec2 before = points_[i - 1];
                cut(before, p, before[axis] < p[axis] ? low : high);
                cut(before, p, before[axis] < p[axis] ? high : low);
            }
            p[axis] = std::clamp(p[axis], low, high);
            put(p, axis, low, high);
        }
        points_.swap(clipped_);
    }
    /// On the lines only the ends of a stretch matter.
    void put(glm::vec2 p, int axis, float low, float high) {
        const std::size_t n = clipped_.size();
        const int along = 1 - axis;
        if (n >= 2 && (p[axis] == low || p[axis] == high) && clipped_[n - 1][axis] == p[axis] &&
            clipped_[n - 2][axis] == p[axis] &&
            (clipped_[n - 2][along] <= clipped_[n - 1][along]) == (clipped_[n - 1][along] <= p[along]))
            clipped_.back() = p;
        else
            clipped_.push_back(p);
    }

    ViewChains& into_;
    Box shown_;
    bool cutsRows_ = false;
    std::vector<glm::vec2> points_, clipped_;
};

namespace {

/// In the order of the numbers.
std::uint32_t ascending(float value) {
    constexpr std::uint32_t sign = 0x8000'0000u;
    const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 is 0
    return bits & sign ? ~bits : bits | sign;
}

/// Layers whose chains are made by one thread at a time: so many points of outlines, unless one has more.
constexpr std::size_t pointsAtOnce = 1u << 14;

struct LayersAtOnce {
    std::uint32_t first, end;
};

std::vector<LayersAtOnce> divided(const LoweredScene& picture) {
    const std::vector<Run>& runs = picture.outlines.runs;
    std::vector<LayersAtOnce> parts;
    std::size_t points = pointsAtOnce;
    for (std::uint32_t l = 0; l < picture.layers.size(); ++l) {
        if (points >= pointsAtOnce) {
            parts.push_back({l, l});
            points = 0;
        }
        const Layer& layer = picture.layers[l];
        if (layer.runCount > 0)
            points += runs[layer.firstRun + layer.runCount - 1].last - runs[layer.firstRun].first;
        parts.back().end = l + 1;
    }
    return parts;
}

}  // namespace

/// Adds the chains of a layer.
void ViewChains::addLayer(const LoweredScene& picture, std::uint32_t index, const scene::Affine& toPixels,
                          Builder& builder) {
    const Layer& layer = picture.layers[index];
    picture.outlines.forEachContour(
        layer.firstRun, layer.runCount, [&](std::span<const LatticePoint> contour) {
            std::vector<glm::vec2>& points = builder.points();
            points.resize(contour.size());
            std::ranges::transform(contour, points.begin(), [&](LatticePoint p) -> glm::vec2 {
                return toPixels[0] * double(p.x) + toPixels[1] * double(p.y) + toPixels[2];
            });
            builder.add(index);
        });
}

ViewChains::ViewChains(const LoweredScene& picture, const Lattice& lattice, const asset::View& view) {
    const scene::Affine toPixels = scene::compose(view.toPixels, *scene::inverse(lattice.toSteps()));
    const ShownBoxes boxes(picture, toPixels, view);
    const std::vector<LayersAtOnce> parts = divided(picture);
    std::vector<ViewChains> made(parts.size());
    tbb::parallel_for(std::size_t{0}, parts.size(), [&, holding = limits::current()](std::size_t i) {
        const limits::Scope scope(holding);
        Builder builder(made[i]);
        for (std::uint32_t l = parts[i].first; l < parts[i].end; ++l) {
            limits::check();
            const Box* const cut = boxes.ofLayer(l);
            builder.show(cut ? *cut : boxes.view(), cut != nullptr);
            addLayer(picture, l, toPixels, builder);
        }
    });
    if (made.size() == 1)
        *this = std::move(made.front());
    else
        append(made);
    made.clear();
    findBands(view.height);
}

void ViewChains::append(const std::vector<ViewChains>& parts) {
    std::size_t vertices = 0, chains = 0;
    for (const ViewChains& part : parts)
        vertices += part.vertices_.size(), chains += part.chains_.size();
    limits::need(vertices * sizeof(glm::vec2) + chains * sizeof(DownChain));
    vertices_.reserve(vertices);
    chains_.reserve(chains);
    for (const ViewChains& part : parts) {
        const auto before = std::uint32_t(vertices_.size());
        vertices_.insert(vertices_.end(), part.vertices_.begin(), part.vertices_.end());
        for (DownChain chain : part.chains_) {
            chain.first += before;
            chain.end += before;
            chains_.push_back(chain);
        }
    }
}

void ViewChains::findBands(int height) {
    height_ = height;
    const auto bandCount = std::size_t((height + bandRows - 1) / bandRows);
    const auto bandOf = [&](float y) {
        return std::size_t(std::clamp(int(y) / bandRows, 0, int(bandCount) - 1));
    };
    const std::vector<std::uint64_t> byTop = sortedByTop(bandCount, bandOf);
    firsts_.resize(bandCount + 1);
    for (const DownChain& c : chains_)
        for (std::size_t band = bandOf(c.top); band <= bandOf(c.bottom); ++band)
            ++firsts_[band + 1];
    for (std::size_t band = 0; band < bandCount; ++band)
        firsts_[band + 1] += firsts_[band];
    numbers_.resize(firsts_.back());
    std::vector<std::uint32_t> next(firsts_.begin(), firsts_.end() - 1);
    for (const std::uint64_t key : byTop) {
        const auto c = std::uint32_t(key);
        for (std::size_t band = bandOf(chains_[c].top); band <= bandOf(chains_[c].bottom); ++band)
            numbers_[next[band]++] = c;
    }
}

/// Below their tops, as integers that ascend with them, the numbers of the chains.
template <class BandOf>
std::vector<std::uint64_t> ViewChains::sortedByTop(std::size_t bandCount, const BandOf& bandOf) const {
    std::vector<std::uint32_t> firsts(bandCount + 1);
    std::vector<std::uint64_t> byTop(chains_.size());
    for (const DownChain& c : chains_)
        ++firsts[bandOf(c.top) + 1];
    for (std::size_t band = 0; band < bandCount; ++band)
        firsts[band + 1] += firsts[band];
    std::vector<std::uint32_t> next(firsts.begin(), firsts.end() - 1);
    for (std::uint32_t c = 0; c < chains_.size(); ++c)
        byTop[next[bandOf(chains_[c].top)]++] = std::uint64_t(ascending(chains_[c].top)) << 32 | c;
    const auto sortBands = [&](std::size_t first, std::size_t end) {
        for (std::size_t band = first; band < end; ++band)
            std::sort(byTop.begin() + firsts[band], byTop.begin() + firsts[band + 1]);
    };
    constexpr std::size_t manyChains = 1u << 13, bandsAtOnce = 8;  // fewer are not worth threads
    if (chains_.size() < manyChains)
        sortBands(0, bandCount);
    else
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bandCount, bandsAtOnce),
                          [&](const auto& bands) { sortBands(bands.begin(), bands.end()); });
    return byTop;
}

}  // namespace vtm::compiler
