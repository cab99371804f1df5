// VG_KHR_parametric_filter: VGU's effects, each as its text's pseudo-code makes it of the API's functions.

#include <cmath>
#include <span>
#include <vector>

#include <glm/trigonometric.hpp>

#include <VG/vgext.h>

#include "api/openvg/state/context.hpp"

using namespace vtm::openvg;

namespace {

/// Numbers of a stop of a colour ramp.
constexpr std::size_t stopSize = 5;
constexpr VGfloat transparent[stopSize] = {};

/// A paint for the length of a call.
class OwnPaint {
public:
    explicit OwnPaint(VGuint rgba) { vgSetColor(handle_, rgba); }
    explicit OwnPaint(std::span<const VGfloat> stops) {
        vgSetParameterfv(handle_, VG_PAINT_COLOR_RAMP_STOPS, VGint(stops.size()), stops.data());
        vgSetParameteri(handle_, VG_PAINT_COLOR_RAMP_SPREAD_MODE, VG_COLOR_RAMP_SPREAD_PAD);
        vgSetParameteri(handle_, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, VG_FALSE);
        vgSetParameteri(handle_, VG_PAINT_TYPE, VG_PAINT_TYPE_LINEAR_GRADIENT);
    }
    ~OwnPaint() { vgDestroyPaint(handle_); }
    OwnPaint(const OwnPaint&) = delete;
    OwnPaint& operator=(const OwnPaint&) = delete;

    operator VGPaint() const { return handle_; }

private:
    VGPaint handle_ = vgCreatePaint();
};

struct Blur {
    VGfloat dimX, dimY;
    VGuint iterative;
    VGbitfield allowedQuality;
};

struct Offset {
    VGfloat x = 0, y = 0;

    Offset() = default;
    Offset(VGfloat distance, VGfloat angle)
        : x(distance * std::cos(glm::radians(angle))), y(distance * std::sin(glm::radians(angle))) {}
    Offset operator-() const {
        Offset turned;
        turned.x = -x;
        turned.y = -y;
        return turned;
    }
};

void filter(VGImage dst, VGImage src, const Blur& blur, VGfloat strength, Offset offset, VGbitfield flags,
            VGPaint highlight, VGPaint shadow) {
    const VGint width = vgGetParameteri(src, VG_IMAGE_WIDTH), height = vgGetParameteri(src, VG_IMAGE_HEIGHT);
    const VGImage blurred = vgCreateImage(VG_A_8, width, height, blur.allowedQuality);
    vgIterativeAverageBlurKHR(blurred, src, blur.dimX, blur.dimY, blur.iterative, VG_TILE_PAD);
    vgParametricFilterKHR(dst, src, blurred, strength, offset.x, offset.y, flags, highlight, shadow);
    vgDestroyImage(blurred);
}

/// Runs what calls the API; the first error of its calls is the result.
template <class Effect>
VGUErrorCode apply(Effect&& effect) {
    return callOr(VGU_BAD_HANDLE_ERROR, [&](Context& context) {
        context.error = VG_NO_ERROR;
        call([&](Context&) { effect(); });
        switch (std::exchange(context.error, VG_NO_ERROR)) {
            case VG_NO_ERROR:
                return VGU_NO_ERROR;
            case VG_BAD_HANDLE_ERROR:
                return VGU_BAD_HANDLE_ERROR;
            case VG_IMAGE_IN_USE_ERROR:
                return VGUErrorCode(VGU_IMAGE_IN_USE_ERROR);
            case VG_OUT_OF_MEMORY_ERROR:
                return VGU_OUT_OF_MEMORY_ERROR;
            default:
                return VGU_ILLEGAL_ARGUMENT_ERROR;
        }
    });
}

void requireStops(VGuint count, const VGfloat* stops) {
    require(count <= VGuint(VG_MAXINT) / stopSize);
    require(count == 0 || (stops != nullptr && isAligned(stops)));
}

}  // namespace

VGUErrorCode vguDropShadowKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY, VGuint iterative,
                              VGfloat strength, VGfloat distance, VGfloat angle, VGbitfield filterFlags,
                              VGbitfield allowedQuality, VGuint shadowColorRGBA) {
    return apply([&] {
        const OwnPaint shadow(shadowColorRGBA);
        filter(dst, src, {dimX, dimY, iterative, allowedQuality}, strength, Offset(distance, angle),
               filterFlags, VG_INVALID_HANDLE, shadow);
    });
}

VGUErrorCode vguGlowKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY, VGuint iterative,
                        VGfloat strength, VGbitfield filterFlags, VGbitfield allowedQuality,
                        VGuint glowColorRGBA) {
    return apply([&] {
        const OwnPaint glow(glowColorRGBA);
        filter(dst, src, {dimX, dimY, iterative, allowedQuality}, strength, Offset(), filterFlags,
               VG_INVALID_HANDLE, glow);
    });
}

VGUErrorCode vguBevelKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY, VGuint iterative,
                         VGfloat strength, VGfloat distance, VGfloat angle, VGbitfield filterFlags,
                         VGbitfield allowedQuality, VGuint highlightColorRGBA, VGuint shadowColorRGBA) {
    return apply([&] {
        const OwnPaint highlight(highlightColorRGBA), shadow(shadowColorRGBA);
        filter(dst, src, {dimX, dimY, iterative, allowedQuality}, strength, Offset(distance, angle),
               filterFlags, highlight, shadow);
    });
}

VGUErrorCode vguGradientGlowKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY, VGuint iterative,
                                VGfloat strength, VGfloat distance, VGfloat angle, VGbitfield filterFlags,
                                VGbitfield allowedQuality, VGuint stopsCount,
                                const VGfloat* glowColorRampStops) {
    return apply([&] {
        requireStops(stopsCount, glowColorRampStops);
        const OwnPaint glow(std::span(glowColorRampStops, stopsCount * stopSize));
        filter(dst, src, {dimX, dimY, iterative, allowedQuality}, strength, -Offset(distance, angle),
               filterFlags, glow, VG_INVALID_HANDLE);
    });
}

VGUErrorCode vguGradientBevelKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY, VGuint iterative,
                                 VGfloat strength, VGfloat distance, VGfloat angle, VGbitfield filterFlags,
                                 VGbitfield allowedQuality, VGuint stopsCount,
                                 const VGfloat* bevelColorRampStops) {
    return apply([&] {
        requireStops(stopsCount, bevelColorRampStops);
        // The ramp's halves, both from its middle outwards. A middle that is no stop is transparent.
        std::vector<VGfloat> shadowStops, highlightStops;
        const auto add = [](std::vector<VGfloat>& stops, VGfloat offset, const VGfloat* stop) {
            stops.push_back(offset);
            stops.insert(stops.end(), stop + 1, stop + stopSize);
        };
        const auto stop = [&](std::size_t i) { return bevelColorRampStops + stopSize * i; };
        std::size_t middle = 0;
        while (middle < stopsCount && stop(middle)[0] < 0.5f)
            ++middle;
        if (middle < stopsCount && stop(middle)[0] == 0.5f) {
            add(shadowStops, 0, stop(middle));
        } else {
            add(shadowStops, 0, transparent);
            add(highlightStops, 0, transparent);
        }
        for (std::size_t i = middle; i-- > 0;)
            add(shadowStops, 2 * (0.5f - stop(i)[0]), stop(i));
        for (std::size_t i = middle; i < stopsCount; ++i)
            add(highlightStops, 2 * (stop(i)[0] - 0.5f), stop(i));
        const OwnPaint highlight(highlightStops), shadow(shadowStops);
        filter(dst, src, {dimX, dimY, iterative, allowedQuality}, strength, Offset(distance, angle),
               filterFlags, highlight, shadow);
    });
}
