/// \file
/// Scenes with filters in, one after the other; out come results, of which pictures between filters that stay
/// the same are compiled once.
#pragma once

#include <cstddef>
#include <unordered_map>

#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// What of a scene with filters has none itself, by what it was made from.
class FilteredParts {
public:
    /// As compile() of this scene, which must be valid and have filters; only parts that the scene before did
    /// not have are compiled.
    Result compile(const scene::Scene& scene, const Options& options);
    /// So many were compiled last, of so many.
    std::size_t compiled() const { return compiled_; }
    std::size_t size() const { return parts_.size(); }

private:
    struct Part {
        scene::NodeList nodes;
        Excerpt excerpt;
        double tolerance;
        Result result;
    };
    using Parts = std::unordered_multimap<std::size_t, Part>;

    static std::size_t keyOf(const scene::NodeList& nodes);

    Parts parts_;  ///< by key
    std::size_t compiled_ = 0;
};

}  // namespace vtm::compiler
