#include "api/src/engines.hpp"

#include <dlfcn.h>

#include <vtm/error.hpp>
#include <vtm/raster/evaluate.hpp>
#include "api/gl_entry.hpp"
#include "raster/scan_rows.hpp"

/// Null unless the program itself is linked with libvtm_gl.
#pragma weak vtm_gl_draw

namespace vtm {

namespace {

using GlDraw = bool (*)(GlRequest&);

/// Beside libvtm, or where the loader looks. It stays loaded: drivers do not like to be unloaded.
GlDraw loadGlDraw() {
#ifdef VTM_GL_LIBRARY
    if (void* library = dlopen(VTM_GL_LIBRARY, RTLD_NOW | RTLD_LOCAL))
        return reinterpret_cast<GlDraw>(dlsym(library, "vtm_gl_draw"));
#endif
    return nullptr;
}

GlDraw findGlDraw() {
    static const GlDraw found = vtm_gl_draw ? &vtm_gl_draw : loadGlDraw();
    return found;
}

}  // namespace

CpuEngine::CpuEngine(const asset::Asset& asset) : asset_(asset) {
    if (asset::isSumOfMaps(asset))
        scanner_.emplace(asset);
}

void CpuEngine::draw(const asset::View& view, const image::PixelWriter& writer,
                     const image::RowSink& sink) const {
    if (scanner_)
        asset::scanRows(*scanner_, view, writer, sink);
    else
        image::giveRows(asset::evaluate(asset_, view), writer, sink);
}

std::optional<image::Raster> drawWithGl(const asset::Asset& asset, const asset::View& view, bool required) {
    const GlDraw draw = findGlDraw();
    if (!draw && required)
        throw Error("libvtm_gl, which draws with OpenGL ES, is not installed");
    GlRequest request{asset, view, required, {}};
    if (!draw || !draw(request))
        return std::nullopt;
    return std::move(request.drawn);
}

}  // namespace vtm
