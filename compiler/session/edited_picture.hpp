/// \file
/// Scenes without filters in, one after the other; out come their assets, at the cost of what changed.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include "compiler/session/editor.hpp"

namespace vtm::compiler {

/// An excerpt of a scene, which must be valid and have no filters.
class EditedPicture {
public:
    /// As compile() of the excerpt; nothing is kept that only edits need.
    void compile(const scene::Scene& scene, const Excerpt& excerpt, const Options& options);
    /// Goes on to the next scene, with options that follow from the excerpt. If most of it is new, as
    /// compile(). Else what is kept is brought to it; if there is nothing, or the excerpt is another one, it
    /// is made. If this throws, the result stays.
    void update(const scene::Scene& scene, const Excerpt& excerpt, const Options& options);

    /// Stays as it is: its stages take no time.
    void keep() {
        for (StageTime& stage : result_.stages)
            stage.milliseconds = 0;
    }

    const Result& result() const { return result_; }
    /// What the last of these changed.
    const Edited& report() const { return report_; }
    /// Whether the path was in the last scene, as far as that is kept.
    bool knows(const scene::Path& path) const { return kept_ && kept_->cache.knows(path); }

private:
    bool isMostlyNew(const scene::Scene& scene) const;
    bool tryEdit(std::unique_ptr<Kept>& kept, const scene::Scene& scene, const Excerpt& excerpt,
                 const Options& options);

    std::unique_ptr<Kept> kept_;
    Result result_;
    Edited report_;
    std::vector<std::uint64_t>
        compiled_;  ///< sorted keys of the scene, if it was compiled without what is kept
};

}  // namespace vtm::compiler
