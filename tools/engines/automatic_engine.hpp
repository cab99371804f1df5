/// \file
/// The engine that is fast on this machine, for each picture.
#pragma once

#include <optional>

#include "tools/engines/gl_engine.hpp"

namespace vtm::tools {

/// The shaders where there is a GPU. Else the scanner for all that it can draw (exact pictures without
/// materials), and for the rest the shaders on the CPU, or where there is no EGL their twin.
///
/// Whether there is a GPU is asked once, at the first picture, and a context is made only if one may be there
/// or shaders are needed.
class AutomaticEngine : public Engine {
public:
    AutomaticEngine(asset::Mode mode, const std::string& programCache);
    std::string name() const override { return drawing_->name(); }
    void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) override;

private:
    Engine& engineFor(Source& source);
    /// Looks for EGL's devices at the first call.
    gl::Driver driver(Source& source);
    /// Whether there is a context, which is made; says so where there is none.
    bool startsGl(Source& source);
    void doWithoutGl(const std::string& why);

    std::optional<gl::Driver> driver_;
    GlEngine gl_;
    std::unique_ptr<Engine> scanner_, twin_;
    Engine* drawing_;
};

}  // namespace vtm::tools
