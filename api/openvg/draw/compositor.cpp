#include "api/openvg/draw/compositor.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace vtm::openvg {

// ---- Clip -----------------------------------------------------------------------------------------

Clip::Clip(const Context& context) : bounds_(context.surface->bounds()) {
    if (!context.state.scissoring)
        return;
    Rectangle around{bounds_.x1, bounds_.y1, bounds_.x0, bounds_.y0};
    const std::vector<VGint>& r = context.state.scissorRects;
    for (std::size_t i = 0; i + 4 <= r.size(); i += 4) {
        if (r[i + 2] <= 0 || r[i + 3] <= 0)
            continue;
        const auto end = [](VGint start, VGint size) {
            return int(std::min(std::int64_t(start) + size, std::int64_t(maxSurfaceSide)));
        };
        const Rectangle box =
            Rectangle{r[i], r[i + 1], end(r[i], r[i + 2]), end(r[i + 1], r[i + 3])}.intersected(bounds_);
        if (box.empty())
            continue;
        rectangles_.push_back(box);
        around = {std::min(around.x0, box.x0), std::min(around.y0, box.y0), std::max(around.x1, box.x1),
                  std::max(around.y1, box.y1)};
    }
    isBox_ = rectangles_.size() <= 1;
    bounds_ = around;
}

const std::vector<std::pair<int, int>>& Clip::columns(int y) const {
    if (row_ == y)
        return columns_;
    row_ = y;
    columns_.clear();
    for (const Rectangle& r : rectangles_)
        if (r.y0 <= y && y < r.y1)
            columns_.emplace_back(r.x0, r.x1);
    std::ranges::sort(columns_);
    std::size_t kept = 0;
    for (const auto& part : columns_) {
        if (kept > 0 && part.first <= columns_[kept - 1].second)
            columns_[kept - 1].second = std::max(columns_[kept - 1].second, part.second);
        else
            columns_[kept++] = part;
    }
    columns_.resize(kept);
    return columns_;
}

// ---- Compositor -----------------------------------------------------------------------------------

Compositor::Compositor(Context& context, const PixelSource& source)
    : surface_(*context.surface),
      clip_(context),
      source_(source),
      blend_(blendOf(context.state.blendMode)),
      isOver_(context.state.blendMode == VG_BLEND_SRC_OVER),
      mixesLight_(!surface_.pixels().format().space.linear),
      transform_(context.state),
      space_(surface_.pixels().format().space) {
    const State& state = context.state;
    if (state.masking && surface_.mask)
        mask_ = &*surface_.mask;
    const PixelFormat& format = surface_.pixels().format();
    isAlphaOnly_ = format.red.bits == 0 && format.grey.bits == 0;
    mixesLight_ = mixesLight_ && !isAlphaOnly_;
    hasBytes_ = std::endian::native == std::endian::little && format.bits == 32 &&
                format.red == Channel{8, 0} && format.green == Channel{8, 8} &&
                format.blue == Channel{8, 16} && (format.alpha.bits == 0 || format.alpha == Channel{8, 24});
    if (const std::optional<Color> color = source.constant())
        use(*color);
}

void Compositor::use(Color color) {
    constant_ = prepared(color);
    drawsBytes_ = isOver_ && !mask_ && hasBytes_;
    if (!drawsBytes_)
        return;
    word_ = surface_.pixels().format().encode(*constant_);
    for (int c = 0; c < 3; ++c)
        light_[c] = gamma_.decode((*constant_)[c]);
}

Compositor::Compositor(Context& context, const PixelSource& paint, const PixelSource& stencil)
    : Compositor(context, paint) {
    stencil_ = &stencil;
    drawsBytes_ = false;
}

bool Compositor::isPrepared() const {
    const ColorSpace from = source_.space();
    return from.linear == space_.linear && from.luminance == space_.luminance && !transform_.isOn();
}

Color Compositor::prepared(Color color) const {
    if (isPrepared())
        return color;
    ColorSpace from = source_.space();
    color = unpremultiplied(color);
    if (transform_.isOn()) {
        color = transform_(color);
        from.luminance = false;  // what was grey may no longer be
    }
    // Alpha-only surfaces keep no colour to convert.
    if (!isAlphaOnly_)
        color = converted(color, from, space_);
    return premultiplied(color);
}

void Compositor::prepare(std::span<Color> colors) const {
    if (constant_) {
        std::ranges::fill(colors, *constant_);
        return;
    }
    if (isPrepared())
        return;
    for (Color& color : colors)
        color = prepared(color);
}

void Compositor::operator()(int y, std::span<const CoverageRun> runs) {
    for (const CoverageRun& run : runs)
        clip_.parts(y, run.first, run.end, [&](int first, int end) { drawPart(y, first, end, run.share); });
}

Color Compositor::mixed(Color before, Color after, float coverage) const {
    if (coverage == 1)
        return after;
    if (mixesLight_) {
        const auto linear = [](Color c) { return premultiplied(fastDecoded(unpremultiplied(c))); };
        const Color a = linear(before), b = linear(after);
        return premultiplied(fastEncoded(unpremultiplied(a + coverage * (b - a))));
    }
    return before + coverage * (after - before);
}

void Compositor::drawBytes(int y, int first, int end) {
    const Color added = *constant_;
    if (added.a == 1)
        return surface_.pixels().fill(first, end, y, word_);
    const float kept = 1 - added.a;
    const bool hasAlpha = surface_.pixels().format().alpha.bits != 0;
    const Color sum = added * 255.0f + 0.5f;
    std::uint8_t* p = surface_.pixels().at(first, y);
    for (int x = first; x < end; ++x, p += 4) {
        if (hasAlpha && !space_.premultiplied && p[3] != 255) {
            drawPixel(x, y, added, 1, nullptr);
            continue;
        }
        for (int c = 0; c < 3; ++c)
            p[c] = std::uint8_t(std::min(sum[c] + float(p[c]) * kept, 255.0f));
        if (hasAlpha && space_.premultiplied)
            p[3] = std::uint8_t(std::min(sum.a + float(p[3]) * kept, 255.0f));
    }
}

void Compositor::drawEdgeBytes(int y, int first, int end, float share) {
    const Color source = *constant_;
    const bool isOpaque = source.a == 1, hasAlpha = surface_.pixels().format().alpha.bits != 0;
    const float kept = (1 - source.a) / 255;
    std::uint8_t* p = surface_.pixels().at(first, y);
    for (int x = first; x < end; ++x, p += 4) {
        // What is translucent must be divided by its alpha to be mixed.
        if (hasAlpha && p[3] != 255) {
            drawPixel(x, y, source, share, nullptr);
            continue;
        }
        if (space_.linear) {
            for (int c = 0; c < 3; ++c)
                p[c] = std::uint8_t(float(p[c]) + share * (source[c] * 255 - source.a * float(p[c])) + 0.5f);
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            const float before = gamma_.decodedBytes[p[c]];
            const float after =
                isOpaque ? light_[c] : gamma_.decode(std::min(source[c] + float(p[c]) * kept, 1.0f));
            p[c] = gamma_.encode(before + share * (after - before));
        }
    }
}

void Compositor::drawPixel(int x, int y, Color source, float coverage, const Color* stencil) {
    Pixels& pixels = surface_.pixels();
    const PixelFormat& format = pixels.format();
    if (isOver_ && source.a == 1 && coverage == 1 && !stencil)
        return pixels.setWord(x, y, format.encode(source));
    Color before = format.decode(pixels.word(x, y));
    if (!space_.premultiplied)
        before = premultiplied(before);
    Color after;
    if (stencil) {
        // Premultiplied: each channel is image colour times image alpha. A grey surface has one channel to
        // let through: formula (3), of the stencil's numbers as they are.
        const Color s =
            space_.luminance ? Color(glm::vec3(luminance(glm::vec3(*stencil))), stencil->a) : *stencil;
        const Color alphas = s * source.a;
        after = blendChannels(blend_, Color(glm::vec3(unpremultiplied(source)) * glm::vec3(alphas), alphas.a),
                              alphas, before);
    } else {
        after = blend_(source, before);
    }
    const Color result = mixed(before, after, coverage);
    pixels.setWord(x, y, format.encode(space_.premultiplied ? result : unpremultiplied(result)));
}

void Compositor::drawPart(int y, int first, int end, float share) {
    if (drawsBytes_)
        return share == 1 ? drawBytes(y, first, end) : drawEdgeBytes(y, first, end, share);
    const std::uint8_t* mask = mask_ ? mask_->row(y) : nullptr;
    constexpr int chunk = 64;
    std::array<Color, chunk> colors, stencils;
    for (int start = first; start < end; start += chunk) {
        const auto count = std::size_t(std::min(chunk, end - start));
        const std::span<Color> part = std::span(colors).first(count);
        if (!constant_)
            source_.colors(start, y, part);
        prepare(part);
        if (stencil_)
            stencil_->colors(start, y, std::span(stencils).first(count));
        for (std::size_t i = 0; i < count; ++i) {
            const int x = start + int(i);
            const float coverage = mask ? share * (float(mask[x]) / 255) : share;
            if (coverage > 0)
                drawPixel(x, y, part[i], coverage, stencil_ ? &stencils[i] : nullptr);
        }
    }
}

}  // namespace vtm::openvg
