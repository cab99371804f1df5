#include "compiler/session/filtered_parts.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <variant>

#include <vtm/scene/affine.hpp>
#include "compiler/compile/settings.hpp"
#include "compiler/containers/hash.hpp"
#include "compiler/session/changed_areas.hpp"
#include "compiler/session/same_nodes.hpp"

namespace vtm::compiler {
namespace {

using geometry::Box;

/// Filters' pixels are interpolated between two, where the view is turned.
constexpr int resampledPixels = 2;

/// The first item in the nodes, if there is one.
const scene::Item* firstItem(const scene::NodeList& nodes) {
    for (const scene::Node& node : nodes)
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return item;
        else if (const auto* group = std::get_if<scene::Group>(&node.value))
            if (const scene::Item* first = firstItem(group->children))
                return first;
    return nullptr;
}

/// By where its first item begins: parts that are the same have the same, others seldom.
std::size_t keyOf(const scene::NodeList& nodes) {
    const scene::Item* item = firstItem(nodes);
    if (!item || item->path->empty())
        return 0;
    const scene::Point begin = scene::apply(item->transform, std::get<scene::MoveTo>(item->path->front()).to);
    return hashCombine(hashCombine(bits(begin.x), bits(begin.y)), item->path->size());
}

double longerSide(const Box& box) { return std::max(box.width(), box.height()); }

/// Whether a frame may stay that of a part, so that its lattice does: it need not be the least one.
bool fits(const Box& frame, const PlainPart& part) {
    constexpr double maxTimes = 2;
    const Box least{0.5 * (part.content.min + part.frame.min), 0.5 * (part.content.max + part.frame.max)};
    return part.seen.contains(frame) && frame.contains(least) &&
           longerSide(frame) <= maxTimes * longerSide(part.frame);
}

/// Gives the memory of an asset's nodes, leaves and pieces, which are lost, to one that has none yet.
void giveMemory(asset::Asset& from, asset::Asset& to) {
    const auto give = [&](auto records) {
        (from.*records).clear();
        to.*records = std::move(from.*records);
    };
    give(&asset::Asset::nodes);
    give(&asset::Asset::leaves);
    give(&asset::Asset::pieces);
}

}  // namespace

/// For each part the one before that has the same nodes and a frame that fits, else the one that stood in its
/// place, if there is one.
std::vector<FilteredParts::Last> FilteredParts::lastOf(const std::vector<PlainPart>& now,
                                                       std::vector<Part>& before) {
    std::unordered_multimap<std::size_t, Part*> free;
    for (Part& part : before)
        free.emplace(keyOf(part.from.nodes), &part);
    std::vector<Last> last(now.size());
    std::vector<bool> isTaken(before.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        const auto [first, end] = free.equal_range(keyOf(now[i].nodes));
        const auto same = std::find_if(first, end, [&](const auto& entry) {
            const PlainPart& from = entry.second->from;
            return fits(from.frame, now[i]) && areSame(from.nodes, now[i].nodes);
        });
        if (same == end)
            continue;
        last[i] = {same->second, true};
        isTaken[std::size_t(same->second - before.data())] = true;
        free.erase(same);
    }
    std::size_t place = 0;  // after the last one that was found
    for (Last& one : last)
        if (one.isSame) {
            place = std::size_t(one.part - before.data()) + 1;
        } else if (place < before.size() && !isTaken[place]) {
            isTaken[place] = true;
            one.part = &before[place++];
        }
    return last;
}

/// Of the part's maps; it still has the place that it had before.
std::vector<asset::MapChange> FilteredParts::changesOf(const Part& part, bool isSame) {
    std::vector<asset::MapChange> changes(part.picture.result().asset.maps.size());
    const asset::Difference& edit = part.picture.report().difference;
    if (isSame)
        for (std::uint32_t i = 0; i < changes.size(); ++i)
            changes[i] = {part.firstMap + i, {}, false};
    else if (!edit.everything)  // then it has one map
        changes[0] = {part.firstMap, edit.squares, edit.paints || edit.images};
    return changes;
}

/// Brings the parts before to those of the plan, whose frames become theirs.
std::vector<FilteredParts::Part> FilteredParts::partsOf(FilterPlan& plan, const std::vector<Last>& last,
                                                        const Excerpt& whole, const Options& options) {
    std::vector<Part> parts(last.size());
    for (std::size_t i = 0; i < last.size(); ++i) {
        PlainPart& from = plan.parts[i];
        if (last[i].part) {
            parts[i] = std::move(*last[i].part);
            if (fits(parts[i].from.frame, from))
                from.frame = parts[i].from.frame;
        }
        EditedPicture& picture = parts[i].picture;
        if (last[i].isSame) {
            picture.keep();
        } else {
            const PartPicture part = pictureOf(from, whole, options);
            if (last[i].part)
                picture.update(part.scene, part.excerpt, part.options);
            else
                picture.compile(part.scene, part.excerpt, part.options);
        }
        parts[i].from = {std::move(from.nodes), from.content, from.seen, from.frame};
    }
    return parts;
}

void FilteredParts::update(const scene::Scene& scene, std::vector<const scene::Path*> paths,
                           const Options& options) {
    const Excerpt whole = wholeOf(scene);
    std::vector<Part> before = std::exchange(parts_, {});  // lost if anything throws
    const bool isSameSize = scene_.width == scene.width && scene_.height == scene.height;
    if (!isSameSize)
        before.clear();
    FilterPlan plan = planFiltered(scene, whole, options,
                                   [](const scene::Scene& part, const Excerpt& of, const Options& how) {
                                       return compileExcerpt(part, of, how);
                                   });
    const std::vector<Last> last = lastOf(plan.parts, before);
    std::vector<const Part*> hadImages, haveImages;  // where they were before, or null
    for (const Part& part : before)
        if (!part.picture.result().asset.images.empty())
            hadImages.push_back(&part);
    std::vector<Part> parts = partsOf(plan, last, whole, options);

    Edited report{{.anew = before.empty(), .blocksInAll = last.size()}, {}};
    asset::Difference& difference = report.difference;
    giveMemory(spare_, plan.commands.asset);
    const auto take = [&](std::size_t i) -> const Result& {
        const Result& picture = parts[i].picture.result();
        const Edited& edit = parts[i].picture.report();
        const bool isSame = last[i].isSame;
        if (!isSame) {
            ++report.update.blocks;
            report.update.outlines += edit.update.outlines;
            report.update.paints += edit.update.paints;
        }
        if (!picture.asset.images.empty())
            haveImages.push_back(
                isSame || !(edit.difference.everything || edit.difference.images) ? last[i].part : nullptr);
        std::ranges::move(changesOf(parts[i], isSame), std::back_inserter(difference.maps));
        parts[i].firstMap = static_cast<std::uint32_t>(difference.maps.size() - picture.asset.maps.size());
        return picture;
    };
    Result result = joinParts(std::move(plan.commands), plan.parts, whole, take);
    difference.images =
        before.empty() || haveImages != hadImages || result.asset.materials != result_.asset.materials;
    difference.pixelsAround = resampledPixels;
    difference.areas = isSameSize ? changedAreas(scene_, scene)
                                  : std::vector<asset::Area>{{0, 0, scene.width, scene.height}};
    std::ranges::sort(paths);
    paths_.clear();  // before the scene that holds them
    scene_ = scene;
    paths_ = std::move(paths);
    parts_ = std::move(parts);
    std::swap(result_, result);
    giveMemory(result.asset, spare_);
    report_ = std::move(report);
}

}  // namespace vtm::compiler
