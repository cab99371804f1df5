/// \file
/// Fills of one path in many places, such as a letter's: cut into chords once for all places that differ by a
/// translation.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <unordered_map>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {

/// Several threads may use it at once; what they get does not depend on who asked first.
class RepeatedPaths {
public:
    explicit RepeatedPaths(ChordTolerance tolerance) : tolerance_(tolerance) {}

    /// Appends an outline, as addOutline() does. Nothing, and returns false, if the path is not in several
    /// places or lies beyond the box in this one.
    bool append(Outlines& outlines, const std::shared_ptr<const scene::Path>& path,
                const scene::Affine& toSteps, glm::dvec2 clampMin, glm::dvec2 clampMax);

private:
    /// A path that stays where it is as long as this lives, and the matrix that leads to steps but for the
    /// translation.
    struct Key {
        const scene::Path* path;
        glm::dmat2 linear;

        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const;
    };

    std::shared_ptr<const FlatContours> contoursOf(const Key& key);

    const ChordTolerance tolerance_;
    std::mutex mutex_;
    std::unordered_map<Key, std::shared_ptr<const FlatContours>, Hash> known_;
    std::size_t points_ = 0;  ///< of what is known
};

}  // namespace vtm::compiler
