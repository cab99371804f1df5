// Sections 7.3, 10.9 and 10.10: clearing, and pixels in and out of the drawing surface.

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/image/images.hpp"
#include "api/openvg/record/record.hpp"

using namespace vtm::openvg;

namespace {

/// Recordings have no pixels.
void requirePixels(const Context& context, const char* function) {
    if (context.recorder)
        context.recorder->refuse(function);
}

/// Puts rows of another format into the surface, where scissoring lets it. `row(j)`: the area's j-th;
/// `convert`: convertRow() or takeRow().
template <class Row>
void write(Context& context, const CopyArea& area, const PixelFormat& format, decltype(convertRow)* convert,
           Row&& row) {
    Pixels& pixels = context.surface->pixels();
    const Clip clip(context);
    for (int j = 0; j < area.height; ++j) {
        const std::uint8_t* const from = row(j);
        clip.parts(area.dy + j, area.dx, area.dx + area.width, [&](int first, int end) {
            convert(from + std::size_t(first - area.dx) * format.pixelBytes(), format,
                    pixels.at(first, area.dy + j), pixels.format(), end - first);
        });
    }
}

}  // namespace

void vgClear(VGint x, VGint y, VGint width, VGint height) {
    call([&](Context& context) {
        require(width > 0 && height > 0);
        if (context.recorder)
            return context.recorder->clear(context.state, x, y, width, height);
        Pixels& pixels = context.surface->pixels();
        const std::uint32_t word = wordOf(context.state.clearColor, pixels.format());
        const CopyArea area =
            clipped({x, y, 0, 0, width, height}, pixels.width(), pixels.height(), width, height);
        const Clip clip(context);
        for (int j = 0; j < area.height; ++j)
            clip.parts(area.dy + j, area.dx, area.dx + area.width,
                       [&](int first, int end) { pixels.fill(first, end, area.dy + j, word); });
    });
}

void vgSetPixels(VGint dx, VGint dy, VGImage src, VGint sx, VGint sy, VGint width, VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgSetPixels");
        const std::shared_ptr<Image> image = freeImage(context, src);
        require(width > 0 && height > 0);
        const CopyArea area = clipped({dx, dy, sx, sy, width, height}, context.surface->width(),
                                      context.surface->height(), image->width(), image->height());
        write(context, area, image->format(), convertRow,
              [&](int j) { return image->at(area.sx, area.sy + j); });
    });
}

void vgWritePixels(const void* data, VGint dataStride, VGImageFormat dataFormat, VGint dx, VGint dy,
                   VGint width, VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgWritePixels");
        const MemoryPixels memory = memoryPixels(data, dataStride, dataFormat, width, height);
        const CopyArea area = clipped({dx, dy, 0, 0, width, height}, context.surface->width(),
                                      context.surface->height(), width, height);
        std::vector<std::uint8_t> bytes(memory.isPacked() ? std::size_t(area.width) : 0);
        write(context, area, memory.format(), takeRow, [&](int j) -> const std::uint8_t* {
            if (!memory.isPacked())
                return memory.at(area.sx, area.sy + j);
            memory.unpackRow(area.sx, area.sy + j, area.width, bytes.data());
            return bytes.data();
        });
    });
}

void vgGetPixels(VGImage dst, VGint dx, VGint dy, VGint sx, VGint sy, VGint width, VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgGetPixels");
        const std::shared_ptr<Image> image = freeImage(context, dst);
        require(width > 0 && height > 0);
        const Pixels& pixels = context.surface->pixels();
        const CopyArea area = clipped({dx, dy, sx, sy, width, height}, image->width(), image->height(),
                                      pixels.width(), pixels.height());
        copyPixels(pixels, *image, area);
    });
}

void vgReadPixels(void* data, VGint dataStride, VGImageFormat dataFormat, VGint sx, VGint sy, VGint width,
                  VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgReadPixels");
        const MemoryPixels memory = memoryPixels(data, dataStride, dataFormat, width, height);
        const Pixels& pixels = context.surface->pixels();
        const CopyArea area =
            clipped({0, 0, sx, sy, width, height}, width, height, pixels.width(), pixels.height());
        copyPixels(pixels, memory, area);
    });
}

void vgCopyPixels(VGint dx, VGint dy, VGint sx, VGint sy, VGint width, VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgCopyPixels");
        require(width > 0 && height > 0);
        Pixels& pixels = context.surface->pixels();
        const CopyArea area = clipped({dx, dy, sx, sy, width, height}, pixels.width(), pixels.height(),
                                      pixels.width(), pixels.height());
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
    });
}
