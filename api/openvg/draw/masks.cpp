// Section 7.2: the drawing surface mask and mask layers.

#include <algorithm>
#include <cmath>

#include "api/openvg/draw/clip.hpp"
#include "api/openvg/draw/draw_path.hpp"
#include "api/openvg/image/images.hpp"
#include "api/openvg/image/pixels.hpp"
#include "api/openvg/record/record.hpp"

using namespace vtm::openvg;

namespace {

std::uint8_t toByte(float unit) { return std::uint8_t(std::clamp(unit, 0.0f, 1.0f) * 255 + 0.5f); }

/// Table 5, for the operations that take a new mask.
std::uint8_t combined(VGMaskOperation operation, std::uint8_t before, float mask) {
    const float previous = float(before) / 255;
    switch (operation) {
        case VG_UNION_MASK:
            return toByte(1 - (1 - mask) * (1 - previous));
        case VG_INTERSECT_MASK:
            return toByte(mask * previous);
        case VG_SUBTRACT_MASK:
            return toByte(previous * (1 - mask));
        default:
            return toByte(mask);
    }
}

bool isOperation(VGMaskOperation operation) {
    return VGint(operation) >= VG_CLEAR_MASK && VGint(operation) <= VG_SUBTRACT_MASK;
}

bool takesMask(VGMaskOperation operation) { return operation != VG_CLEAR_MASK && operation != VG_FILL_MASK; }

/// What an image means as a mask.
float maskValue(const Image& image, int x, int y) {
    const PixelFormat& format = image.format();
    const Color color = image.color(x, y);
    return format.alpha.bits != 0 ? color.a : color.r;
}

MaskValues valuesOf(const Image& image) {
    MaskValues values(image.width(), image.height());
    for (int y = 0; y < values.height; ++y)
        for (int x = 0; x < values.width; ++x)
            values.row(y)[x] = toByte(maskValue(image, x, y));
    return values;
}

/// Fills a part of the mask with 0 or 1.
void fill(MaskValues& mask, const CopyArea& area, std::uint8_t value) {
    for (int j = 0; j < area.height; ++j)
        std::fill_n(mask.row(area.dy + j) + area.dx, std::max(0, area.width), value);
}

template <class Value>
void combine(MaskValues& mask, const CopyArea& area, VGMaskOperation operation, Value&& value) {
    for (int j = 0; j < area.height; ++j)
        for (int i = 0; i < area.width; ++i) {
            std::uint8_t& m = mask.row(area.dy + j)[area.dx + i];
            m = combined(operation, m, value(area.sx + i, area.sy + j));
        }
}

}  // namespace

void vgMask(VGHandle handle, VGMaskOperation operation, VGint x, VGint y, VGint width, VGint height) {
    call([&](Context& context) {
        std::shared_ptr<Image> image;
        std::shared_ptr<MaskLayer> layer;
        if (takesMask(operation) && isOperation(operation)) {
            image = context.objects->find<Image>(handle);
            layer = context.objects->find<MaskLayer>(handle);
            require(image || layer, VG_BAD_HANDLE_ERROR);
            require(!image || !image->storage->isTarget, VG_IMAGE_IN_USE_ERROR);
        }
        require(isOperation(operation));
        require(width > 0 && height > 0);
        if (context.recorder) {
            if (image)
                return context.recorder->mask(valuesOf(*image), operation, {x, y, 0, 0, width, height});
            return context.recorder->mask(layer.get(), operation, {x, y, 0, 0, width, height});
        }
        if (!context.surface->mask)
            return;
        MaskValues& mask = *context.surface->mask;
        const int sourceWidth = image ? image->width() : layer ? layer->mask.width : width;
        const int sourceHeight = image ? image->height() : layer ? layer->mask.height : height;
        const CopyArea area =
            clipped({x, y, 0, 0, width, height}, mask.width, mask.height, sourceWidth, sourceHeight);
        if (image)
            combine(mask, area, operation, [&](int i, int j) { return maskValue(*image, i, j); });
        else if (layer)
            combine(mask, area, operation, [&](int i, int j) { return float(layer->mask.row(j)[i]) / 255; });
        else
            fill(mask, area, operation == VG_FILL_MASK ? 255 : 0);
    });
}

void vgRenderToMask(VGPath handle, VGbitfield paintModes, VGMaskOperation operation) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = context.objects->get<Path>(handle);
        requirePaintModes(paintModes);
        require(isOperation(operation));
        if (context.recorder)
            return context.recorder->renderToMask(context.state, *path, paintModes, operation);
        if (!context.surface->mask)
            return;
        MaskValues& mask = *context.surface->mask;
        if (!takesMask(operation))
            return fill(mask, {0, 0, 0, 0, mask.width, mask.height}, operation == VG_FILL_MASK ? 255 : 0);
        const glm::mat3& toSurface = context.state.matrix(VG_MATRIX_PATH_USER_TO_SURFACE);
        for (const VGPaintMode mode : {VG_FILL_PATH, VG_STROKE_PATH}) {
            if (!(paintModes & VGbitfield(mode)))
                continue;
            const Clip clip(context);
            std::vector<float> coverage(std::size_t(mask.width) * std::size_t(mask.height));
            coverPath(context, *path, mode, toSurface, clip.bounds(),
                      [&](int y, std::span<const CoverageRun> runs) {
                          float* row = coverage.data() + std::size_t(y) * std::size_t(mask.width);
                          for (const CoverageRun& run : runs)
                              clip.parts(y, run.first, run.end, [&](int first, int end) {
                                  std::fill(row + first, row + end, run.share);
                              });
                      });
            combine(mask, {0, 0, 0, 0, mask.width, mask.height}, operation, [&](int i, int j) {
                return coverage[std::size_t(j) * std::size_t(mask.width) + std::size_t(i)];
            });
        }
    });
}

VGMaskLayer vgCreateMaskLayer(VGint width, VGint height) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        require(width > 0 && height > 0 && width <= maxImageSide && height <= maxImageSide &&
                std::int64_t(width) * height <= maxImagePixels);
        if (!context.surface->mask)
            return VG_INVALID_HANDLE;
        auto layer = std::make_shared<MaskLayer>();
        layer->mask = MaskValues(width, height);
        return context.objects->add(std::move(layer));
    });
}

void vgDestroyMaskLayer(VGMaskLayer layer) {
    call([&](Context& context) { context.objects->destroy<MaskLayer>(layer); });
}

void vgFillMaskLayer(VGMaskLayer handle, VGint x, VGint y, VGint width, VGint height, VGfloat value) {
    call([&](Context& context) {
        const std::shared_ptr<MaskLayer> layer = context.objects->get<MaskLayer>(handle);
        MaskValues& mask = layer->mask;
        require(value >= 0 && value <= 1 && width > 0 && height > 0 && x >= 0 && y >= 0);
        require(width <= mask.width - x && height <= mask.height - y);
        const CopyArea area{x, y, 0, 0, width, height};
        if (context.recorder)
            return context.recorder->fillMaskLayer(*layer, area, value);
        fill(mask, area, toByte(value));
    });
}

void vgCopyMask(VGMaskLayer handle, VGint dx, VGint dy, VGint sx, VGint sy, VGint width, VGint height) {
    call([&](Context& context) {
        const std::shared_ptr<MaskLayer> target = context.objects->get<MaskLayer>(handle);
        MaskValues& layer = target->mask;
        require(width > 0 && height > 0);
        if (context.recorder)
            return context.recorder->copyMask(*target, {dx, dy, sx, sy, width, height});
        if (!context.surface->mask)
            return;
        const MaskValues& mask = *context.surface->mask;
        const CopyArea area =
            clipped({dx, dy, sx, sy, width, height}, layer.width, layer.height, mask.width, mask.height);
        for (int j = 0; j < area.height; ++j)
            std::copy_n(mask.row(area.sy + j) + area.sx, std::max(0, area.width),
                        layer.row(area.dy + j) + area.dx);
    });
}
