#include "compiler/session/changed_areas.hpp"

#include <algorithm>
#include <cmath>

#include <vtm/scene/affine.hpp>
#include "compiler/filters/bounds.hpp"
#include "compiler/session/same_nodes.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {
namespace {

using geometry::Box;
using scene::Group;
using scene::Node;
using scene::NodeList;

class Walk {
public:
    explicit Walk(const scene::Scene& scene) : frame_{{0, 0}, {scene.width, scene.height}} {}

    void groups(const Group& before, const Group& after) {
        if (!isSameBesideChildren(before, after)) {
            add({{before}, {after}});
            return;
        }
        if (before.filter)
            filters_.push_back(before.filter.get());
        lists(before.children, after.children);
        if (before.filter)
            filters_.pop_back();
    }
    std::vector<asset::Area> take() { return std::move(areas_); }

private:
    /// What stands between nodes that are the same was replaced.
    void lists(const NodeList& before, const NodeList& after) {
        if (before.size() == after.size()) {
            for (std::size_t i = 0; i < before.size(); ++i)
                nodes(before[i], after[i]);
            return;
        }
        const auto same = [](const Node& a, const Node& b) { return isSame(a, b); };
        const auto [first, firstAfter] = std::ranges::mismatch(before, after, same);
        auto end = before.end(), endAfter = after.end();
        while (end != first && endAfter != firstAfter && isSame(end[-1], endAfter[-1]))
            --end, --endAfter;
        NodeList changed(first, end);
        changed.insert(changed.end(), firstAfter, endAfter);
        add(changed);
    }

    void nodes(const Node& before, const Node& after) {
        const auto* group = std::get_if<Group>(&before.value);
        const auto* other = std::get_if<Group>(&after.value);
        if (group && other)
            groups(*group, *other);
        else if (!isSame(before, after))
            add({before, after});
    }

    void add(const NodeList& changed) {
        Box box = boundsOf(changed, scene::identity);
        std::for_each(filters_.rbegin(), filters_.rend(),
                      [&](const scene::Filter* filter) { box = spread(box, *filter); });
        box = box.intersection(frame_);
        if (!box.empty())
            areas_.push_back({box.min.x, box.min.y, box.max.x, box.max.y});
    }

    /// Where a filter shows what changed in its inputs.
    static Box spread(const Box& box, const scene::Filter& filter) {
        const scene::Affine& toPicture = filter.transform;
        const Box region = geometry::mapped({filter.min, filter.max}, toPicture);
        // Of an edge's light a share of 3e-5 is farther away.
        constexpr double deviations = 4;
        const scene::Point reach = reachOf(filter, deviations);
        if (!(std::isfinite(reach.x) && std::isfinite(reach.y)))
            return region;
        const scene::Point across = glm::abs(toPicture[0]) * reach.x + glm::abs(toPicture[1]) * reach.y;
        return Box{box.min - across, box.max + across}.intersection(region);
    }

    const Box frame_;
    std::vector<const scene::Filter*> filters_;  ///< around what is looked at, the innermost last
    std::vector<asset::Area> areas_;
};

}  // namespace

std::vector<asset::Area> changedAreas(const scene::Scene& before, const scene::Scene& after) {
    Walk walk(after);
    walk.groups(before.root, after.root);
    return walk.take();
}

}  // namespace vtm::compiler
