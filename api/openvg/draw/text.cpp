// Section 11: fonts and glyphs.

#include "api/openvg/draw/clip.hpp"
#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/draw/draw_path.hpp"
#include "api/openvg/image/images.hpp"
#include "api/openvg/path/projective.hpp"
#include "api/openvg/state/matrix.hpp"

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

/// Draws glyphs one after the other. Those whose coverage is kept, and that are filled or stroked in one
/// colour, are drawn together.
class GlyphDrawing {
public:
    GlyphDrawing(Context& context, VGbitfield modes)
        : context_(context),
          state_(context.state),
          modes_(modes),
          matrix_(state_.matrix(VG_MATRIX_GLYPH_USER_TO_SURFACE)),
          toSurface_(matrix_),
          clip_(context) {
        if (modes == VG_FILL_PATH || modes == VG_STROKE_PATH)
            setColor(VGPaintMode(modes));
    }

    /// At VG_GLYPH_ORIGIN, and moves on. Paint moves with the glyph, as programs expect it: its coordinates
    /// are those of the glyph's path.
    void draw(const Glyph& glyph, glm::vec2 adjustment) {
        std::array<VGfloat, 2>& origin = context_.state.glyphOrigin;
        if (modes_ != 0) {
            const VGfloat x = origin[0] - glyph.origin.x, y = origin[1] - glyph.origin.y;
            for (int i = 0; i < 3; ++i)
                toSurface_[2][i] = matrix_[2][i] + (matrix_[0][i] * x + matrix_[1][i] * y);
            draw(glyph, toSurface_);
        }
        origin[0] += glyph.escapement.x + adjustment.x;
        origin[1] += glyph.escapement.y + adjustment.y;
    }

    /// Draws what is still to be drawn.
    void finish() {
        if (!placed_.empty())
            compositorOf(context_).drawGlyphs(context_, *color_, placed_);
        placed_.clear();
        context_.objects->glyphs.trim();
    }

private:
    void setColor(VGPaintMode mode) {
        if (context_.recorder || state_.renderingQuality == VG_RENDERING_QUALITY_NONANTIALIASED ||
            !clipLines(state_).empty() || isProjective(matrix_) || !inverseOf(matrix_) ||
            (mode == VG_STROKE_PATH && !hasStroke(state_)))
            return;
        color_ = paintSource(currentPaint(state_, mode), matrix_, state_);
        if (color_ && !color_->constant())
            color_ = nullptr;
    }

    void draw(const Glyph& glyph, const glm::mat3& toSurface) {
        if (glyph.path && color_ && place(*glyph.path, toSurface))
            return;
        finish();
        if (glyph.path)
            drawPath(context_, *glyph.path, modes_, toSurface, &context_.objects->glyphs);
        else if (glyph.image)
            drawImage(context_, *glyph.image, toSurface, VG_MATRIX_GLYPH_USER_TO_SURFACE);
    }

    /// False for what is not kept.
    bool place(Path& path, const glm::mat3& toSurface) {
        constexpr std::size_t maxPlaced = 256;  // nothing is forgotten meanwhile
        if (path.data.commands().empty())
            return true;
        PathMask& mask = maskOf(state_, path, VGPaintMode(modes_));
        if (!context_.objects->glyphs.place(mask, toSurface, clip_.bounds(), placed_))
            return false;
        if (placed_.size() == maxPlaced)
            finish();
        return true;
    }

    Context& context_;
    const State& state_;
    const VGbitfield modes_;
    const glm::mat3 matrix_;
    glm::mat3 toSurface_;  ///< the glyph's
    const Clip clip_;
    std::unique_ptr<PixelSource> color_;  ///< null: each glyph is drawn by itself
    std::vector<PlacedGlyph> placed_;
};

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
        GlyphDrawing drawing(context, paintModes);
        drawing.draw(glyph, glm::vec2(0));
        drawing.finish();
    });
}

void vgDrawGlyphs(VGFont handle, VGint glyphCount, const VGuint* glyphIndices, const VGfloat* adjustments_x,
                  const VGfloat* adjustments_y, VGbitfield paintModes, VGboolean) {
    call([&](Context& context) {
        const std::shared_ptr<Font> font = context.objects->get<Font>(handle);
        require(glyphCount > 0 && glyphIndices != nullptr && isAligned(glyphIndices));
        require(isAligned(adjustments_x) && isAligned(adjustments_y));
        requireGlyphModes(paintModes);
        std::vector<const Glyph*> glyphs;
        for (const VGuint index : std::span(glyphIndices, std::size_t(glyphCount)))
            glyphs.push_back(&glyphOf(*font, index));
        GlyphDrawing drawing(context, paintModes);
        for (std::size_t i = 0; i < glyphs.size(); ++i)
            drawing.draw(*glyphs[i],
                         {adjustments_x ? adjustments_x[i] : 0, adjustments_y ? adjustments_y[i] : 0});
        drawing.finish();
    });
}
