/// \file
/// Drawing with the shaders.
#pragma once

#include <vtm/gl/renderer.hpp>
#include "paper/gl/renderer.hpp"
#include "tools/engines/engine.hpp"

namespace vtm::tools {

class GlEngine : public RasterEngine {
public:
    explicit GlEngine(const std::string& programCache) { options_.programCache = programCache; }
    std::string name() const override { return "gl"; }
    void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) override;

    /// Makes the context and the renderers, once. Throws gl::GlError.
    void start(Stages& stages);
    /// After start(): whether the shaders run on the CPU.
    bool isSoftware() const { return gl_->context.isSoftware(); }

protected:
    /// Paper mode, and more than 8 bits.
    image::Raster render(Source& source, const asset::View& view) override;

private:
    /// The context comes first: the programs need it for their whole life.
    struct Gl {
        explicit Gl(const gl::RendererOptions& options) : renderer(options) {}

        gl::Context context;
        gl::Renderer renderer;
        paper::Renderer paper;
    };
    gl::RendererOptions options_;
    std::unique_ptr<Gl> gl_;
};

}  // namespace vtm::tools
