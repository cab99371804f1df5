#include "compiler/direct/resolve_clips.hpp"

#include <cstddef>
#include <vector>

#include <vtm/limits/limits.hpp>
#include "compiler/paint/composite.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {
namespace {

using geometry::Box;
using geometry::Point;

/// Clips are looked at again for each group: at so many of their points in all.
constexpr std::size_t mostLooks = 1u << 26;

class ClipResolver {
public:
    explicit ClipResolver(LoweredScene& picture) : picture_(picture) {}

    void resolve() {
        findContent();
        std::vector<std::uint8_t> isAway(picture_.groups.size());
        for (std::size_t g = 0; g < picture_.groups.size(); ++g) {  // parents come first
            LoweredGroup& group = picture_.groups[g];
            isAway[g] = group.parent != noIndex && isAway[group.parent] != 0;
            if (isAway[g] != 0 || group.clip == noIndex || content_[g].empty())
                continue;
            const Cover cover = clipCover(picture_, group.clip, [&](std::uint32_t layer) {
                return coverOf(picture_.layers[layer], content_[g]);
            });
            isAway[g] = cover == Cover::Out;
            if (cover == Cover::In)
                group.clip = noIndex;
        }
        for (const LoweredItem& item : picture_.items)
            if (isAway[item.group] != 0)
                picture_.layers[item.layer].runCount = 0;
    }

private:
    /// Around the items of each group.
    void findContent() {
        content_.resize(picture_.groups.size());
        for (const LoweredItem& item : picture_.items) {
            limits::check();
            forEachEdge(picture_.layers[item.layer], [&](Point a, Point) {
                content_[item.group].add(a);
                return true;
            });
        }
        for (std::size_t g = picture_.groups.size(); g-- > 1;)  // children come before their parents
            content_[picture_.groups[g].parent].add(content_[g]);
    }

    /// How far a layer covers a box.
    Cover coverOf(const Layer& layer, const Box& box) {
        const double middle = 0.5 * (box.min.y + box.max.y);
        int winding = 0;
        const bool isBeside = forEachEdge(layer, [&](Point a, Point b) {
            if (a.x <= box.min.x && b.x <= box.min.x) {
                winding += (b.y > middle) - (a.y > middle);
                return ++looks_ < mostLooks;
            }
            const bool isOutside = (a.x >= box.max.x && b.x >= box.max.x) ||
                                   (a.y <= box.min.y && b.y <= box.min.y) ||
                                   (a.y >= box.max.y && b.y >= box.max.y);
            return isOutside && ++looks_ < mostLooks;
        });
        if (!isBeside)
            return Cover::Edge;
        return (layer.rule == scene::FillRule::EvenOdd ? winding % 2 : winding) != 0 ? Cover::In : Cover::Out;
    }

    /// Calls visit(from, to), which tells whether to go on, and returns whether it always did.
    template <class Visit>
    bool forEachEdge(const Layer& layer, const Visit& visit) const {
        const auto at = [&](std::uint32_t i) {
            const LatticePoint p = picture_.outlines.points[i];
            return Point(double(p.x), double(p.y));
        };
        for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r)
            for (std::uint32_t i = picture_.outlines.runs[r].first; i < picture_.outlines.runs[r].last; ++i)
                if (!visit(at(i), at(i + 1)))
                    return false;
        return true;
    }

    LoweredScene& picture_;
    std::vector<Box> content_;  ///< by group
    std::size_t looks_ = 0;
};

}  // namespace

void resolveClips(LoweredScene& picture) {
    if (!picture.clips.empty())
        ClipResolver(picture).resolve();
}

}  // namespace vtm::compiler
