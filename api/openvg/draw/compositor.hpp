/// \file
/// What changes pixels of drawing surfaces and images, on the CPU or on a GPU. Arguments are legal and areas
/// within the surface by then; scissoring, masking, blending and colours are those of the context's state.
#pragma once

#include <functional>

#include "api/openvg/draw/path_mask.hpp"
#include "api/openvg/draw/pixel_source.hpp"
#include "api/openvg/image/image_filter.hpp"
#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

/// What a drawing call is coloured by: a source, or with VG_DRAW_IMAGE_STENCIL a paint through an image
/// (section 10.8).
struct Layer {
    const PixelSource& source;
    const PixelSource* stencil = nullptr;
};

/// Gives the rows that a drawing call covers within a rectangle, each at most once.
using Coverage = std::function<void(const Rectangle& clip, const RowSink& row)>;

class Compositor {
public:
    virtual ~Compositor() = default;

    /// Stages 5 and 8 of the pipeline (sections 2.5, 2.8 and 13).
    virtual void draw(Context& context, const Layer& layer, const Coverage& coverage) = 0;
    /// Glyphs one after the other, in one colour.
    virtual void drawGlyphs(Context& context, const PixelSource& color, std::span<const PlacedGlyph> glyphs) {
        for (const PlacedGlyph& glyph : glyphs)
            draw(context, {color}, [&](const Rectangle& clip, const RowSink& row) { glyph.play(clip, row); });
    }
    /// vgClear: a pixel's word everywhere.
    virtual void clear(Context& context, const CopyArea& area, std::uint32_t word) = 0;
    /// vgSetPixels and vgWritePixels: from an image, or from a program's memory.
    virtual void setPixels(Context& context, const Image& from, const CopyArea& area) = 0;
    virtual void writePixels(Context& context, const MemoryPixels& from, const CopyArea& area) = 0;
    /// vgGetPixels and vgReadPixels.
    virtual void getPixels(Context& context, Image& to, const CopyArea& area) = 0;
    virtual void readPixels(Context& context, const MemoryPixels& to, const CopyArea& area) = 0;
    /// vgCopyPixels. The two parts may overlap.
    virtual void copyPixels(Context& context, const CopyArea& area) = 0;
    /// vgClearImage, vgCopyImage, vgImageSubData, vgGetImageSubData and filters, of images whose pixels are
    /// not in memory. False for what is to be done there.
    virtual bool clearImage(Image&, const CopyArea&, std::uint32_t) { return false; }
    virtual bool copyImage(Image&, const Image&, const CopyArea&) { return false; }
    virtual bool writeImage(Image&, const MemoryPixels&, const CopyArea&) { return false; }
    virtual bool readImage(const Image&, const MemoryPixels&, const CopyArea&) { return false; }
    virtual bool filterImage(Image&, const Image&, const ImageFilter&) { return false; }
    /// vgFlush and vgFinish: begins, or ends, what was asked for.
    virtual void flush() = 0;
    virtual void finish() = 0;
};

/// Everything in memory.
Compositor& cpuCompositor();

/// Pixels in textures, drawn by shaders; what these cannot do, the other one does with the pixels brought
/// back. Null where there is no OpenGL ES 3, and compositorFault() says why.
Compositor* glCompositor();
const char* compositorFault();

/// By what a program wants. Where that is VTM_COMPOSITOR_AUTOMATIC, the variable VTM_OPENVG_COMPOSITOR
/// decides, or else whether there is a GPU.
Compositor& chosenCompositor(VtmCompositor wanted);

/// That of the context's surface.
inline Compositor& compositorOf(const Context& context) { return *context.surface->compositor; }

}  // namespace vtm::openvg
