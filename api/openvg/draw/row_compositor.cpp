#include "api/openvg/draw/row_compositor.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "api/openvg/image/byte_rows.hpp"
#include "api/openvg/paint/lanes.hpp"

namespace vtm::openvg {

namespace {

bool hasAlphaOnly(const PixelFormat& format) { return format.red.bits == 0 && format.grey.bits == 0; }

}  // namespace

void prepareColors(std::span<Color> colors, ColorSpace from, const ScaleAndBias& transform,
                   const PixelFormat& format) {
    ColorSpace to = format.space;
    if (from.linear == to.linear && from.luminance == to.luminance && !transform.isOn())
        return;
    from.premultiplied = to.premultiplied = true;
    if (transform.isOn()) {
        for (Color& color : colors)
            color = premultiplied(transform(unpremultiplied(color)));
        from.luminance = false;  // what was grey may no longer be
    }
    // Alpha-only surfaces keep no colour to convert.
    if (!hasAlphaOnly(format))
        convertColors(colors, from, to);
}

RowCompositor::RowCompositor(Context& context, const PixelSource& source)
    : pixels_(context.surface->pixels().write()),
      clip_(context),
      source_(source),
      blend_(blendModeOf(context.state.blendMode)),
      isOver_(context.state.blendMode == VG_BLEND_SRC_OVER),
      isSource_(context.state.blendMode == VG_BLEND_SRC),
      transform_(context.state),
      format_(pixels_.format()),
      isAlphaOnly_(hasAlphaOnly(format_)) {
    if (context.state.masking && context.surface->mask)
        mask_ = &*context.surface->mask;
    mixesLight_ = !format_.space.linear && !isAlphaOnly_;
    order_ = byteOrder(format_);
    stored_ = storedRule();
    if (const std::optional<Color> color = source.constant())
        use(*color);
}

void RowCompositor::use(Color color) {
    prepare(std::span(&color, 1));
    constant_ = color;
    drawsBytes_ = isOver_ && !mask_ && order_ == ByteOrder{0, 1, 2, 3};
    if (!drawsBytes_)
        return;
    word_ = format_.encode(color);
    edgeColor_ = EdgeColor(color, format_.space, format_.alpha.bits != 0);
}

RowCompositor::RowCompositor(Context& context, const PixelSource& paint, const PixelSource& stencil)
    : RowCompositor(context, paint) {
    stencil_ = &stencil;
    drawsBytes_ = false;
    stored_ = Stored::no;
}

template <class Function>
void RowCompositor::withMixer(Function&& f) const {
    const auto with = [&](const auto& mixer) {
        if (format_.alpha.bits == 0)
            return f([&](std::uint8_t* p, unsigned share) {
                mixer(p, share);
                return true;
            });
        f([&, isPremultiplied = format_.space.premultiplied](std::uint8_t* p, unsigned share) {
            if (p[3] == 255) {
                mixer(p, share);
                return true;
            }
            // What is translucent must be divided by its alpha to be mixed.
            if (p[3] != 0 || !isPremultiplied)
                return false;
            const Color mixed = *constant_ * (float(share) * (255.0f / wholeShare)) + 0.5f;
            for (int c = 0; c < 4; ++c)
                p[c] = std::uint8_t(int(mixed[c]));
            return true;
        });
    };
    if (format_.space.linear)
        with(LinearMixer(*constant_));
    else if (constant_->a == 1)
        with(OpaqueMixer(*constant_));
    else
        with(TranslucentMixer(*constant_));
}

void RowCompositor::operator()(int y, std::span<const CoverageRun> runs) {
    const auto draw = [&](const auto& drawEdge) {
        for (const CoverageRun& run : runs)
            clip_.parts(y, run.first, run.end, [&](int first, int end) {
                run.share == 1 ? drawPart(y, first, end, 1) : drawEdge(first, end, run.share);
            });
    };
    if (!drawsBytes_)
        return draw([&](int first, int end, float share) { drawPart(y, first, end, share); });
    withMixer([&](auto&& mixed) {
        draw([&](int first, int end, float share) {
            std::uint8_t* p = pixels_.at(first, y);
            for (int x = first; x < end; ++x, p += 4)
                if (!mixed(p, fixedShare(share)))
                    drawEdge(x, y, fixedShare(share));
        });
    });
}

void RowCompositor::drawPart(int y, int first, int end, float share) {
    if (drawsBytes_ && drawBytes(y, first, end))
        return;
    if (share == 1 && drawStored(y, first, end))
        return;
    drawAny(y, first, end, share);
}

// ---- Bytes ----------------------------------------------------------------------------------------

bool RowCompositor::drawBytes(int y, int first, int end) {
    if (constant_->a == 1) {
        pixels_.fill(first, end, y, word_);
        return true;
    }
    std::uint8_t* const p = pixels_.at(first, y);
    const bool hasAlpha = format_.alpha.bits != 0, isStraight = hasAlpha && !format_.space.premultiplied;
    // What is translucent must be divided by its alpha to be mixed.
    if (isStraight && !isOpaque(p, end - first))
        return false;
    overBytes(p, end - first, *constant_, !hasAlpha || isStraight);
    return true;
}

void RowCompositor::drawEdge(int x, int y, unsigned share) {
    const EdgePixel edge{0, 0, std::uint16_t(std::min(share, wholeShare - 1))};
    if (wide::mixEdges(pixels_.at(x, y), 0, std::span(&edge, 1), edgeColor_))
        return;
    const float part = float(share) / wholeShare;
    drawRow(x, y, std::span(&part, 1));
}

template <class Mixer>
void RowCompositor::drawGlyphBytes(GlyphCoverage& coverage, int left, int bottom, const Mixer& mixed) {
    std::uint8_t* const corner = pixels_.at(left, bottom);
    const std::ptrdiff_t stride = pixels_.stride();
    const auto mix = [&](std::uint8_t* from, std::ptrdiff_t rowBytes, std::span<const EdgePixel> edges) {
        if (wide::mixEdges(from, rowBytes, edges, edgeColor_))
            return;
        for (const EdgePixel& edge : edges)
            // True for what is kept of flat grounds, which are opaque.
            if (!mixed(edge.in(from, rowBytes), edge.share))
                drawEdge(left + edge.x, bottom + edge.y, edge.share);
    };
    const std::span<const EdgePixel> edges = coverage.edges();
    // Far from its neighbours, which may touch it.
    const std::uint8_t* const middle = edges.empty() ? nullptr : edges[edges.size() / 2].in(corner, stride);
    const bool mayBeFlat =
        middle && edgeColor_.rule == EdgeRule::opaque && (!edgeColor_.groundHasAlpha || middle[3] == 255);
    const std::uint32_t ground = mayBeFlat ? wordAt(middle, 4) : 0;
    const auto isMostlyFlat = [&] {
        const auto isElsewhere = [&](const EdgePixel& edge) {
            return wordAt(edge.in(corner, stride), 4) != ground;
        };
        return FlatGround::isWorth(std::size_t(std::ranges::count_if(edges, isElsewhere)), edges.size());
    };
    FlatGround& flat = coverage.ground();
    if (mayBeFlat && flat.serves({*constant_, word_, ground, stride}) && (flat.isMade() || isMostlyFlat())) {
        if (!flat.isMade())
            flat.make([&](const auto& row) { coverage.forEachRow(row); }, mix);
        if (flat.draw(corner, pixels_.end(), mix))
            return;
    }
    for (const GlyphCoverage::Run& run : coverage.runs()) {
        if (constant_->a != 1) {
            drawPart(bottom + run.y, left + run.first, left + run.end, 1);
            continue;
        }
        std::uint8_t* p = corner + run.y * stride + 4 * std::ptrdiff_t(run.first);
        for (int x = run.first; x < run.end; ++x, p += 4)
            std::memcpy(p, &word_, 4);
    }
    mix(corner, stride, edges);
}

void RowCompositor::draw(std::span<const PlacedGlyph> glyphs) {
    const Rectangle& bounds = clip_.bounds();
    if (!drawsBytes_ || !clip_.isBox()) {
        for (const PlacedGlyph& glyph : glyphs)
            glyph.play(bounds, std::ref(*this));
        return;
    }
    withMixer([&](const auto& mixed) {
        for (const PlacedGlyph& glyph : glyphs) {
            const Rectangle& box = glyph.coverage->box();
            const Rectangle at{box.x0 + glyph.left, box.y0 + glyph.bottom, box.x1 + glyph.left,
                               box.y1 + glyph.bottom};
            if (at.x0 >= bounds.x0 && at.y0 >= bounds.y0 && at.x1 <= bounds.x1 && at.y1 <= bounds.y1)
                drawGlyphBytes(*glyph.coverage, at.x0, at.y0, mixed);
            else
                glyph.play(bounds, std::ref(*this));
        }
    });
}

bool RowCompositor::drawStored(int y, int first, int end) {
    if (stored_ == Stored::no)
        return false;
    const std::optional<StoredRow> row = source_.stored(first, y, end - first);
    if (!row)
        return false;
    std::uint8_t* const p = pixels_.at(first, y);
    if (stored_ == Stored::over) {
        overBytes(p, row->pixels, end - first, order_->alpha);
        return true;
    }
    PixelFormat from = *source_.storedFormat();
    if (stored_ == Stored::copiedIfOpaque) {
        if (!isOpaque(row->pixels, end - first, byteOrder(from)->alpha))
            return false;
        from.alpha.bits = 0;
    }
    if (!converter_)
        converter_.emplace(from, format_, convertRow, clip_.bounds().area());
    (*converter_)(row->pixels, p, end - first);
    return true;
}

/// How drawStored() draws pixels of the source's format.
RowCompositor::Stored RowCompositor::storedRule() const {
    const PixelFormat* const from = source_.storedFormat();
    if (!from || transform_.isOn() || mask_)
        return Stored::no;
    // What has no alpha has no colour, unless it is stored without premultiplied alpha.
    const bool isStraight = from->alpha.bits != 0 && !from->space.premultiplied;
    if ((isSource_ && !isStraight) || (isOver_ && from->alpha.bits == 0))
        return Stored::copied;
    if (isOver_ && order_ && from->space.premultiplied && *from == format_)
        return Stored::over;
    return isOver_ && byteOrder(*from) ? Stored::copiedIfOpaque : Stored::no;
}

// ---- Any format -----------------------------------------------------------------------------------

void RowCompositor::sourceRow(int x, int y, std::span<Color> colors) const {
    if (constant_) {
        std::ranges::fill(colors, *constant_);
        return;
    }
    source_.colors(x, y, colors);
    prepare(colors);
}

void RowCompositor::blendRow(int x, int y, std::span<const Color> source,
                             std::span<Color> destination) const {
    if (!stencil_)
        return blend_.row(source, destination);
    std::array<Color, rowChunk> stencils;
    stencil_->colors(x, y, std::span(stencils).first(source.size()));
    for (std::size_t i = 0; i < source.size(); ++i) {
        // Premultiplied: each channel is image colour times image alpha. A grey surface has one channel to
        // let through: formula (3), of the stencil's numbers as they are.
        const Color s = format_.space.luminance
                            ? Color(glm::vec3(luminance(glm::vec3(stencils[i]))), stencils[i].a)
                            : stencils[i];
        const Color alphas = s * source[i].a;
        destination[i] = blendChannels(
            blend_.pixel, Color(glm::vec3(unpremultiplied(source[i])) * glm::vec3(alphas), alphas.a), alphas,
            destination[i]);
    }
}

void RowCompositor::mixRow(std::span<const Color> before, std::span<const float> coverage,
                           std::span<Color> after) const {
    const auto linear = [](Color c) { return premultiplied(fastDecoded(unpremultiplied(c))); };
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (coverage[i] == 1)
            continue;
        if (!mixesLight_) {
            after[i] = before[i] + coverage[i] * (after[i] - before[i]);
            continue;
        }
        const Color a = linear(before[i]), b = linear(after[i]);
        after[i] = premultiplied(fastEncoded(unpremultiplied(a + coverage[i] * (b - a))));
    }
}

void RowCompositor::drawAny(int y, int first, int end, float share) {
    const std::uint8_t* mask = mask_ ? mask_->row(y) : nullptr;
    std::array<float, rowChunk> buffer;
    inChunks(end - first, [&](int from, int count) {
        const std::span<float> coverage = std::span(buffer).first(std::size_t(count));
        const int x = first + from;
        for (std::size_t i = 0; i < coverage.size(); ++i)
            coverage[i] = mask ? share * (float(mask[x + int(i)]) / 255) : share;
        drawRow(x, y, coverage);
    });
}

void RowCompositor::drawRow(int x, int y, std::span<const float> coverage) {
    std::array<Color, rowChunk> sources, destinations, afters;
    const std::size_t count = coverage.size();
    const std::span<Color> source = std::span(sources).first(count);
    std::uint8_t* const pixels = pixels_.at(x, y);
    sourceRow(x, y, source);
    const bool isWhole = !mask_ && coverage[0] == 1;
    ColorSpace blended = format_.space;
    blended.premultiplied = true;
    const bool replaces =
        isSource_ || (isOver_ && std::ranges::all_of(source, [](const Color& c) { return c.a == 1; }));
    if (isWhole && !stencil_ && replaces) {
        convertColors(source, blended, format_.space);
        return encodeRow(format_, source, pixels);
    }
    const std::span<Color> before = std::span(destinations).first(count),
                           after = std::span(afters).first(count);
    decodeRow(format_, pixels, before);
    convertColors(before, format_.space, blended);
    std::ranges::copy(before, after.begin());
    blendRow(x, y, source, after);
    if (!isWhole)
        mixRow(before, coverage, after);
    convertColors(after, blended, format_.space);
    if (!mask_)
        return encodeRow(format_, after, pixels);
    // What is not covered stays as it is, bit for bit.
    std::array<std::uint8_t, 4 * rowChunk> encoded;
    encodeRow(format_, after, encoded.data());
    const std::size_t bytes = format_.pixelBytes();
    for (std::size_t i = 0; i < count; ++i)
        if (coverage[i] > 0)
            std::memcpy(pixels + i * bytes, encoded.data() + i * bytes, bytes);
}

}  // namespace vtm::openvg
