#include "compiler/lower/repeated_paths.hpp"

#include <cstdint>

#include "compiler/containers/hash.hpp"

namespace vtm::compiler {
namespace {

/// A fill and the stroke of its outline hold a path, and who made the scene.
constexpr long fewPlaces = 3;
/// No more are kept.
constexpr std::size_t mostKeptPoints = 1u << 20;

}  // namespace

std::size_t RepeatedPaths::Hash::operator()(const Key& key) const {
    std::uint64_t hash = reinterpret_cast<std::uintptr_t>(key.path);
    for (int column = 0; column < 2; ++column)
        for (int row = 0; row < 2; ++row)
            hash = hashCombine(hash, bits(key.linear[column][row] + 0.0));  // -0 is 0
    return hash;
}

bool RepeatedPaths::append(Outlines& outlines, const std::shared_ptr<const scene::Path>& path,
                           const scene::Affine& toSteps, glm::dvec2 clampMin, glm::dvec2 clampMax) {
    if (path.use_count() <= fewPlaces)
        return false;
    const auto contours = contoursOf({path.get(), {toSteps[0], toSteps[1]}});
    return addContours(outlines, *contours, toSteps[2], clampMin, clampMax);
}

std::shared_ptr<const FlatContours> RepeatedPaths::contoursOf(const Key& key) {
    {
        const std::lock_guard lock(mutex_);
        if (const auto known = known_.find(key); known != known_.end())
            return known->second;
    }
    // Two threads may make the same, which costs time only.
    auto made = std::make_shared<const FlatContours>(
        flatten(*key.path, {key.linear[0], key.linear[1], {0, 0}}, tolerance_));
    const std::lock_guard lock(mutex_);
    if (points_ + made->points.size() <= mostKeptPoints && known_.emplace(key, made).second)
        points_ += made->points.size();
    return made;
}

}  // namespace vtm::compiler
