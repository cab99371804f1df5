// Section 5.3: parameters of objects; those of paints are section 9.1.3.

#include <VG/vgext.h>

#include "api/openvg/state/context.hpp"
#include "api/openvg/state/numbers.hpp"

using namespace vtm::openvg;

namespace {

bool isVectorType(VGint type) {
    return type == VG_PAINT_COLOR || type == VG_PAINT_COLOR_RAMP_STOPS || type == VG_PAINT_LINEAR_GRADIENT ||
           type == VG_PAINT_RADIAL_GRADIENT || type == VG_COLOR_MATRIX_NDS;
}

Values getFrom(const Paint& paint, VGint type) {
    switch (type) {
        case VG_PAINT_TYPE:
            return {double(paint.type)};
        case VG_PAINT_COLOR:
            return toValues(paint.color);
        case VG_PAINT_COLOR_RAMP_SPREAD_MODE:
            return {double(paint.spread)};
        case VG_PAINT_COLOR_RAMP_PREMULTIPLIED:
            return {double(paint.rampPremultiplied)};
        case VG_PAINT_COLOR_RAMP_STOPS:
            return toValues(paint.stops);
        case VG_PAINT_LINEAR_GRADIENT:
            return toValues(paint.linear);
        case VG_PAINT_RADIAL_GRADIENT:
            return toValues(paint.radial);
        case VG_PAINT_PATTERN_TILING_MODE:
            return {double(paint.tiling)};
        case VG_PAINT_COLOR_RAMP_LINEAR_NDS:
            return {double(paint.rampLinear)};
        case VG_COLOR_MATRIX_NDS:
            return toValues(paint.colorMatrix);
        case VG_PAINT_COLOR_TRANSFORM_LINEAR_NDS:
            return {double(paint.transformLinear)};
        default:
            throw Error(VG_ILLEGAL_ARGUMENT_ERROR);
    }
}

Values getFrom(const Path& path, VGint type) {
    switch (type) {
        case VG_PATH_FORMAT:
            return {double(VG_PATH_FORMAT_STANDARD)};
        case VG_PATH_DATATYPE:
            return {double(path.data.datatype())};
        case VG_PATH_SCALE:
            return {double(path.data.scale())};
        case VG_PATH_BIAS:
            return {double(path.data.bias())};
        case VG_PATH_NUM_SEGMENTS:
            return {double(path.data.commands().size())};
        case VG_PATH_NUM_COORDS:
            return {double(path.data.coordinates())};
        default:
            throw Error(VG_ILLEGAL_ARGUMENT_ERROR);
    }
}

Values getFrom(const Image& image, VGint type) {
    switch (type) {
        case VG_IMAGE_FORMAT:
            return {double(image.formatName)};
        case VG_IMAGE_WIDTH:
            return {double(image.width())};
        case VG_IMAGE_HEIGHT:
            return {double(image.height())};
        default:
            throw Error(VG_ILLEGAL_ARGUMENT_ERROR);
    }
}

Values getFrom(const Font& font, VGint type) {
    require(type == VG_FONT_NUM_GLYPHS);
    return {double(font.glyphs.size())};
}

Values get(const Context& context, VGHandle handle, VGint type) {
    const std::shared_ptr<Object> object = context.objects->get<Object>(handle);
    if (const auto* paint = dynamic_cast<const Paint*>(object.get()))
        return getFrom(*paint, type);
    if (const auto* path = dynamic_cast<const Path*>(object.get()))
        return getFrom(*path, type);
    if (const auto* image = dynamic_cast<const Image*>(object.get()))
        return getFrom(*image, type);
    if (const auto* font = dynamic_cast<const Font*>(object.get()))
        return getFrom(*font, type);
    throw Error(VG_ILLEGAL_ARGUMENT_ERROR);  // mask layers have none
}

void setIn(Paint& paint, VGint type, const Values& v) {
    switch (type) {
        case VG_PAINT_TYPE:
            paint.type = VGPaintType(toEnumerator(v[0], VG_PAINT_TYPE_COLOR, VG_PAINT_TYPE_PATTERN));
            break;
        case VG_PAINT_COLOR:
            paint.color = toFloats<4>(v);
            break;
        case VG_PAINT_COLOR_RAMP_SPREAD_MODE:
            paint.spread = VGColorRampSpreadMode(
                toEnumerator(v[0], VG_COLOR_RAMP_SPREAD_PAD, VG_COLOR_RAMP_SPREAD_REFLECT));
            break;
        case VG_PAINT_COLOR_RAMP_PREMULTIPLIED:
            paint.rampPremultiplied = toInt(v[0]) != 0;
            break;
        case VG_PAINT_COLOR_RAMP_STOPS: {
            require(v.size() % 5 == 0);
            const std::size_t kept = std::min(v.size(), 5 * std::size_t(maxColorRampStops));
            paint.stops.resize(kept);
            std::transform(v.begin(), v.begin() + std::ptrdiff_t(kept), paint.stops.begin(), toFloat);
            break;
        }
        case VG_PAINT_LINEAR_GRADIENT:
            paint.linear = toFloats<4>(v);
            break;
        case VG_PAINT_RADIAL_GRADIENT:
            paint.radial = toFloats<5>(v);
            break;
        case VG_PAINT_COLOR_RAMP_LINEAR_NDS:
            paint.rampLinear = toInt(v[0]) != 0;
            break;
        case VG_COLOR_MATRIX_NDS:
            paint.colorMatrix = toFloats<20>(v);
            break;
        case VG_PAINT_COLOR_TRANSFORM_LINEAR_NDS:
            paint.transformLinear = toInt(v[0]) != 0;
            break;
        default:
            paint.tiling = VGTilingMode(toEnumerator(v[0], VG_TILE_FILL, VG_TILE_REFLECT));
            break;
    }
}

void set(Context& context, VGHandle handle, VGint type, const Values& v) {
    get(context, handle, type);  // throws for what is no parameter of the object
    require(isVectorType(type) || v.size() == 1);
    // All that other objects have can only be read.
    if (const std::shared_ptr<Paint> paint = context.objects->find<Paint>(handle))
        setIn(*paint, type, v);
}

template <class T>
void setScalar(VGHandle object, VGint type, T value) {
    call([&](Context& context) {
        context.objects->get<Object>(object);
        require(!isVectorType(type));
        set(context, object, type, {double(value)});
    });
}

template <class T>
void setVector(VGHandle object, VGint type, VGint count, const T* values) {
    call([&](Context& context) {
        context.objects->get<Object>(object);
        set(context, object, type, given(count, values));
    });
}

double getScalar(const Context& context, VGHandle object, VGint type) {
    const Values values = get(context, object, type);
    require(!isVectorType(type));
    return values[0];
}

}  // namespace

void vgSetParameterf(VGHandle object, VGint type, VGfloat value) { setScalar(object, type, value); }
void vgSetParameteri(VGHandle object, VGint type, VGint value) { setScalar(object, type, value); }
void vgSetParameterfv(VGHandle object, VGint type, VGint count, const VGfloat* values) {
    setVector(object, type, count, values);
}
void vgSetParameteriv(VGHandle object, VGint type, VGint count, const VGint* values) {
    setVector(object, type, count, values);
}

VGfloat vgGetParameterf(VGHandle object, VGint type) {
    return callOr(VGfloat(0), [&](Context& context) { return toFloat(getScalar(context, object, type)); });
}

VGint vgGetParameteri(VGHandle object, VGint type) {
    return callOr(0, [&](Context& context) { return toInt(getScalar(context, object, type)); });
}

VGint vgGetParameterVectorSize(VGHandle object, VGint type) {
    return callOr(0, [&](Context& context) { return VGint(get(context, object, type).size()); });
}

void vgGetParameterfv(VGHandle object, VGint type, VGint count, VGfloat* values) {
    call([&](Context& context) { store(get(context, object, type), count, values); });
}

void vgGetParameteriv(VGHandle object, VGint type, VGint count, VGint* values) {
    call([&](Context& context) { store(get(context, object, type), count, values); });
}
