// Sections 9.1, 9.2 and 9.4: paint objects.

#include "api/openvg/draw/draw_path.hpp"
#include "api/openvg/image/images.hpp"
#include "api/openvg/state/context.hpp"

using namespace vtm::openvg;

VGPaint vgCreatePaint(void) {
    return callOr(VG_INVALID_HANDLE,
                  [](Context& context) { return context.objects->add(std::make_shared<Paint>()); });
}

void vgDestroyPaint(VGPaint paint) {
    call([&](Context& context) { context.objects->destroy<Paint>(paint); });
}

void vgSetPaint(VGPaint handle, VGbitfield paintModes) {
    call([&](Context& context) {
        const std::shared_ptr<Paint> paint =
            handle == VG_INVALID_HANDLE ? nullptr : context.objects->get<Paint>(handle);
        requirePaintModes(paintModes);
        if (paintModes & VG_FILL_PATH)
            context.state.fillPaint = paint;
        if (paintModes & VG_STROKE_PATH)
            context.state.strokePaint = paint;
    });
}

VGPaint vgGetPaint(VGPaintMode paintMode) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        require(paintMode == VG_FILL_PATH || paintMode == VG_STROKE_PATH);
        const std::shared_ptr<Paint>& paint =
            paintMode == VG_FILL_PATH ? context.state.fillPaint : context.state.strokePaint;
        return paint ? paint->handle : VG_INVALID_HANDLE;
    });
}

void vgSetColor(VGPaint handle, VGuint rgba) {
    call([&](Context& context) {
        const std::shared_ptr<Paint> paint = context.objects->get<Paint>(handle);
        for (unsigned c = 0; c < 4; ++c)
            paint->color[c] = float((rgba >> (24 - 8 * c)) & 255) / 255.0f;
    });
}

VGuint vgGetColor(VGPaint handle) {
    return callOr(VGuint(0), [&](Context& context) {
        const std::shared_ptr<Paint> paint = context.objects->get<Paint>(handle);
        VGuint rgba = 0;
        for (const VGfloat v : paint->color)
            rgba = rgba << 8 | VGuint(std::min(std::max(0.0f, v), 1.0f) * 255.0f + 0.5f);
        return rgba;
    });
}

void vgPaintPattern(VGPaint handle, VGImage pattern) {
    call([&](Context& context) {
        const std::shared_ptr<Paint> paint = context.objects->get<Paint>(handle);
        paint->pattern = UsedImage(pattern == VG_INVALID_HANDLE ? nullptr : freeImage(context, pattern));
    });
}
