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

/// Puts words of another format into the surface, where scissoring lets it.
template <class Word>
void write(Context& context, const CopyArea& area, const PixelFormat& format, Word&& word) {
    if (area.width <= 0)
        return;
    Pixels& pixels = context.surface->pixels();
    const Clip clip(context);
    for (int j = 0; j < area.height; ++j)
        clip.parts(area.dy + j, area.dx, area.dx + area.width, [&](int first, int end) {
            for (int x = first; x < end; ++x)
                pixels.setWord(x, area.dy + j, convertedWord(word(x - area.dx, j), format, pixels.format()));
        });
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
        write(context, area, image->format(),
              [&](int i, int j) { return image->word(area.sx + i, area.sy + j); });
    });
}

void vgWritePixels(const void* data, VGint dataStride, VGImageFormat dataFormat, VGint dx, VGint dy,
                   VGint width, VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgWritePixels");
        const MemoryPixels memory = memoryPixels(data, dataStride, dataFormat, width, height);
        const CopyArea area = clipped({dx, dy, 0, 0, width, height}, context.surface->width(),
                                      context.surface->height(), width, height);
        write(context, area, memory.format(),
              [&](int i, int j) { return memory.word(area.sx + i, area.sy + j); });
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
        const Pixels& pixels = context.surface->pixels();
        const CopyArea area = clipped({dx, dy, sx, sy, width, height}, pixels.width(), pixels.height(),
                                      pixels.width(), pixels.height());
        const std::vector<std::uint32_t> words =
            copied(area, [&](int x, int y) { return pixels.word(x, y); });
        write(context, area, pixels.format(),
              [&](int i, int j) { return words[std::size_t(j) * std::size_t(area.width) + std::size_t(i)]; });
    });
}
