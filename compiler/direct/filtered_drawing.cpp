#include "compiler/direct/filtered_drawing.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "compiler/compile/settings.hpp"
#include "compiler/direct/plain_drawing.hpp"
#include "compiler/filters/compile_filtered.hpp"

namespace vtm::compiler {
namespace {

/// An asset of one map that holds nothing.
Result standIn(const Excerpt& excerpt) {
    Result result;
    asset::Asset& asset = result.asset;
    asset.width = excerpt.width;
    asset.height = excerpt.height;
    asset.paints.emplace_back();
    asset.maps.push_back({0, 0, std::max(excerpt.width, excerpt.height), {}});
    asset.commands.emplace_back().kind = asset::Command::Kind::DrawMap;
    asset.finestPixel = 0;
    return result;
}

/// Draws parts where commands of `asset` draw their maps.
class PartDrawer : public asset::MapDrawer {
public:
    /// `commands` must outlive it.
    PartDrawer(std::vector<PartPicture> parts, const Result& commands)
        : parts_(std::move(parts)), commands_(commands), warnings_(parts_.size()) {}

    void add(const asset::Command& command, const asset::View& view, const asset::PixelsToAddTo& pixels,
             const asset::MaterialFunction&) const override {
        if (const auto drawing = drawingOf(command, view))
            drawing->add(pixels);
    }
    void layOver(const asset::Command& command, float opacity, const asset::View& view,
                 const asset::PixelsToAddTo& pixels, const asset::MaterialFunction&) const override {
        if (const auto drawing = drawingOf(command, view))
            drawing->layOver(opacity, pixels);
    }

    /// Whether all parts could be drawn.
    bool isComplete() const { return isComplete_; }
    /// Of the commands and of all parts that were drawn.
    std::vector<std::string> warnings() const {
        std::vector<std::string> all = commands_.warnings;
        for (const std::vector<std::string>& ofPart : warnings_)
            for (const std::string& warning : ofPart)
                if (std::ranges::find(all, warning) == all.end())
                    all.push_back(warning);
        return all;
    }

private:
    std::unique_ptr<const PlainDrawing> drawingOf(const asset::Command& command,
                                                  const asset::View& view) const {
        if (!isComplete_)
            return nullptr;
        const PartPicture& part = parts_[command.map];
        const asset::Map& map = commands_.asset.maps[command.map];
        const asset::View ofPart{view.width, view.height,
                                 scene::compose(view.toPixels, scene::translation(map.x, map.y))};
        auto drawing = PlainDrawing::make(part.scene, part.excerpt, ofPart, part.options);
        if (drawing)
            warnings_[command.map] = drawing->warnings();
        else
            isComplete_ = false;
        return drawing;
    }

    const std::vector<PartPicture> parts_;  ///< by map
    const Result& commands_;
    // Several commands may be drawn at once, but each draws a part of its own.
    mutable std::atomic<bool> isComplete_ = true;
    mutable std::vector<std::vector<std::string>> warnings_;  ///< by map
};

}  // namespace

std::unique_ptr<const FilteredDrawing> FilteredDrawing::make(const scene::Scene& scene,
                                                             const Excerpt& excerpt, const asset::View& view,
                                                             Options options) {
    options.filterPixels = 0;
    const auto compiled = [](const scene::Scene& part, const Excerpt& of, const Options& how) {
        return compileExcerpt(part, of, how);
    };
    FilterPlan plan = planFiltered(scene, excerpt, options, compiled);
    std::vector<PartPicture> parts;
    for (const PlainPart& part : plan.parts)
        parts.push_back(pictureOf(part, excerpt, options));
    Result last;
    const Result commands =
        joinParts(std::move(plan.commands), plan.parts, excerpt,
                  [&](std::size_t part) -> const Result& { return last = standIn(parts[part].excerpt); });
    PartDrawer drawer(std::move(parts), commands);
    asset::CommandPicture picture(commands.asset, view, drawer);
    if (!drawer.isComplete())
        return nullptr;
    return std::unique_ptr<const FilteredDrawing>(new FilteredDrawing{std::move(picture), drawer.warnings()});
}

}  // namespace vtm::compiler
