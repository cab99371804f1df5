#include "compiler/session/edited_picture.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "compiler/compile/settings.hpp"

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

std::vector<std::uint64_t> keysOf(const scene::Scene& scene) {
    std::vector<std::uint64_t> keys;
    addOutlineKeys(scene.root, keys);
    std::ranges::sort(keys);
    return keys;
}

}  // namespace

void EditedPicture::compile(const scene::Scene& scene, const Excerpt& excerpt, const Options& options) {
    kept_.reset();
    result_ = compileExcerpt(scene, excerpt, options);
    report_ = {{.anew = true}, {}};
    report_.difference.areas = {{0, 0, excerpt.width, excerpt.height}};
    compiled_ = keysOf(scene);
}

void EditedPicture::update(const scene::Scene& scene, const Excerpt& excerpt, const Options& options) {
    if (!kept_ && isMostlyNew(scene))
        return compile(scene, excerpt, options);
    std::unique_ptr<Kept> kept = std::move(kept_);  // lost if anything throws
    if (kept && kept->excerpt != excerpt)
        kept.reset();
    if (!tryEdit(kept, scene, excerpt, options))
        return compile(scene, excerpt, options);
    if (!kept->isWorn())
        kept_ = std::move(kept);
    compiled_.clear();
}

/// Makes what is to be kept if there is nothing. Whether it did it.
bool EditedPicture::tryEdit(std::unique_ptr<Kept>& kept, const scene::Scene& scene, const Excerpt& excerpt,
                            const Options& options) {
    std::optional<Edited> edited;
    if (kept) {
        try {
            edited = edit(*kept, result_, scene, options);
            if (!edited)
                return false;
        } catch (const LimitError&) {
            // What is kept counts towards limits too, used or not.
        }
    }
    if (!edited) {
        kept = std::make_unique<Kept>(excerpt, options);
        edited = edit(*kept, result_, scene, options);
    }
    if (edited)
        report_ = std::move(*edited);
    return edited.has_value();
}

/// By what was compiled last. An animation that moves everything is compiled picture by picture.
bool EditedPicture::isMostlyNew(const scene::Scene& scene) const {
    if (compiled_.empty())
        return false;
    const std::vector<std::uint64_t> keys = keysOf(scene);
    std::size_t known = 0;
    for (const std::uint64_t key : keys)
        known += std::ranges::binary_search(compiled_, key);
    return 2 * known < keys.size();
}

}  // namespace vtm::compiler
