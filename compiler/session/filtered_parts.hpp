/// \file
/// Scenes with filters in, one after the other; out come their assets, at the cost of what changed in the
/// pictures between the filters.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>
#include "compiler/filters/compile_filtered.hpp"
#include "compiler/session/edited_picture.hpp"

namespace vtm::compiler {

/// A scene with filters, and what of it has none itself, part by part.
class FilteredParts {
public:
    /// Goes on to the next scene, which must be valid and have filters. Parts that stay the same are kept,
    /// and those that changed are edited. If it throws, the result stays, and the next scene is compiled
    /// anew.
    /// `paths`: of the scene, as far as they are gathered.
    void update(const scene::Scene& scene, std::vector<const scene::Path*> paths, const Options& options);

    const Result& result() const { return result_; }
    /// Whether a path was among those of the last scene, which is valid.
    bool knows(const scene::Path& path) const { return std::ranges::binary_search(paths_, &path); }
    /// What the last update changed.
    const Edited& report() const { return report_; }

private:
    struct Part {
        PlainPart from;
        EditedPicture picture;
        std::uint32_t firstMap = 0;  ///< in the result; a part's maps follow each other
    };
    /// What a part was in the scene before.
    struct Last {
        Part* part = nullptr;
        bool isSame = false;
    };

    static std::vector<Last> lastOf(const std::vector<PlainPart>& now, std::vector<Part>& before);
    static std::vector<Part> partsOf(FilterPlan& plan, const std::vector<Last>& last, const Excerpt& whole,
                                     const Options& options);
    static std::vector<asset::MapChange> changesOf(const Part& part, bool isSame);

    std::vector<Part> parts_;
    scene::Scene scene_;
    std::vector<const scene::Path*> paths_;  ///< of the scene, which holds them; ascending
    Result result_;
    asset::Asset spare_;  ///< empty, with the memory of the result before: for the next one
    Edited report_;
};

}  // namespace vtm::compiler
