/// \file
/// Coverage and colours to pixels: stages 5 and 8 of the pipeline (specification sections 2.5, 2.8 and 13).
#pragma once

#include <span>
#include <vector>

#include "api/openvg/draw/blend.hpp"
#include "api/openvg/draw/path_mask.hpp"
#include "api/openvg/draw/pixel_source.hpp"
#include "api/openvg/paint/paint_color.hpp"
#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

/// The part of a surface that drawing may change: its bounds, cut by the scissoring rectangles (section 7.1).
class Clip {
public:
    explicit Clip(const Context& context);

    /// A box around it.
    const Rectangle& bounds() const { return bounds_; }
    /// Calls part(first, end) for the columns from `first` to `end` of a row that are in it, each once.
    template <class Part>
    void parts(int y, int first, int end, Part&& part) const;

private:
    const std::vector<std::pair<int, int>>& columns(int y) const;

    Rectangle bounds_;
    bool isBox_ = true;
    std::vector<Rectangle> rectangles_;
    mutable int row_ = -1;
    mutable std::vector<std::pair<int, int>> columns_;  ///< of row_, disjoint
};

/// For one drawing call with the context's current state; takes covered rows.
class Compositor {
public:
    Compositor(Context& context, const PixelSource& source);
    /// VG_DRAW_IMAGE_STENCIL: the paint through the image (section 10.8).
    Compositor(Context& context, const PixelSource& paint, const PixelSource& stencil);

    const Clip& clip() const { return clip_; }
    /// The one colour of what comes next, in place of the source's: in its space, premultiplied.
    void use(Color color);
    void operator()(int y, std::span<const CoverageRun> runs);

private:
    void drawPart(int y, int first, int end, float share);
    /// What was there, and what would be if the drawing covered all of the pixel, mixed by coverage
    /// (section 2.8).
    Color mixed(Color before, Color after, float coverage) const;
    /// One colour over bytes: all of a pixel, or part of it.
    void drawBytes(int y, int first, int end);
    void drawEdgeBytes(int y, int first, int end, float share);
    /// Any pixel, of any format.
    void drawPixel(int x, int y, Color source, float coverage, const Color* stencil);
    /// Colours of the source as they are blended: transformed, in the surface's space, premultiplied.
    void prepare(std::span<Color> colors) const;
    Color prepared(Color color) const;
    /// The source's colours need nothing of that.
    bool isPrepared() const;

    Surface& surface_;
    Clip clip_;
    const PixelSource& source_;
    const PixelSource* stencil_ = nullptr;
    Blend blend_;
    bool isOver_;
    bool mixesLight_;                   ///< edges are mixed in linear light, though the surface is not linear
    const MaskValues* mask_ = nullptr;  ///< null: no masking
    ScaleAndBias transform_;
    ColorSpace space_;  ///< the surface's
    bool isAlphaOnly_;
    bool hasBytes_;                  ///< red, green, blue, alpha bytes, or padding for alpha
    std::optional<Color> constant_;  ///< prepared
    bool drawsBytes_ = false;        ///< `constant_` over bytes by a rule that drawBytes() knows
    std::uint32_t word_ = 0;         ///< `constant_` as a pixel
    glm::vec3 light_{0};             ///< `constant_` in linear light
    const ByteGamma& gamma_ = byteGamma();
};

template <class Part>
void Clip::parts(int y, int first, int end, Part&& part) const {
    if (y < bounds_.y0 || y >= bounds_.y1)
        return;
    first = std::max(first, bounds_.x0);
    end = std::min(end, bounds_.x1);
    if (first >= end)
        return;
    if (isBox_)
        return part(first, end);
    for (const auto& [a, b] : columns(y))
        if (std::max(first, a) < std::min(end, b))
            part(std::max(first, a), std::min(end, b));
}

}  // namespace vtm::openvg
