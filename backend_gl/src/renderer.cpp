#include "backend_gl/renderer.hpp"

#include <algorithm>

#include "backend_gl/src/painter.hpp"
#include "backend_gl/src/picture.hpp"

namespace vtm::gl {

namespace {

/// Larger views are drawn in tiles of at most this side, 256 MiB of RGBA32F each.
constexpr int largestTile = 4096;

int tileSide() {
    GLint viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return std::min({largestTile, limit(GL_MAX_TEXTURE_SIZE), viewport[0], viewport[1]});
}

/// Calls visit(view of the tile, its min corner).
template <class Visit>
void forEachTile(const asset::View& view, int side, Visit&& visit) {
    for (int y = 0; y < view.height; y += side)
        for (int x = 0; x < view.width; x += side) {
            asset::View tile = view;
            tile.width = std::min(side, view.width - x);
            tile.height = std::min(side, view.height - y);
            tile.toPixels[2] -= glm::dvec2(x, y);
            visit(tile, glm::ivec2(x, y));
        }
}

void readBack(const Target& target, const asset::View& tile, glm::ivec2 corner, image::Raster& raster) {
    target.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, raster.width);
    glReadPixels(0, 0, tile.width, tile.height, GL_RGBA, GL_FLOAT, raster.pixel(corner.x, corner.y));
}

}  // namespace

struct Renderer::Impl {
    Workshop workshop;
    PictureBuffers picture;

    Target paint(UploadedAsset& asset, const asset::View& view) {
        if (asset.atlases.empty())
            return Painter(workshop, asset, view).paint();
        Target target = workshop.pool.take();
        target.bind();
        target.touched = {{0, 0}, {view.width, view.height}};
        glViewport(0, 0, view.width, view.height);
        for (const GLenum state :
             {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_DITHER, GL_BLEND})
            glDisable(state);
        drawPicture(workshop.programs, picture, asset, view);
        return target;
    }

    /// Calls use(target, tile, corner) for each painted tile.
    template <class Use>
    void paintTiles(UploadedAsset& asset, const asset::View& view, Use&& use) {
        asset::validate(view);
        if (!isInvertible(view))
            return;
        forEachTile(view, tileSide(), [&](const asset::View& tile, glm::ivec2 corner) {
            workshop.pool.resize({tile.width, tile.height});
            Target target = paint(asset, tile);
            use(target, tile, corner);
            workshop.pool.giveBack(std::move(target));
            checkErrors("drawing");
        });
    }
};

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

Texture Renderer::upload(const asset::AssetView& asset) {
    Programs& programs = impl_->workshop.programs;
    auto texture = std::make_unique<Texture::Impl>(asset, programs.materialSet(asset.materials));
    // Users' errors come at once, not with the first picture.
    if (texture->features.has(Features::Material))
        asset.mode == asset::Mode::Exact ? programs.patch(texture->features, texture->materialSet)
                                         : programs.fill(texture->features, texture->materialSet);
    return Texture(std::move(texture));
}

image::Raster Renderer::render(const Texture& texture, const asset::View& view) {
    asset::validate(view);
    image::Raster raster(view.width, view.height);
    impl_->paintTiles(*texture.impl_, view,
                      [&](const Target& target, const asset::View& tile, glm::ivec2 corner) {
                          readBack(target, tile, corner, raster);
                      });
    // Rounding leaves sums some 1e-7 outside.
    std::ranges::transform(raster.rgba, raster.rgba.begin(),
                           [](float v) { return std::clamp(v, 0.0f, 1.0f); });
    return raster;
}

void Renderer::draw(const Texture& texture, const asset::View& view) {
    impl_->paintTiles(*texture.impl_, view, [](const Target&, const asset::View&, glm::ivec2) {});
    glFinish();
}

}  // namespace vtm::gl
