/// \file
/// Incremental compilation of a picture that is edited: an update recompiles only the parts that a change
/// affects.
#pragma once

#include <cstddef>
#include <memory>

#include <vtm/asset/difference.hpp>
#include <vtm/compiler/compile.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

/// The work that an update did. Where most of a scene was new, it was compiled as compile() does; then
/// nothing is counted.
struct Update {
    bool anew = false;         ///< everything was compiled from scratch
    std::size_t outlines = 0;  ///< outlines flattened or stroked
    std::size_t blocks = 0;  ///< squares of the picture that were rebuilt; of filters, pictures between them
    std::size_t blocksInAll = 0;  ///< of those that the picture is divided into
    std::size_t paints = 0;       ///< paints composited
};

/// Keeps the intermediate results of a compilation, so that a scene with few changes compiles quickly
/// (docs/session.md). Scenes are values: an edited scene shares its unchanged paths with the previous one. A
/// path or bitmap is recognised by its pointer, so it must not be modified in place. Everything else is
/// compared by value.
///
/// The result draws the same picture as `compile` of the same scene. It is larger, because it keeps
/// boundaries between regions whose colours are equal now and may differ later. In compat mode every update
/// compiles from scratch. A session must not be used by several threads at once; it uses all processors
/// itself.
class Session {
public:
    /// Compiles the scene. Throws as `compile` does.
    explicit Session(const scene::Scene& scene, const Options& options = {});
    ~Session();
    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;

    /// The current result, valid until the next update. Its asset has no prefilter.
    const Result& result() const;
    /// The work done by the last `update` that did not throw, or by the constructor.
    const Update& lastUpdate() const;

    /// What the last such update changed of the asset: what was made of the one before need not be made anew
    /// (asset::Scanner::update), and what is outside its areas need not be drawn again.
    const asset::Difference& difference() const;

    /// Compiles `scene`, which replaces the previous one. Throws as `compile` does; the result then stays as
    /// it was, and the next update may compile from scratch.
    const Result& update(const scene::Scene& scene);

private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace vtm::compiler

#pragma GCC visibility pop
