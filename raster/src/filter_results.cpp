#include "raster/src/filter_results.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "asset/filters.hpp"
#include "raster/src/command_stack.hpp"

namespace vtm::asset {

namespace {

/// Of all results: 64 MiB.
constexpr std::size_t maxPixels = std::size_t(1) << 22;
/// Where a result changed in more boxes that were not drawn, it is made anew.
constexpr std::size_t maxStale = 32;

template <class Record>
void append(const Record& record, std::string& bytes) {
    bytes.append(reinterpret_cast<const char*>(&record), sizeof record);
}

void appendFilter(const AssetView& asset, const Filter& filter, std::string& bytes) {
    append(filter.matrix, bytes);
    append(filter.region, bytes);
    for (const FilterPrimitive& primitive : primitivesOf(asset, filter)) {
        append(primitive.op, bytes);
        append(primitive.linear, bytes);
        append(primitive.inputs, bytes);
        append(primitive.region, bytes);
        const auto words =
            asset.filterWords.subspan(primitive.firstWord, primitive.inputs + primitive.parameters);
        bytes.append(reinterpret_cast<const char*>(words.data()), words.size_bytes());
    }
}

bool isSame(const MapChange& change) {
    return change.before != MapChange::isNew && change.squares.empty() && !change.paints;
}

bool meet(const PixelBox& a, const PixelBox& b) { return !a.intersection(b).empty(); }

bool isWithin(const PixelBox& inner, const PixelBox& outer) {
    return inner.empty() || inner.joined(outer).area() == outer.area();
}

}  // namespace

std::span<const Command> filteredBy(const AssetView& asset, std::span<const Command> commands) {
    int pictures = 0;
    for (std::size_t i = 0;; ++i) {
        pictures += picturesPushed(asset, commands[i]);
        if (pictures == 1 && commands[i].kind == Command::Kind::Filter)
            return commands.first(i + 1);
    }
}

FilterResults::FilterResults(const AssetView& asset, const View& view)
    : view_(view), origins_(originsOf(asset)), mapCount_(asset.maps.size()) {}

FilterResults::Origin FilterResults::originOf(const AssetView& asset, std::span<const Command> commands) {
    Origin origin;
    for (const Command& command : commands) {
        append(command.kind, origin.records);
        append(command.blend, origin.records);
        append(command.opacity, origin.records);
        if (command.kind == Command::Kind::DrawMap)
            origin.maps.push_back(command.map);
        else if (command.kind == Command::Kind::Filter)
            appendFilter(asset, asset.filters[command.map], origin.records);
    }
    return origin;
}

std::map<std::size_t, FilterResults::Origin> FilterResults::originsOf(const AssetView& asset) {
    std::map<std::size_t, Origin> origins;
    for (std::size_t i = 0; i < asset.commands.size(); ++i)
        if (asset.commands[i].kind == Command::Kind::PushInput) {
            const auto commands = filteredBy(asset, asset.commands.subspan(i));
            origins[i] = originOf(asset, commands);
            i += commands.size() - 1;
        }
    return origins;
}

/// Whether a single map changed, and all are where they were. Only then it is sure that the areas of the
/// difference are those in which a filter's inputs changed: else its maps may be taken for those of another.
bool FilterResults::isOneEdit(const Difference& difference) const {
    std::size_t edited = 0;
    for (std::size_t i = 0; i < difference.maps.size(); ++i) {
        if (difference.maps[i].before != i)
            return false;
        edited += !isSame(difference.maps[i]);
    }
    return edited == 1 && difference.maps.size() == mapCount_;
}

void FilterResults::update(const AssetView& asset, const Difference& difference) {
    std::map<std::size_t, Origin> origins = originsOf(asset);
    if (difference.maps.empty())  // as in compat mode: nothing is known of what is drawn
        results_.clear();
    std::map<std::size_t, Result> results;
    std::map<std::vector<std::uint32_t>, std::size_t> before;
    for (const auto& [first, result] : results_)
        before.emplace(origins_.at(first).maps, first);
    const std::vector<PixelBox> boxes = changedPixels(view_, difference);
    const bool oneEdit = isOneEdit(difference);
    pixels_ = 0;
    for (const auto& [first, origin] : origins) {
        std::vector<std::uint32_t> mapsBefore;
        bool areSame = true;
        for (const std::uint32_t map : origin.maps) {
            const MapChange change = map < difference.maps.size() ? difference.maps[map] : MapChange{};
            mapsBefore.push_back(change.before);
            areSame &= isSame(change);
        }
        const auto last = before.find(mapsBefore);
        if (last == before.end() || origins_.at(last->second).records != origin.records ||
            !(areSame || oneEdit))
            continue;
        Result result = std::move(results_.at(last->second));
        before.erase(last);
        if (!areSame)
            std::ranges::copy_if(boxes, std::back_inserter(result.stale),
                                 [&](const PixelBox& box) { return meet(box, result.box); });
        if (result.stale.size() > maxStale)
            continue;
        pixels_ += result.box.area();
        results.emplace(first, std::move(result));
    }
    origins_ = std::move(origins);
    results_ = std::move(results);
    mapCount_ = asset.maps.size();
}

bool FilterResults::isOf(const View& view) const {
    return view.width == view_.width && view.height == view_.height && view.toPixels == view_.toPixels;
}

std::optional<Canvas> FilterResults::find(std::size_t first, const PixelBox& box, const View& below) const {
    const std::lock_guard lock(mutex_);
    const auto found = results_.find(first);
    if (found == results_.end())
        return std::nullopt;
    const Result& result = found->second;
    if (std::ranges::any_of(result.stale, [&](const PixelBox& stale) { return meet(stale, box); }))
        return std::nullopt;
    const PixelBox shown = result.box.intersection(box);
    PixelMemory pixels(shown.area());
    Float4* to = pixels.data();
    const auto width = std::size_t(result.box.width());
    for (int y = shown.min.y; y < shown.max.y; ++y) {
        const Float4* from = result.pixels.data() + std::size_t(y - result.box.min.y) * width +
                             std::size_t(shown.min.x - result.box.min.x);
        to = std::copy_n(from, shown.width(), to);
    }
    return Canvas(below, shown.empty() ? PixelBox{} : shown.moved(-box.min), std::move(pixels));
}

/// The pixels of a canvas that shows a box of the view.
void FilterResults::copy(const Canvas& from, const PixelBox& box, Result& to) {
    const PixelBox both = box.intersection(to.box);
    for (int y = both.min.y; y < both.max.y; ++y) {
        Float4* row = to.pixels.data() + std::size_t(y - to.box.min.y) * std::size_t(to.box.width());
        std::fill(row + (both.min.x - to.box.min.x), row + (both.max.x - to.box.min.x), Float4{});
        PixelRun run = from.run(y - box.min.y);
        if (run.empty())
            continue;
        run = PixelRun{run.first + box.min.x, run.end + box.min.x}.intersection({both.min.x, both.max.x});
        if (!run.empty())
            std::copy_n(from.at(y - box.min.y, run.first - box.min.x), run.end - run.first,
                        row + (run.first - to.box.min.x));
    }
}

void FilterResults::put(std::size_t first, const PixelBox& shown, const PixelBox& box, const Canvas& result) {
    const std::lock_guard lock(mutex_);
    auto found = results_.find(first);
    if (isWithin(shown, box)) {
        const std::size_t before = found == results_.end() ? 0 : found->second.box.area();
        if (pixels_ - before + shown.area() > maxPixels)
            return;
        pixels_ += shown.area() - before;
        found = results_.insert_or_assign(first, Result{shown, std::vector<Float4>(shown.area()), {}}).first;
    }
    if (found == results_.end())
        return;
    Result& kept = found->second;
    copy(result, box, kept);
    std::erase_if(kept.stale,
                  [&](const PixelBox& stale) { return isWithin(stale.intersection(kept.box), box); });
}

}  // namespace vtm::asset
