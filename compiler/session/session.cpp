#include <vtm/compiler/session.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "compiler/compile/settings.hpp"
#include "compiler/filters/compile_filtered.hpp"
#include "compiler/session/changed_areas.hpp"
#include "compiler/session/editor.hpp"
#include "compiler/session/filtered_parts.hpp"

namespace vtm::compiler {

namespace {

/// What each item's outline is made from, hashed, in the scene's order.
void addOutlineKeys(const scene::Group& group, std::vector<std::uint64_t>& keys) {
    for (const scene::Node& node : group.children) {
        if (const auto* inner = std::get_if<scene::Group>(&node.value))
            addOutlineKeys(*inner, keys);
        else if (const auto* item = std::get_if<scene::Item>(&node.value))
            keys.push_back(OutlineCache::hash(
                {item->path, item->transform, std::get_if<scene::StrokeStyle>(&item->geometry)}));
    }
}

}  // namespace

class Session::State {
public:
    explicit State(const Options& options) : options_(options) { checkOptions(options_); }

    void update(const scene::Scene& scene) {
        scene::validate(scene, [&](const scene::Path& path) { return kept_ && kept_->cache.knows(path); });
        if (options_.mode == asset::Mode::Exact && options_.filterPixels == 0 && hasFilters(scene))
            return compileParts(scene);
        filtered_.reset();
        if (options_.mode != asset::Mode::Exact || hasFilters(scene) || (!kept_ && isMostlyNew(scene)))
            return compileAnew(scene);
        std::unique_ptr<Kept> kept = std::move(kept_);  // lost if anything throws
        if (kept && (kept->width != scene.width || kept->height != scene.height))
            kept.reset();
        switch (kept ? tryEdit(*kept, scene) : Outcome::TooLarge) {
            case Outcome::Done:
                break;
            case Outcome::MostlyNew:
                return compileAnew(scene);
            case Outcome::TooLarge:
                kept = std::make_unique<Kept>(scene.width, scene.height, options_);
                report_ = *edit(*kept, result_, scene, options_);
        }
        if (!kept->isWorn())
            kept_ = std::move(kept);
        compiled_.clear();
    }

    const Result& result() const { return result_; }
    const Edited& report() const { return report_; }

private:
    /// Without blocks and stacks, which are of use only if the next scene is much the same.
    void compileAnew(const scene::Scene& scene) {
        kept_.reset();
        result_ = compile(scene, options_);
        report_ = {{.anew = true}, {}};
        report_.difference.areas = {wholeArea(scene)};
        compiled_ = keysOf(scene);
    }

    /// Of what lies between filters, the parts that changed.
    void compileParts(const scene::Scene& scene) {
        std::unique_ptr<Filtered> filtered = std::move(filtered_);  // lost if anything throws
        kept_.reset();
        compiled_.clear();
        report_ = {};
        report_.update.anew = !filtered;
        if (!filtered)
            filtered = std::make_unique<Filtered>();
        result_ = filtered->parts.compile(scene, options_);
        report_.update.blocks = filtered->parts.compiled();
        report_.update.blocksInAll = filtered->parts.size();
        report_.difference.pixelsAround = resampledPixels;
        const bool isSameSize =
            filtered->scene.width == scene.width && filtered->scene.height == scene.height;
        report_.difference.areas =
            isSameSize ? changedAreas(filtered->scene, scene) : std::vector<asset::Area>{wholeArea(scene)};
        filtered->scene = scene;
        filtered_ = std::move(filtered);
    }

    /// By what was compiled last. An animation that moves everything is compiled picture by picture.
    bool isMostlyNew(const scene::Scene& scene) const {
        if (compiled_.empty())
            return false;
        const std::vector<std::uint64_t> keys = keysOf(scene);
        std::size_t known = 0;
        for (const std::uint64_t key : keys)
            known += std::ranges::binary_search(compiled_, key);
        return 2 * known < keys.size();
    }

    static std::vector<std::uint64_t> keysOf(const scene::Scene& scene) {
        std::vector<std::uint64_t> keys;
        addOutlineKeys(scene.root, keys);
        std::ranges::sort(keys);
        return keys;
    }

    enum class Outcome { Done, MostlyNew, TooLarge };

    /// What is kept counts towards limits too, used or not.
    Outcome tryEdit(Kept& kept, const scene::Scene& scene) {
        try {
            const std::optional<Edited> edited = edit(kept, result_, scene, options_);
            if (!edited)
                return Outcome::MostlyNew;
            report_ = *edited;
            return Outcome::Done;
        } catch (const LimitError&) {
            return Outcome::TooLarge;
        }
    }

    /// Filters' pixels are interpolated between two, where the view is turned.
    static constexpr int resampledPixels = 2;

    /// Of a scene with filters.
    struct Filtered {
        FilteredParts parts;
        scene::Scene scene;
    };

    const Options options_;
    std::unique_ptr<Kept> kept_;
    std::unique_ptr<Filtered> filtered_;
    Result result_;
    Edited report_;
    std::vector<std::uint64_t>
        compiled_;  ///< sorted keys of the scene, if it was compiled without what is kept
};

Session::Session(const scene::Scene& scene, const Options& options)
    : state_(std::make_unique<State>(options)) {
    update(scene);
}

Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

const Result& Session::update(const scene::Scene& scene) {
    state_->update(scene);
    return state_->result();
}

const Result& Session::result() const { return state_->result(); }
const Update& Session::lastUpdate() const { return state_->report().update; }
const asset::Difference& Session::difference() const { return state_->report().difference; }

}  // namespace vtm::compiler
