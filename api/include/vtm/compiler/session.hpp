/// \file
/// A picture that is edited: after each change only what it concerns is compiled again.
#pragma once

#include <cstddef>
#include <memory>

#include <vtm/compiler/compile.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

/// What an update did.
struct Update {
    bool anew = false;            ///< all was compiled from nothing
    std::size_t outlines = 0;     ///< made: flattened, stroked
    std::size_t blocks = 0;       ///< squares of the picture that were built
    std::size_t blocksInAll = 0;  ///< into which the picture is divided
    std::size_t paints = 0;       ///< composited
};

/// Keeps what compiling a scene found, so that the next scene, which differs in little, costs little
/// (docs/session.md). Scenes are values: an edited scene shares its unchanged paths with the one before, and
/// a path or bitmap is known again by its pointer, so it must not be changed in place. Everything else is
/// compared by value.
///
/// The result draws what `compile` of the same scene draws; it is larger by the boundaries between regions
/// that have the same colour now and may have different ones later. In compat mode every update compiles
/// anew. Not for use by several threads at once; it uses all processors itself.
class Session {
public:
    /// Throws what `compile` throws.
    explicit Session(const scene::Scene& scene, const Options& options = {});
    ~Session();
    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;

    /// Valid until the next update. Its asset has no prefilter.
    const Result& result() const;
    /// Of the last `update` that did not throw, or the constructor.
    const Update& lastUpdate() const;

    /// Compiles `scene` in place of the last. If it throws, what `compile` throws, the result stays as it was
    /// and the next update may compile anew.
    const Result& update(const scene::Scene& scene);

private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace vtm::compiler

#pragma GCC visibility pop
