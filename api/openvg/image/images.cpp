// Sections 10.3 to 10.7: image objects, and pixels in and out of them.

#include "api/openvg/image/images.hpp"

#include <algorithm>

#include "api/openvg/draw/compositor.hpp"

namespace vtm::openvg {

std::shared_ptr<Image> freeImage(const Context& context, VGImage handle) {
    std::shared_ptr<Image> image = context.objects->get<Image>(handle);
    require(!image->storage->isTarget, VG_IMAGE_IN_USE_ERROR);
    return image;
}

std::shared_ptr<Image> parentOf(const Image& image) {
    std::shared_ptr<Image> ancestor = image.parent;
    while (ancestor && ancestor->handle == VG_INVALID_HANDLE)
        ancestor = ancestor->parent;
    return ancestor;
}

std::uint32_t wordOf(const std::array<VGfloat, 4>& c, const PixelFormat& format) {
    return format.encode(givenColor(c, format.space));
}

}  // namespace vtm::openvg

using namespace vtm::openvg;

namespace {

void requireSize(VGint width, VGint height) { require(width > 0 && height > 0); }

/// Between images of one storage, which may overlap.
void moveRows(Image& to, const Image& from, const CopyArea& area) {
    const std::size_t bytes = std::size_t(area.width) * to.format().pixelBytes();
    const bool isUp = to.area.y0 + area.dy > from.area.y0 + area.sy;
    for (int i = 0; i < area.height; ++i) {
        const int j = isUp ? area.height - 1 - i : i;
        std::memmove(to.at(area.dx, area.dy + j), from.at(area.sx, area.sy + j), bytes);
    }
}

}  // namespace

VGImage vgCreateImage(VGImageFormat format, VGint width, VGint height, VGbitfield allowedQuality) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        const std::optional<PixelFormat> pixelFormat = imageFormat(VGint(format));
        require(pixelFormat.has_value(), VG_UNSUPPORTED_IMAGE_FORMAT_ERROR);
        requireSize(width, height);
        require(width <= maxImageSide && height <= maxImageSide);
        const std::int64_t pixels = std::int64_t(width) * height;
        require(pixels <= maxImagePixels &&
                (std::int64_t(width) * pixelFormat->bits + 7) / 8 * height <= maxImageBytes);
        require(allowedQuality != 0 &&
                (allowedQuality & ~VGbitfield(VG_IMAGE_QUALITY_NONANTIALIASED | VG_IMAGE_QUALITY_FASTER |
                                              VG_IMAGE_QUALITY_BETTER)) == 0);
        auto image =
            std::make_shared<Image>(std::make_shared<ImageStorage>(Pixels(width, height, *pixelFormat)),
                                    Rectangle{0, 0, width, height});
        image->formatName = VGint(format);
        image->allowedQuality = allowedQuality;
        return context.objects->add(std::move(image));
    });
}

void vgDestroyImage(VGImage image) {
    call([&](Context& context) { context.objects->destroy<Image>(image); });
}

void vgClearImage(VGImage handle, VGint x, VGint y, VGint width, VGint height) {
    call([&](Context& context) {
        const std::shared_ptr<Image> image = freeImage(context, handle);
        requireSize(width, height);
        const std::uint32_t word = wordOf(context.state.clearColor, image->format());
        const CopyArea area =
            clipped({x, y, 0, 0, width, height}, image->width(), image->height(), width, height);
        if (area.width == 0 || compositorOf(context).clearImage(*image, area, word))
            return;
        const int left = image->area.x0 + area.dx;
        for (int j = 0; j < area.height; ++j)
            image->storage->pixels.write().fill(left, left + area.width, image->area.y0 + area.dy + j, word);
    });
}

void vgImageSubData(VGImage handle, const void* data, VGint dataStride, VGImageFormat dataFormat, VGint x,
                    VGint y, VGint width, VGint height) {
    call([&](Context& context) {
        const std::shared_ptr<Image> image = freeImage(context, handle);
        const MemoryPixels memory = memoryPixels(data, dataStride, dataFormat, width, height);
        const CopyArea area =
            clipped({x, y, 0, 0, width, height}, image->width(), image->height(), width, height);
        if (area.width > 0 && !compositorOf(context).writeImage(*image, memory, area))
            copyPixels(memory, *image, area);
    });
}

void vgGetImageSubData(VGImage handle, void* data, VGint dataStride, VGImageFormat dataFormat, VGint x,
                       VGint y, VGint width, VGint height) {
    call([&](Context& context) {
        const std::shared_ptr<Image> image = freeImage(context, handle);
        const MemoryPixels memory = memoryPixels(data, dataStride, dataFormat, width, height);
        const CopyArea area =
            clipped({0, 0, x, y, width, height}, width, height, image->width(), image->height());
        if (area.width > 0 && !compositorOf(context).readImage(*image, memory, area))
            copyPixels(std::as_const(*image), memory, area);
    });
}

VGImage vgChildImage(VGImage parent, VGint x, VGint y, VGint width, VGint height) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        const std::shared_ptr<Image> image = freeImage(context, parent);
        require(x >= 0 && x < image->width() && y >= 0 && y < image->height());
        requireSize(width, height);
        require(width <= image->width() - x && height <= image->height() - y);
        const int left = image->area.x0 + x, bottom = image->area.y0 + y;
        auto child =
            std::make_shared<Image>(image->storage, Rectangle{left, bottom, left + width, bottom + height});
        child->formatName = image->formatName;
        child->allowedQuality = image->allowedQuality;
        child->parent = image;
        return context.objects->add(std::move(child));
    });
}

VGImage vgGetParent(VGImage handle) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        const std::shared_ptr<Image> parent = parentOf(*freeImage(context, handle));
        return parent ? parent->handle : handle;
    });
}

void vgCopyImage(VGImage dst, VGint dx, VGint dy, VGImage src, VGint sx, VGint sy, VGint width, VGint height,
                 VGboolean) {
    call([&](Context& context) {
        const std::shared_ptr<Image> to = context.objects->get<Image>(dst),
                                     from = context.objects->get<Image>(src);
        require(!to->storage->isTarget && !from->storage->isTarget, VG_IMAGE_IN_USE_ERROR);
        requireSize(width, height);
        const CopyArea area = clipped({dx, dy, sx, sy, width, height}, to->width(), to->height(),
                                      from->width(), from->height());
        if (area.width == 0 || compositorOf(context).copyImage(*to, *from, area))
            return;
        if (from->storage == to->storage)
            moveRows(*to, *from, area);
        else
            copyPixels(std::as_const(*from), *to, area);
    });
}
