#include "tools/engines/gl_engine.hpp"

namespace vtm::tools {

void GlEngine::start(Stages& stages) {
    if (!gl_)
        gl_ = timed(stages, "start", [&] { return std::make_unique<Gl>(options_); });
}

void GlEngine::draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                    const image::RowSink& sink) {
    start(source.stages);
    if (source.paper || writer.depth() > 8)
        return RasterEngine::draw(source, view, writer, sink);
    const gl::Texture texture =
        timed(source.stages, "upload", [&] { return gl_->renderer.upload(*source.asset); });
    const image::Bitmap bitmap =
        timed(source.stages, "render", [&] { return gl_->renderer.renderBitmap(texture, view); });
    image::giveRows(bitmap, writer, sink);
}

image::Raster GlEngine::render(Source& source, const asset::View& view) {
    if (source.paper) {
        const paper::Texture texture =
            timed(source.stages, "upload", [&] { return paper::Texture(source.paper->asset); });
        return timed(source.stages, "render", [&] { return gl_->paper.render(texture, view); });
    }
    const gl::Texture texture =
        timed(source.stages, "upload", [&] { return gl_->renderer.upload(*source.asset); });
    return timed(source.stages, "render", [&] { return gl_->renderer.render(texture, view); });
}

}  // namespace vtm::tools
