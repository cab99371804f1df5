// The compositor of pixels in memory.

#include <cstring>
#include <vector>

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/draw/row_compositor.hpp"
#include "api/openvg/image/images.hpp"

namespace vtm::openvg {

namespace {

/// Puts rows of another format into the surface, where scissoring lets it. `row(j)`: the area's j-th;
/// `convert`: convertRow() or takeRow().
template <class Row>
void write(Context& context, const CopyArea& area, const PixelFormat& format, RowConversion* convert,
           Row&& row) {
    Pixels& pixels = context.surface->pixels().write();
    const Clip clip(context);
    for (int j = 0; j < area.height; ++j) {
        const std::uint8_t* const from = row(j);
        clip.parts(area.dy + j, area.dx, area.dx + area.width, [&](int first, int end) {
            convert(from + std::size_t(first - area.dx) * format.pixelBytes(), format,
                    pixels.at(first, area.dy + j), pixels.format(), end - first);
        });
    }
}

class CpuCompositor final : public Compositor {
public:
    void draw(Context& context, const Layer& layer, const Coverage& coverage) override {
        RowCompositor rows = layer.stencil ? RowCompositor(context, layer.source, *layer.stencil)
                                           : RowCompositor(context, layer.source);
        coverage(rows.clip().bounds(), std::ref(rows));
    }

    void drawGlyphs(Context& context, const PixelSource& color,
                    std::span<const PlacedGlyph> glyphs) override {
        RowCompositor(context, color).draw(glyphs);
    }

    void clear(Context& context, const CopyArea& area, std::uint32_t word) override {
        Pixels& pixels = context.surface->pixels().write();
        const Clip clip(context);
        for (int j = 0; j < area.height; ++j)
            clip.parts(area.dy + j, area.dx, area.dx + area.width,
                       [&](int first, int end) { pixels.fill(first, end, area.dy + j, word); });
    }

    void setPixels(Context& context, const Image& from, const CopyArea& area) override {
        write(context, area, from.format(), convertRow, [&](int j) { return from.at(area.sx, area.sy + j); });
    }

    void writePixels(Context& context, const MemoryPixels& from, const CopyArea& area) override {
        std::vector<std::uint8_t> bytes(from.isPacked() ? std::size_t(area.width) : 0);
        write(context, area, from.format(), takeRow, [&](int j) -> const std::uint8_t* {
            if (!from.isPacked())
                return from.at(area.sx, area.sy + j);
            from.unpackRow(area.sx, area.sy + j, area.width, bytes.data());
            return bytes.data();
        });
    }

    void getPixels(Context& context, Image& to, const CopyArea& area) override {
        openvg::copyPixels(context.surface->pixels().read(), to, area);
    }

    void readPixels(Context& context, const MemoryPixels& to, const CopyArea& area) override {
        openvg::copyPixels(context.surface->pixels().read(), to, area);
    }

    void copyPixels(Context& context, const CopyArea& area) override {
        Pixels& pixels = context.surface->pixels().write();
        // What is written over what is still to be read: the last rows first, each by way of a copy.
        const bool isUp = area.dy > area.sy;
        const Clip clip(context);
        const std::size_t bytes = pixels.pixelBytes();
        std::vector<std::uint8_t> row(std::size_t(area.width) * bytes);
        for (int i = 0; i < area.height; ++i) {
            const int j = isUp ? area.height - 1 - i : i;
            std::memcpy(row.data(), pixels.at(area.sx, area.sy + j), row.size());
            clip.parts(area.dy + j, area.dx, area.dx + area.width, [&](int first, int end) {
                std::memcpy(pixels.at(first, area.dy + j), row.data() + std::size_t(first - area.dx) * bytes,
                            std::size_t(end - first) * bytes);
            });
        }
    }

    // Every call draws at once.
    void flush() override {}
    void finish() override {}
};

}  // namespace

Compositor& cpuCompositor() {
    static auto& compositor = *new CpuCompositor;  // programs may call until their end
    return compositor;
}

}  // namespace vtm::openvg
