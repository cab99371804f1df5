// Section 11: fonts and glyphs.

#include "api/openvg/draw/draw_path.hpp"
#include "api/openvg/image/images.hpp"

using namespace vtm::openvg;

namespace {

glm::vec2 pair(const VGfloat* v) {
    require(v != nullptr && isAligned(v));
    return {v[0], v[1]};
}

void requireGlyphModes(VGbitfield modes) {
    require((modes & ~VGbitfield(VG_FILL_PATH | VG_STROKE_PATH)) == 0);
}

const Glyph& glyphOf(const Font& font, VGuint index) {
    const auto it = font.glyphs.find(index);
    require(it != font.glyphs.end());
    return it->second;
}

/// Draws a glyph with its origin at VG_GLYPH_ORIGIN and moves on. Paint moves with the glyph, as programs
/// expect it: its coordinates are those of the glyph's path.
void draw(Context& context, const Glyph& glyph, VGbitfield modes, glm::vec2 adjustment) {
    std::array<VGfloat, 2>& origin = context.state.glyphOrigin;
    if (modes != 0) {
        glm::mat3 toSurface = context.state.matrix(VG_MATRIX_GLYPH_USER_TO_SURFACE);
        toSurface[2] +=
            toSurface[0] * (origin[0] - glyph.origin.x) + toSurface[1] * (origin[1] - glyph.origin.y);
        if (glyph.path)
            drawPath(context, *glyph.path, modes, toSurface, &context.objects->glyphs);
        else if (glyph.image)
            drawImage(context, *glyph.image, toSurface, VG_MATRIX_GLYPH_USER_TO_SURFACE);
    }
    origin[0] += glyph.escapement.x + adjustment.x;
    origin[1] += glyph.escapement.y + adjustment.y;
}

}  // namespace

VGFont vgCreateFont(VGint glyphCapacityHint) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        require(glyphCapacityHint >= 0);
        return context.objects->add(std::make_shared<Font>());
    });
}

void vgDestroyFont(VGFont font) {
    call([&](Context& context) { context.objects->destroy<Font>(font); });
}

void vgSetGlyphToPath(VGFont font, VGuint glyphIndex, VGPath path, VGboolean, const VGfloat glyphOrigin[2],
                      const VGfloat escapement[2]) {
    call([&](Context& context) {
        const std::shared_ptr<Font> target = context.objects->get<Font>(font);
        Glyph glyph;
        if (path != VG_INVALID_HANDLE)
            glyph.path = context.objects->get<Path>(path);
        glyph.origin = pair(glyphOrigin);
        glyph.escapement = pair(escapement);
        target->glyphs[glyphIndex] = std::move(glyph);
    });
}

void vgSetGlyphToImage(VGFont font, VGuint glyphIndex, VGImage image, const VGfloat glyphOrigin[2],
                       const VGfloat escapement[2]) {
    call([&](Context& context) {
        const std::shared_ptr<Font> target = context.objects->get<Font>(font);
        Glyph glyph;
        if (image != VG_INVALID_HANDLE)
            glyph.image = UsedImage(freeImage(context, image));
        glyph.origin = pair(glyphOrigin);
        glyph.escapement = pair(escapement);
        target->glyphs[glyphIndex] = std::move(glyph);
    });
}

void vgClearGlyph(VGFont font, VGuint glyphIndex) {
    call([&](Context& context) { require(context.objects->get<Font>(font)->glyphs.erase(glyphIndex) == 1); });
}

void vgDrawGlyph(VGFont handle, VGuint glyphIndex, VGbitfield paintModes, VGboolean) {
    call([&](Context& context) {
        const std::shared_ptr<Font> font = context.objects->get<Font>(handle);
        const Glyph& glyph = glyphOf(*font, glyphIndex);
        requireGlyphModes(paintModes);
        draw(context, glyph, paintModes, glm::vec2(0));
    });
}

void vgDrawGlyphs(VGFont handle, VGint glyphCount, const VGuint* glyphIndices, const VGfloat* adjustments_x,
                  const VGfloat* adjustments_y, VGbitfield paintModes, VGboolean) {
    call([&](Context& context) {
        const std::shared_ptr<Font> font = context.objects->get<Font>(handle);
        require(glyphCount > 0 && glyphIndices != nullptr && isAligned(glyphIndices));
        require(isAligned(adjustments_x) && isAligned(adjustments_y));
        requireGlyphModes(paintModes);
        for (VGint i = 0; i < glyphCount; ++i)
            glyphOf(*font, glyphIndices[i]);
        for (VGint i = 0; i < glyphCount; ++i)
            draw(context, glyphOf(*font, glyphIndices[i]), paintModes,
                 {adjustments_x ? adjustments_x[i] : 0, adjustments_y ? adjustments_y[i] : 0});
    });
}
