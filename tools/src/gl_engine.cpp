#include "tools/src/gl_engine.hpp"

#include "tools/src/color.hpp"

namespace vtm::tools {

void GlEngine::start(Stages& stages) {
    if (!gl_)
        gl_ = timed(stages, "start", [&] { return std::make_unique<Gl>(options_); });
}

image::Bitmap GlEngine::draw(Source& source, const asset::View& view, const scene::Color& ground) {
    start(source.stages);
    if (source.paper)
        return RasterEngine::draw(source, view, ground);
    const gl::Texture texture =
        timed(source.stages, "upload", [&] { return gl_->renderer.upload(*source.asset); });
    image::Bitmap bitmap =
        timed(source.stages, "render", [&] { return gl_->renderer.renderBitmap(texture, view); });
    layOver(bitmap, ground);
    return bitmap;
}

image::Raster GlEngine::render(Source& source, const asset::View& view) {
    const gl::PaperTexture texture =
        timed(source.stages, "upload", [&] { return gl::PaperTexture(source.paper->asset); });
    return timed(source.stages, "render", [&] { return gl_->paper.render(texture, view); });
}

}  // namespace vtm::tools
