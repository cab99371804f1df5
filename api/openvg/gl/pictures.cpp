// vtm/vg_gl.h: what surfaces show, for other contexts of OpenGL ES.

#include <vtm/vg_gl.h>

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/gl/context.hpp"
#include "api/openvg/gl/device.hpp"
#include "api/openvg/gl/layer_blocks.hpp"
#include "api/openvg/gl/texture_copy.hpp"

using namespace vtm::openvg;

namespace {

/// A texture of the surface's size; null where there is no room for it.
const std::shared_ptr<const gl::Texture>& pictureOf(Surface& surface, gl::Device& device) {
    auto& picture = surface.picture;
    if (!picture || picture->width() != surface.width() || picture->height() != surface.height())
        picture = device.makeTexture(GL_RGBA8, surface.width(), surface.height());
    return picture;
}

/// All pixels of a surface, as bytes.
gl::Draw copyingDraw(const Surface& surface, gl::TexturePointer from, gl::TexturePointer to) {
    gl::Draw draw;
    draw.key.task = gl::ProgramKey::Task::copy;
    draw.texels[0] = std::move(from);
    draw.target = std::move(to);
    gl::setSurface(draw.block, bytesFormat(), surface.width(), surface.height());
    gl::setCopied(draw.block, surface.pixels().format(), {0, 0});
    return draw;
}

}  // namespace

void vtmPreferGlDisplay(void* display) { gl::preferDisplay(display); }

VGboolean vtmGetGlContext(VtmGlContext* context) {
    if (!glCompositor())
        return VG_FALSE;
    const vtm::gles_context::Context& its = gl::Device::open()->context();
    *context = {its.display, its.handle, its.attributes};
    return VG_TRUE;
}

VGboolean vtmTakeGlPicture(VtmSurface* surface, VtmGlPicture* result) try {
    if (surface->compositor == &cpuCompositor() || !glCompositor())
        return VG_FALSE;
    gl::Device& device = *gl::Device::open();
    const gl::TexturePointer pixels = gl::readTexture(device, surface->pixels());
    const gl::TexturePointer picture = pixels ? pictureOf(*surface, device) : nullptr;
    if (!picture)
        return VG_FALSE;
    device.draw(copyingDraw(*surface, pixels, picture), gl::oneTile(surface->bounds()));
    result->texture = picture->name();
    result->ready = device.fence();
    return VGboolean(result->ready != nullptr);
} catch (const std::bad_alloc&) {
    return VG_FALSE;
}

void vtmReturnGlPicture(void* fence) {
    if (fence && glCompositor())
        gl::Device::open()->waitFor(static_cast<GLsync>(fence));
}
