// Sections 5.1 and 5.2: parameters of the context.

#include <VG/vgext.h>

#include "api/openvg/state/context.hpp"
#include "api/openvg/state/numbers.hpp"

using namespace vtm::openvg;

namespace {

bool isVector(VGint type) {
    switch (type) {
        case VG_SCISSOR_RECTS:
        case VG_COLOR_TRANSFORM_VALUES:
        case VG_STROKE_DASH_PATTERN:
        case VG_TILE_FILL_COLOR:
        case VG_CLEAR_COLOR:
        case VG_GLYPH_ORIGIN:
        case VG_CLIP_LINES_NDS:
            return true;
        default:
            return false;
    }
}

Values getOfExtensions(const State& s, VGint type) {
    switch (type) {
        case VG_MAX_AVERAGE_BLUR_DIMENSION_KHR:
            return {double(maxAverageBlurDimension)};
        case VG_AVERAGE_BLUR_DIMENSION_RESOLUTION_KHR:
            return {-1.0};  // all bits of a float
        case VG_MAX_AVERAGE_BLUR_ITERATIONS_KHR:
            return {double(maxAverageBlurIterations)};
        case VG_CLIP_MODE_NDS:
            return {double(s.clipMode)};
        case VG_CLIP_LINES_NDS:
            return toValues(s.clipLines);
        case VG_MAX_CLIP_LINES_NDS:
            return {double(maxClipLines)};
        default:
            throw Error(VG_ILLEGAL_ARGUMENT_ERROR);
    }
}

Values get(const State& s, VGint type) {
    switch (type) {
        case VG_MATRIX_MODE:
            return {double(s.matrixMode)};
        case VG_FILL_RULE:
            return {double(s.fillRule)};
        case VG_IMAGE_QUALITY:
            return {double(s.imageQuality)};
        case VG_RENDERING_QUALITY:
            return {double(s.renderingQuality)};
        case VG_BLEND_MODE:
            return {double(s.blendMode)};
        case VG_IMAGE_MODE:
            return {double(s.imageMode)};
        case VG_SCISSOR_RECTS:
            return toValues(s.scissorRects);
        case VG_COLOR_TRANSFORM:
            return {double(s.colorTransform)};
        case VG_COLOR_TRANSFORM_VALUES:
            return toValues(s.colorTransformValues);
        case VG_STROKE_LINE_WIDTH:
            return {double(s.lineWidth)};
        case VG_STROKE_CAP_STYLE:
            return {double(s.capStyle)};
        case VG_STROKE_JOIN_STYLE:
            return {double(s.joinStyle)};
        case VG_STROKE_MITER_LIMIT:
            return {double(s.miterLimit)};
        case VG_STROKE_DASH_PATTERN:
            return toValues(s.dashPattern);
        case VG_STROKE_DASH_PHASE:
            return {double(s.dashPhase)};
        case VG_STROKE_DASH_PHASE_RESET:
            return {double(s.dashPhaseReset)};
        case VG_TILE_FILL_COLOR:
            return toValues(s.tileFillColor);
        case VG_CLEAR_COLOR:
            return toValues(s.clearColor);
        case VG_GLYPH_ORIGIN:
            return toValues(s.glyphOrigin);
        case VG_MASKING:
            return {double(s.masking)};
        case VG_SCISSORING:
            return {double(s.scissoring)};
        case VG_PIXEL_LAYOUT:
            return {double(s.pixelLayout)};
        case VG_SCREEN_LAYOUT:
            return {double(VG_PIXEL_LAYOUT_UNKNOWN)};
        case VG_FILTER_FORMAT_LINEAR:
            return {double(s.filterFormatLinear)};
        case VG_FILTER_FORMAT_PREMULTIPLIED:
            return {double(s.filterFormatPremultiplied)};
        case VG_FILTER_CHANNEL_MASK:
            return {double(VGint(s.filterChannelMask))};
        case VG_MAX_SCISSOR_RECTS:
            return {double(maxScissorRects)};
        case VG_MAX_DASH_COUNT:
            return {double(maxDashCount)};
        case VG_MAX_KERNEL_SIZE:
            return {double(maxKernelSize)};
        case VG_MAX_SEPARABLE_KERNEL_SIZE:
            return {double(maxSeparableKernelSize)};
        case VG_MAX_COLOR_RAMP_STOPS:
            return {double(maxColorRampStops)};
        case VG_MAX_IMAGE_WIDTH:
        case VG_MAX_IMAGE_HEIGHT:
            return {double(maxImageSide)};
        case VG_MAX_IMAGE_PIXELS:
            return {double(maxImagePixels)};
        case VG_MAX_IMAGE_BYTES:
            return {double(maxImageBytes)};
        case VG_MAX_FLOAT:
            return {double(maxFloat)};
        case VG_MAX_GAUSSIAN_STD_DEVIATION:
            return {double(maxGaussianStdDeviation)};
        default:
            require(s.knowsExtensions);
            return getOfExtensions(s, type);
    }
}

/// Keeps the first `maximum` of them.
template <class T, class Convert>
std::vector<T> firstOf(std::span<const double> values, std::size_t maximum, Convert&& convert) {
    std::vector<T> kept(std::min(values.size(), maximum));
    std::transform(values.begin(), values.begin() + std::ptrdiff_t(kept.size()), kept.begin(), convert);
    return kept;
}

void set(State& s, VGint type, const Values& v) {
    require(isVector(type) || v.size() == 1);
    switch (type) {
        case VG_MATRIX_MODE:
            s.matrixMode =
                toEnumerator(v[0], VG_MATRIX_PATH_USER_TO_SURFACE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
            break;
        case VG_FILL_RULE:
            s.fillRule = toEnumerator(v[0], VG_EVEN_ODD, VG_NON_ZERO);
            break;
        case VG_IMAGE_QUALITY: {
            const VGint quality = toInt(v[0]);
            require(quality == VG_IMAGE_QUALITY_NONANTIALIASED || quality == VG_IMAGE_QUALITY_FASTER ||
                    quality == VG_IMAGE_QUALITY_BETTER);
            s.imageQuality = quality;
            break;
        }
        case VG_RENDERING_QUALITY:
            s.renderingQuality =
                toEnumerator(v[0], VG_RENDERING_QUALITY_NONANTIALIASED, VG_RENDERING_QUALITY_BETTER);
            break;
        case VG_BLEND_MODE:
            s.blendMode = toInt(v[0]) >= VG_BLEND_OVERLAY_KHR
                              ? toEnumerator(v[0], VG_BLEND_OVERLAY_KHR, VG_BLEND_XOR_KHR)
                              : toEnumerator(v[0], VG_BLEND_SRC, VG_BLEND_ADDITIVE);
            break;
        case VG_IMAGE_MODE:
            s.imageMode = toInt(v[0]) == VG_DRAW_IMAGE_COLOR_MATRIX_NDS
                              ? VGint(VG_DRAW_IMAGE_COLOR_MATRIX_NDS)
                              : toEnumerator(v[0], VG_DRAW_IMAGE_NORMAL, VG_DRAW_IMAGE_STENCIL);
            break;
        case VG_SCISSOR_RECTS:
            require(v.size() % 4 == 0);
            s.scissorRects = firstOf<VGint>(v, 4 * std::size_t(maxScissorRects), toInt);
            break;
        case VG_COLOR_TRANSFORM:
            s.colorTransform = toInt(v[0]) != 0;
            break;
        case VG_COLOR_TRANSFORM_VALUES:
            s.colorTransformValues = toFloats<8>(v);
            break;
        case VG_STROKE_LINE_WIDTH:
            s.lineWidth = toFloat(v[0]);
            break;
        case VG_STROKE_CAP_STYLE:
            s.capStyle = toEnumerator(v[0], VG_CAP_BUTT, VG_CAP_SQUARE);
            break;
        case VG_STROKE_JOIN_STYLE:
            s.joinStyle = toEnumerator(v[0], VG_JOIN_MITER, VG_JOIN_BEVEL);
            break;
        case VG_STROKE_MITER_LIMIT:
            s.miterLimit = toFloat(v[0]);
            break;
        case VG_STROKE_DASH_PATTERN:
            s.dashPattern = firstOf<VGfloat>(v, std::size_t(maxDashCount), toFloat);
            break;
        case VG_STROKE_DASH_PHASE:
            s.dashPhase = toFloat(v[0]);
            break;
        case VG_STROKE_DASH_PHASE_RESET:
            s.dashPhaseReset = toInt(v[0]) != 0;
            break;
        case VG_TILE_FILL_COLOR:
            s.tileFillColor = toFloats<4>(v);
            break;
        case VG_CLEAR_COLOR:
            s.clearColor = toFloats<4>(v);
            break;
        case VG_GLYPH_ORIGIN:
            s.glyphOrigin = toFloats<2>(v);
            break;
        case VG_MASKING:
            s.masking = toInt(v[0]) != 0;
            break;
        case VG_SCISSORING:
            s.scissoring = toInt(v[0]) != 0;
            break;
        case VG_PIXEL_LAYOUT:
            s.pixelLayout = toEnumerator(v[0], VG_PIXEL_LAYOUT_UNKNOWN, VG_PIXEL_LAYOUT_BGR_HORIZONTAL);
            break;
        case VG_FILTER_FORMAT_LINEAR:
            s.filterFormatLinear = toInt(v[0]) != 0;
            break;
        case VG_FILTER_FORMAT_PREMULTIPLIED:
            s.filterFormatPremultiplied = toInt(v[0]) != 0;
            break;
        case VG_FILTER_CHANNEL_MASK:
            s.filterChannelMask = VGbitfield(toInt(v[0]));
            break;
        case VG_CLIP_MODE_NDS:
            require(s.knowsExtensions);
            s.clipMode = toEnumerator(v[0], VG_CLIPMODE_NONE_NDS, VG_CLIPMODE_CULL_NDS);
            break;
        case VG_CLIP_LINES_NDS:
            require(s.knowsExtensions && v.size() % 3 == 0);
            s.clipLines = firstOf<VGfloat>(v, 3 * std::size_t(maxClipLines), toFloat);
            break;
        default:
            get(s, type);  // what can be read but not set stays as it is, what cannot be read is illegal
            break;
    }
}

template <class T>
void setScalar(VGParamType type, T value) {
    call([&](Context& context) {
        require(!isVector(type));
        set(context.state, type, {double(value)});
    });
}

template <class T>
void setVector(VGParamType type, VGint count, const T* values) {
    call([&](Context& context) { set(context.state, type, given(count, values)); });
}

double getScalar(const Context& context, VGParamType type) {
    require(!isVector(type));
    return get(context.state, type)[0];
}

}  // namespace

void vgSetf(VGParamType type, VGfloat value) { setScalar(type, value); }
void vgSeti(VGParamType type, VGint value) { setScalar(type, value); }
void vgSetfv(VGParamType type, VGint count, const VGfloat* values) { setVector(type, count, values); }
void vgSetiv(VGParamType type, VGint count, const VGint* values) { setVector(type, count, values); }

VGfloat vgGetf(VGParamType type) {
    return callOr(VGfloat(0), [&](Context& context) { return toFloat(getScalar(context, type)); });
}

VGint vgGeti(VGParamType type) {
    return callOr(0, [&](Context& context) { return toInt(getScalar(context, type)); });
}

VGint vgGetVectorSize(VGParamType type) {
    return callOr(0, [&](Context& context) { return VGint(get(context.state, type).size()); });
}

void vgGetfv(VGParamType type, VGint count, VGfloat* values) {
    call([&](Context& context) { store(get(context.state, type), count, values); });
}

void vgGetiv(VGParamType type, VGint count, VGint* values) {
    call([&](Context& context) { store(get(context.state, type), count, values); });
}

// Sections 14 and 15.3: hardware queries and strings.

VGHardwareQueryResult vgHardwareQuery(VGHardwareQueryType key, VGint setting) {
    return callOr(VG_HARDWARE_UNACCELERATED, [&](Context&) {
        require(key == VG_IMAGE_FORMAT_QUERY || key == VG_PATH_DATATYPE_QUERY);
        if (key == VG_IMAGE_FORMAT_QUERY)
            require(imageFormat(setting).has_value());
        else
            require(setting >= VG_PATH_DATATYPE_S_8 && setting <= VG_PATH_DATATYPE_F);
        return VG_HARDWARE_UNACCELERATED;
    });
}

const VGubyte* vgGetString(VGStringID name) {
    return callOr(static_cast<const VGubyte*>(nullptr), [&](Context& context) {
        const auto text = [](const char* s) { return reinterpret_cast<const VGubyte*>(s); };
        switch (name) {
            case VG_VENDOR:
                return text("VTM");
            case VG_RENDERER:
                return text("VTM vector texture maps");
            case VG_VERSION:
                return text("1.1");
            case VG_EXTENSIONS:
                context.state.knowsExtensions = true;
                return text(
                    "VG_KHR_iterative_average_blur VG_KHR_advanced_blending VG_KHR_parametric_filter "
                    "VG_NDS_paint_generation VG_NDS_projective_geometry VG_KHR_EGL_image");
            default:
                return static_cast<const VGubyte*>(nullptr);
        }
    });
}
