#include "api/openvg/src/compositor.hpp"

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
      transforms_(context.state.colorTransform),
      space_(surface_.pixels().format().space) {
    const State& state = context.state;
    if (state.masking && surface_.mask)
        mask_ = &*surface_.mask;
    for (int c = 0; c < 4; ++c) {
        scale_[c] = std::clamp(state.colorTransformValues[std::size_t(c)], -127.0f, 127.0f);
        bias_[c] = std::clamp(state.colorTransformValues[std::size_t(4 + c)], -1.0f, 1.0f);
    }
    const PixelFormat& format = surface_.pixels().format();
    isAlphaOnly_ = format.red.bits == 0 && format.grey.bits == 0;
    mixesLight_ = mixesLight_ && !isAlphaOnly_;
    hasBytes_ = std::endian::native == std::endian::little && format.bits == 32 &&
                format.red == Channel{8, 0} && format.green == Channel{8, 8} &&
                format.blue == Channel{8, 16} && (format.alpha.bits == 0 || format.alpha == Channel{8, 24});
    if (const std::optional<Color> color = source.constant())
        constant_ = prepared(*color);
}

Compositor::Compositor(Context& context, const PixelSource& paint, const PixelSource& stencil)
    : Compositor(context, paint) {
    stencil_ = &stencil;
}

Color Compositor::prepared(Color color) const {
    ColorSpace from = source_.space();
    const bool isSame = from.linear == space_.linear && from.luminance == space_.luminance;
    if (isSame && !transforms_)
        return color;
    color = unpremultiplied(color);
    if (transforms_) {
        color = clampedToUnit(color * scale_ + bias_);
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

bool Compositor::drawConstant(int y, int first, int end, float share) {
    const PixelFormat& format = surface_.pixels().format();
    if (!constant_ || !isOver_ || mask_ || stencil_ || !hasBytes_ || (mixesLight_ && share != 1))
        return false;
    const Color added = *constant_ * share;
    const float kept = 1 - added.a;
    std::uint8_t* p = surface_.pixels().at(first, y);
    if (added.a == 1) {
        const std::uint32_t word = format.encode(added);
        for (int x = first; x < end; ++x, p += 4)
            std::memcpy(p, &word, 4);
        return true;
    }
    const bool dividesAlpha = format.alpha.bits != 0 && !space_.premultiplied;
    const Color sum = added * 255.0f + 0.5f;
    for (int x = first; x < end; ++x, p += 4) {
        if (dividesAlpha && p[3] != 255) {
            Color d = premultiplied(format.decode(surface_.pixels().word(x, y)));
            surface_.pixels().setWord(x, y, format.encode(unpremultiplied(added + d * kept)));
            continue;
        }
        for (int c = 0; c < 3; ++c)
            p[c] = std::uint8_t(std::min(sum[c] + float(p[c]) * kept, 255.0f));
        if (format.alpha.bits != 0 && space_.premultiplied)
            p[3] = std::uint8_t(std::min(sum.a + float(p[3]) * kept, 255.0f));
    }
    return true;
}

void Compositor::drawPart(int y, int first, int end, float share) {
    if (drawConstant(y, first, end, share))
        return;
    Pixels& pixels = surface_.pixels();
    const PixelFormat& format = pixels.format();
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
            if (!(coverage > 0))
                continue;
            Color d = format.decode(pixels.word(x, y));
            if (!space_.premultiplied)
                d = premultiplied(d);
            Color result;
            if (stencil_) {
                Color s = stencils[i];
                // A grey surface has one channel to let through: formula (3), of the stencil's numbers as
                // they are.
                if (space_.luminance)
                    s = Color(glm::vec3(luminance(glm::vec3(s))), s.a);
                // The stencil is premultiplied: each channel is image colour times image alpha.
                const Color paint = unpremultiplied(part[i]);
                const Color alphas = s * part[i].a;
                result =
                    blendChannels(blend_, Color(glm::vec3(paint) * glm::vec3(alphas), alphas.a), alphas, d);
            } else {
                result = blend_(part[i], d);
            }
            result = mixed(d, result, coverage);
            pixels.setWord(x, y, format.encode(space_.premultiplied ? result : unpremultiplied(result)));
        }
    }
}

}  // namespace vtm::openvg
