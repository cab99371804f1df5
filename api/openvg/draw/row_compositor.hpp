/// \file
/// Coverage and colours to pixels: stages 5 and 8 of the pipeline (specification sections 2.5, 2.8 and 13).
#pragma once

#include <span>

#include "api/openvg/draw/blend.hpp"
#include "api/openvg/draw/clip.hpp"
#include "api/openvg/draw/edge_mixer.hpp"
#include "api/openvg/draw/glyph_cache.hpp"
#include "api/openvg/draw/path_mask.hpp"
#include "api/openvg/draw/pixel_source.hpp"
#include "api/openvg/image/pixel_rows.hpp"
#include "api/openvg/paint/paint_color.hpp"

namespace vtm::openvg {

/// A source's colours as they are blended into pixels of a format: transformed, in the format's space,
/// premultiplied.
void prepareColors(std::span<Color> colors, ColorSpace from, const ScaleAndBias& transform,
                   const PixelFormat& to);

/// Rows into pixels in memory: for one drawing call with the context's current state.
class RowCompositor {
public:
    RowCompositor(Context& context, const PixelSource& source);
    /// VG_DRAW_IMAGE_STENCIL: the paint through the image (section 10.8).
    RowCompositor(Context& context, const PixelSource& paint, const PixelSource& stencil);

    const Clip& clip() const { return clip_; }
    /// The one colour of what comes next, in place of the source's: in its space, premultiplied.
    void use(Color color);
    void operator()(int y, std::span<const CoverageRun> runs);
    void draw(std::span<const PlacedGlyph> glyphs);

private:
    /// Where drawsBytes_, all of each pixel only.
    void drawPart(int y, int first, int end, float share);
    /// One colour over bytes, all of each pixel. False for what drawRow() must do.
    bool drawBytes(int y, int first, int end);
    /// A pixel of bytes that no mixer takes.
    void drawEdge(int x, int y, unsigned share);
    template <class Mixer>
    void drawGlyphBytes(GlyphCoverage& coverage, int left, int bottom, const Mixer& mixed);
    /// Calls f with what mixes the one colour into a pixel of bytes by its share; f(p, share) returns false
    /// for a pixel that drawEdge() must mix.
    template <class Function>
    void withMixer(Function&& f) const;
    /// Pixels of an image that go into the surface as they are stored. False for what drawRow() must do.
    bool drawStored(int y, int first, int end);
    enum class Stored { no, copied, copiedIfOpaque, over };
    Stored storedRule() const;
    void drawAny(int y, int first, int end, float share);
    /// No more than rowChunk pixels, of any format, each covered by its share.
    void drawRow(int x, int y, std::span<const float> coverage);
    /// What the source gives, as it is blended: transformed, in the surface's space, premultiplied.
    void sourceRow(int x, int y, std::span<Color> colors) const;
    /// The destination replaced by what would be if the drawing covered all of each pixel.
    void blendRow(int x, int y, std::span<const Color> source, std::span<Color> destination) const;
    /// What was there and what would be, mixed by coverage (section 2.8).
    void mixRow(std::span<const Color> before, std::span<const float> coverage, std::span<Color> after) const;
    void prepare(std::span<Color> colors) const {
        prepareColors(colors, source_.space(), transform_, format_);
    }

    Pixels& pixels_;  ///< the surface's
    Clip clip_;
    const PixelSource& source_;
    const PixelSource* stencil_ = nullptr;
    BlendMode blend_;
    bool isOver_, isSource_;            ///< VG_BLEND_SRC_OVER, VG_BLEND_SRC
    bool mixesLight_;                   ///< edges are mixed in linear light, though the surface is not linear
    const MaskValues* mask_ = nullptr;  ///< null: no masking
    ScaleAndBias transform_;
    const PixelFormat& format_;  ///< the surface's
    bool isAlphaOnly_;
    std::optional<ByteOrder> order_;         ///< the surface's
    Stored stored_ = Stored::no;             ///< how pixels of an image are drawn as they are stored
    std::optional<RowConverter> converter_;  ///< of these, once one was converted
    std::optional<Color> constant_;          ///< prepared
    bool drawsBytes_ = false;                ///< `constant_` over bytes by a rule that drawBytes() knows
    std::uint32_t word_ = 0;                 ///< `constant_` as a pixel
    EdgeColor edgeColor_;                    ///< `constant_` for edges
};

}  // namespace vtm::openvg
