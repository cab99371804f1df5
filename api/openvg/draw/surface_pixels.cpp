// Sections 7.3, 10.9 and 10.10: clearing, and pixels in and out of the drawing surface.

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/image/images.hpp"
#include "api/openvg/record/record.hpp"

using namespace vtm::openvg;

namespace {

/// A program's pixels as an image.
std::shared_ptr<const Image> imageOf(const MemoryPixels& memory, int width, int height) {
    const auto image =
        std::make_shared<Image>(std::make_shared<ImageStorage>(Pixels(width, height, memory.format())),
                                Rectangle{0, 0, width, height});
    copyPixels(memory, *image, {0, 0, 0, 0, width, height});
    return image;
}

/// A part of an image put into a recording, which has no border where it begins and ends.
void record(Context& context, const Image& image, const CopyArea& area) {
    const CopyArea part = clipped(area, maxImageSide, maxImageSide, image.width(), image.height());
    if (part.width > 0)
        context.recorder->setPixels(context.state, image, part);
}

/// Recordings have no pixels to be read.
void requirePixels(const Context& context, const char* function) {
    if (context.recorder)
        context.recorder->refuse(function);
}

/// An area of the surface that gets pixels of a source of some size.
CopyArea clippedToSurface(const CopyArea& area, const Context& context, int sourceWidth, int sourceHeight) {
    return clipped(area, context.surface->width(), context.surface->height(), sourceWidth, sourceHeight);
}

}  // namespace

void vgClear(VGint x, VGint y, VGint width, VGint height) {
    call([&](Context& context) {
        require(width > 0 && height > 0);
        if (context.recorder)
            return context.recorder->clear(context.state, x, y, width, height);
        compositorOf(context).clear(context,
                                    clippedToSurface({x, y, 0, 0, width, height}, context, width, height),
                                    wordOf(context.state.clearColor, context.surface->pixels().format()));
    });
}

void vgSetPixels(VGint dx, VGint dy, VGImage src, VGint sx, VGint sy, VGint width, VGint height) {
    call([&](Context& context) {
        const std::shared_ptr<const Image> image = freeImage(context, src);
        require(width > 0 && height > 0);
        if (context.recorder)
            return record(context, *image, {dx, dy, sx, sy, width, height});
        compositorOf(context).setPixels(
            context, *image,
            clippedToSurface({dx, dy, sx, sy, width, height}, context, image->width(), image->height()));
    });
}

void vgWritePixels(const void* data, VGint dataStride, VGImageFormat dataFormat, VGint dx, VGint dy,
                   VGint width, VGint height) {
    call([&](Context& context) {
        const MemoryPixels memory = memoryPixels(data, dataStride, dataFormat, width, height);
        if (context.recorder)
            return record(context, *imageOf(memory, width, height), {dx, dy, 0, 0, width, height});
        compositorOf(context).writePixels(
            context, memory, clippedToSurface({dx, dy, 0, 0, width, height}, context, width, height));
    });
}

void vgGetPixels(VGImage dst, VGint dx, VGint dy, VGint sx, VGint sy, VGint width, VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgGetPixels");
        const std::shared_ptr<Image> image = freeImage(context, dst);
        require(width > 0 && height > 0);
        compositorOf(context).getPixels(
            context, *image,
            clipped({dx, dy, sx, sy, width, height}, image->width(), image->height(),
                    context.surface->width(), context.surface->height()));
    });
}

void vgReadPixels(void* data, VGint dataStride, VGImageFormat dataFormat, VGint sx, VGint sy, VGint width,
                  VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgReadPixels");
        const MemoryPixels memory = memoryPixels(data, dataStride, dataFormat, width, height);
        compositorOf(context).readPixels(context, memory,
                                         clipped({0, 0, sx, sy, width, height}, width, height,
                                                 context.surface->width(), context.surface->height()));
    });
}

void vgCopyPixels(VGint dx, VGint dy, VGint sx, VGint sy, VGint width, VGint height) {
    call([&](Context& context) {
        requirePixels(context, "vgCopyPixels");
        require(width > 0 && height > 0);
        compositorOf(context).copyPixels(
            context, clippedToSurface({dx, dy, sx, sy, width, height}, context, context.surface->width(),
                                      context.surface->height()));
    });
}
