// Section 4.1, and the ERRORS paragraph of every function, in the specification's order.

#include <cmath>
#include <limits>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

constexpr VGErrorCode bad = VG_BAD_HANDLE_ERROR, illegal = VG_ILLEGAL_ARGUMENT_ERROR,
                      inUse = VG_IMAGE_IN_USE_ERROR, incapable = VG_PATH_CAPABILITY_ERROR,
                      noFormat = VG_UNSUPPORTED_IMAGE_FORMAT_ERROR;
constexpr VGHandle none = VG_INVALID_HANDLE, unknown = 0xfffffff0;
constexpr VGint greatest = std::numeric_limits<VGint>::max();

template <class T>
T* misaligned(T* p) {
    return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(p) + 1);
}

/// One object of each kind, a destroyed one, and an image that is drawn into.
class ErrorsTest : public VgTest {
protected:
    ErrorsTest() {
        path = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS}, {0, 0, 1, 1});
        image = newImage(VG_sRGBA_8888, 4, 4);
        other = newImage(VG_sRGBA_8888, 4, 4);
        paint = vgCreatePaint();
        font = vgCreateFont(0);
        layer = vgCreateMaskLayer(4, 4);
        dead = vgCreatePaint();
        vgDestroyPaint(dead);
        incapablePath = vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, 0);
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    }
    /// Another image becomes what is drawn into.
    VGImage target() {
        const VGImage drawn = newImage(VG_sRGBA_8888, 4, 4);
        VtmSurface* const inImage = vtmCreateImageSurface(context, drawn, 0, nullptr);
        EXPECT_TRUE(vtmMakeCurrent(context, inImage));
        vtmDestroySurface(inImage);
        return drawn;
    }

    VGPath path, incapablePath;
    VGImage image, other;
    VGPaint paint;
    VGFont font;
    VGMaskLayer layer;
    VGHandle dead;
    std::array<VGfloat, 32> f{};
    std::array<VGint, 32> i{};
    std::array<VGubyte, 256> bytes{};
};

TEST_F(ErrorsTest, TheOldestIsKeptUntilAskedFor) {
    vgDestroyPath(unknown);
    vgSeti(VG_FILL_RULE, 0);
    vgCreatePath(1, VG_PATH_DATATYPE_F, 1, 0, 0, 0, 0);
    EXPECT_EQ(vgGetError(), bad);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ErrorsTest, BelongToTheirContext) {
    vgDestroyPath(unknown);
    EXPECT_TRUE(vtmMakeCurrent(nullptr, nullptr));
    EXPECT_EQ(vgGetError(), VG_NO_CONTEXT_ERROR);
    EXPECT_TRUE(vtmMakeCurrent(context, surface));
    EXPECT_EQ(vgGetError(), bad);
}

TEST_F(ErrorsTest, WithoutAContextNothingHappens) {
    vtmMakeCurrent(nullptr, nullptr);
    EXPECT_EQ(newPath(), none);
    EXPECT_EQ(vgCreatePaint(), none);
    EXPECT_EQ(vgGetString(VG_VENDOR), nullptr);
    EXPECT_EQ(vguLine(path, 0, 0, 1, 1), VGU_BAD_HANDLE_ERROR);
    vgFlush();
    vgFinish();
    vgSetf(VG_STROKE_LINE_WIDTH, 7);
    vtmMakeCurrent(context, surface);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    EXPECT_EQ(vgGetf(VG_STROKE_LINE_WIDTH), 1);
}

TEST_F(ErrorsTest, Section5Parameters) {
    const auto no = VGParamType(0x1234);
    EXPECT_VG_ERROR(illegal, vgSetf(no, 0));
    EXPECT_VG_ERROR(illegal, vgSeti(VG_CLEAR_COLOR, 0));
    EXPECT_VG_ERROR(illegal, vgSetf(VG_STROKE_DASH_PATTERN, 0));
    EXPECT_VG_ERROR(illegal, vgSetfv(VG_STROKE_LINE_WIDTH, 2, f.data()));
    EXPECT_VG_ERROR(illegal, vgSetiv(VG_STROKE_LINE_WIDTH, 0, i.data()));
    EXPECT_VG_ERROR(illegal, vgSeti(VG_BLEND_MODE, VG_BLEND_ADDITIVE + 1));
    EXPECT_VG_ERROR(illegal, vgSeti(VG_IMAGE_QUALITY, 3));
    EXPECT_VG_ERROR(illegal, vgSetf(VG_FILL_RULE, VGfloat(VG_EVEN_ODD) - 1));
    EXPECT_VG_ERROR(illegal, vgSetfv(VG_CLEAR_COLOR, 4, nullptr));
    EXPECT_VG_ERROR(illegal, vgSetiv(VG_CLEAR_COLOR, 4, misaligned(i.data())));
    EXPECT_VG_ERROR(illegal, vgSetfv(VG_STROKE_DASH_PATTERN, -1, f.data()));
    EXPECT_VG_ERROR(illegal, vgSetfv(VG_CLEAR_COLOR, 3, f.data()));
    EXPECT_VG_ERROR(illegal, vgSetiv(VG_SCISSOR_RECTS, 6, i.data()));
    EXPECT_VG_ERROR(illegal, vgSetfv(VG_GLYPH_ORIGIN, 0, nullptr));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgSetfv(VG_STROKE_DASH_PATTERN, 0, nullptr));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgSetiv(VG_SCISSOR_RECTS, 0, nullptr));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgSeti(VG_MAX_DASH_COUNT, 1));

    EXPECT_VG_ERROR(illegal, vgGetf(no));
    EXPECT_VG_ERROR(illegal, vgGeti(VG_SCISSOR_RECTS));
    EXPECT_VG_ERROR(illegal, vgGetVectorSize(no));
    EXPECT_VG_ERROR(illegal, vgGetfv(VG_CLEAR_COLOR, 4, nullptr));
    EXPECT_VG_ERROR(illegal, vgGetiv(VG_CLEAR_COLOR, 4, misaligned(i.data())));
    EXPECT_VG_ERROR(illegal, vgGetfv(VG_CLEAR_COLOR, 0, f.data()));
    EXPECT_VG_ERROR(illegal, vgGetiv(VG_CLEAR_COLOR, 5, i.data()));
    EXPECT_VG_ERROR(illegal, vgGetfv(VG_STROKE_DASH_PATTERN, 1, f.data()));
}

TEST_F(ErrorsTest, Section5ObjectParameters) {
    EXPECT_VG_ERROR(bad, vgSetParameterf(dead, VG_PAINT_TYPE, 0));
    EXPECT_VG_ERROR(bad, vgSetParameteri(none, VG_PAINT_TYPE, 0));
    EXPECT_VG_ERROR(bad, vgSetParameterfv(unknown, VG_PAINT_COLOR, 4, nullptr));
    EXPECT_VG_ERROR(illegal, vgSetParameteri(paint, VG_PATH_FORMAT, 0));
    EXPECT_VG_ERROR(illegal, vgSetParameterf(paint, VG_PAINT_COLOR, 0));
    EXPECT_VG_ERROR(illegal, vgSetParameteriv(paint, VG_PAINT_TYPE, 2, i.data()));
    EXPECT_VG_ERROR(illegal, vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN + 1));
    EXPECT_VG_ERROR(illegal, vgSetParameterfv(paint, VG_PAINT_COLOR, 4, nullptr));
    EXPECT_VG_ERROR(illegal, vgSetParameterfv(paint, VG_PAINT_COLOR, 4, misaligned(f.data())));
    EXPECT_VG_ERROR(illegal, vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, 4, f.data()));
    EXPECT_VG_ERROR(illegal, vgSetParameteriv(paint, VG_PAINT_COLOR, -4, i.data()));
    EXPECT_VG_ERROR(illegal, vgSetParameterfv(paint, VG_PAINT_RADIAL_GRADIENT, 4, f.data()));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgSetParameteri(image, VG_IMAGE_WIDTH, 9));
    EXPECT_EQ(vgGetParameteri(image, VG_IMAGE_WIDTH), 4);

    EXPECT_VG_ERROR(bad, vgGetParameterf(dead, VG_PAINT_TYPE));
    EXPECT_VG_ERROR(bad, vgGetParameteri(none, VG_PAINT_TYPE));
    EXPECT_VG_ERROR(bad, vgGetParameterVectorSize(unknown, VG_PAINT_TYPE));
    EXPECT_VG_ERROR(illegal, vgGetParameterVectorSize(path, VG_PAINT_TYPE));
    EXPECT_VG_ERROR(illegal, vgGetParameterf(paint, VG_PAINT_COLOR));
    EXPECT_VG_ERROR(illegal, vgGetParameteri(layer, VG_IMAGE_WIDTH));
    EXPECT_VG_ERROR(illegal, vgGetParameterfv(paint, VG_PAINT_COLOR, 5, f.data()));
    EXPECT_VG_ERROR(illegal, vgGetParameteriv(paint, VG_PAINT_COLOR, 0, i.data()));
    EXPECT_VG_ERROR(illegal, vgGetParameterfv(paint, VG_PAINT_COLOR, 4, nullptr));
    EXPECT_VG_ERROR(illegal, vgGetParameteriv(paint, VG_PAINT_COLOR, 4, misaligned(i.data())));
}

TEST_F(ErrorsTest, Section6Matrices) {
    EXPECT_VG_ERROR(illegal, vgLoadMatrix(nullptr));
    EXPECT_VG_ERROR(illegal, vgLoadMatrix(misaligned(f.data())));
    EXPECT_VG_ERROR(illegal, vgGetMatrix(nullptr));
    EXPECT_VG_ERROR(illegal, vgGetMatrix(misaligned(f.data())));
    EXPECT_VG_ERROR(illegal, vgMultMatrix(nullptr));
    EXPECT_VG_ERROR(illegal, vgMultMatrix(misaligned(f.data())));
}

TEST_F(ErrorsTest, Section7Masks) {
    EXPECT_VG_ERROR(bad, vgMask(paint, VG_SET_MASK, 0, 0, 1, 1));
    EXPECT_VG_ERROR(bad, vgMask(none, VG_UNION_MASK, 0, 0, 0, 0));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgMask(none, VG_CLEAR_MASK, 0, 0, 1, 1));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgMask(dead, VG_FILL_MASK, -5, greatest, greatest, 1));
    EXPECT_VG_ERROR(illegal, vgMask(image, VGMaskOperation(VG_SUBTRACT_MASK + 1), 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgMask(image, VG_SET_MASK, 0, 0, 0, 1));
    EXPECT_VG_ERROR(illegal, vgMask(layer, VG_SET_MASK, 0, 0, 1, -1));

    EXPECT_VG_ERROR(bad, vgRenderToMask(image, VG_FILL_PATH, VG_SET_MASK));
    EXPECT_VG_ERROR(illegal, vgRenderToMask(path, 0, VG_SET_MASK));
    EXPECT_VG_ERROR(illegal, vgRenderToMask(path, 4, VG_SET_MASK));
    EXPECT_VG_ERROR(illegal, vgRenderToMask(path, VG_FILL_PATH, VGMaskOperation(0)));

    EXPECT_VG_ERROR(illegal, vgCreateMaskLayer(0, 1));
    EXPECT_VG_ERROR(illegal, vgCreateMaskLayer(1, -1));
    EXPECT_VG_ERROR(illegal, vgCreateMaskLayer(vgGeti(VG_MAX_IMAGE_WIDTH) + 1, 1));
    EXPECT_VG_ERROR(illegal, vgCreateMaskLayer(1, vgGeti(VG_MAX_IMAGE_HEIGHT) + 1));
    EXPECT_VG_ERROR(bad, vgDestroyMaskLayer(image));
    EXPECT_VG_ERROR(bad, vgFillMaskLayer(image, 0, 0, 1, 1, 0));
    EXPECT_VG_ERROR(illegal, vgFillMaskLayer(layer, 0, 0, 1, 1, -0.1f));
    EXPECT_VG_ERROR(illegal, vgFillMaskLayer(layer, 0, 0, 1, 1, 1.1f));
    EXPECT_VG_ERROR(illegal, vgFillMaskLayer(layer, 0, 0, 1, 1, std::nanf("")));
    EXPECT_VG_ERROR(illegal, vgFillMaskLayer(layer, 0, 0, 0, 1, 0));
    EXPECT_VG_ERROR(illegal, vgFillMaskLayer(layer, -1, 0, 1, 1, 0));
    EXPECT_VG_ERROR(illegal, vgFillMaskLayer(layer, 1, 0, 4, 1, 0));
    EXPECT_VG_ERROR(illegal, vgFillMaskLayer(layer, greatest, 0, greatest, 1, 0));
    EXPECT_VG_ERROR(bad, vgCopyMask(path, 0, 0, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgCopyMask(layer, 0, 0, 0, 0, 1, 0));
    EXPECT_VG_ERROR(illegal, vgClear(0, 0, 0, 1));
    EXPECT_VG_ERROR(illegal, vgClear(0, 0, 1, -1));
}

TEST_F(ErrorsTest, Section8Paths) {
    EXPECT_VG_ERROR(VG_UNSUPPORTED_PATH_FORMAT_ERROR, vgCreatePath(1, VG_PATH_DATATYPE_F, 0, 0, 0, 0, 0));
    EXPECT_VG_ERROR(illegal, vgCreatePath(VG_PATH_FORMAT_STANDARD, VGPathDatatype(4), 1, 0, 0, 0, 0));
    EXPECT_VG_ERROR(illegal, vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 0, 0, 0, 0, 0));
    EXPECT_VG_ERROR(VG_NO_ERROR,
                    vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, -1, 0, -9, -9, ~0u));
    EXPECT_VG_ERROR(bad, vgClearPath(dead, 0));
    EXPECT_VG_ERROR(bad, vgDestroyPath(paint));
    EXPECT_VG_ERROR(bad, vgRemovePathCapabilities(image, 0));
    EXPECT_VG_ERROR(bad, vgGetPathCapabilities(none));

    EXPECT_VG_ERROR(bad, vgAppendPath(path, dead));
    EXPECT_VG_ERROR(bad, vgAppendPath(dead, path));
    EXPECT_VG_ERROR(incapable, vgAppendPath(path, incapablePath));
    EXPECT_VG_ERROR(incapable, vgAppendPath(incapablePath, path));

    const std::array<VGubyte, 2> lines{VG_LINE_TO_ABS, VG_LINE_TO_REL}, wrong{VG_LINE_TO_ABS, 26};
    EXPECT_VG_ERROR(bad, vgAppendPathData(dead, 1, lines.data(), f.data()));
    EXPECT_VG_ERROR(incapable, vgAppendPathData(incapablePath, 1, lines.data(), f.data()));
    EXPECT_VG_ERROR(illegal, vgAppendPathData(path, 1, nullptr, f.data()));
    EXPECT_VG_ERROR(illegal, vgAppendPathData(path, 1, lines.data(), nullptr));
    EXPECT_VG_ERROR(illegal, vgAppendPathData(path, 1, lines.data(), misaligned(f.data())));
    EXPECT_VG_ERROR(illegal, vgAppendPathData(path, 0, lines.data(), f.data()));
    EXPECT_VG_ERROR(illegal, vgAppendPathData(path, 2, wrong.data(), f.data()));
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), 2);

    EXPECT_VG_ERROR(bad, vgModifyPathCoords(dead, 0, 1, f.data()));
    EXPECT_VG_ERROR(incapable, vgModifyPathCoords(incapablePath, 0, 1, f.data()));
    EXPECT_VG_ERROR(illegal, vgModifyPathCoords(path, 0, 1, nullptr));
    EXPECT_VG_ERROR(illegal, vgModifyPathCoords(path, 0, 1, misaligned(f.data())));
    EXPECT_VG_ERROR(illegal, vgModifyPathCoords(path, -1, 1, f.data()));
    EXPECT_VG_ERROR(illegal, vgModifyPathCoords(path, 0, 0, f.data()));
    EXPECT_VG_ERROR(illegal, vgModifyPathCoords(path, 1, 2, f.data()));
    EXPECT_VG_ERROR(illegal, vgModifyPathCoords(path, greatest, greatest, f.data()));

    EXPECT_VG_ERROR(bad, vgTransformPath(dead, path));
    EXPECT_VG_ERROR(incapable, vgTransformPath(path, incapablePath));
    EXPECT_VG_ERROR(incapable, vgTransformPath(incapablePath, path));
    EXPECT_VG_ERROR(bad, vgInterpolatePath(path, dead, path, 0));
    EXPECT_VG_ERROR(incapable, vgInterpolatePath(incapablePath, path, path, 0));
    EXPECT_VG_ERROR(incapable, vgInterpolatePath(path, incapablePath, path, 0));
    EXPECT_VG_ERROR(incapable, vgInterpolatePath(path, path, incapablePath, 0));

    EXPECT_VG_ERROR(bad, vgPathLength(dead, 0, 1));
    EXPECT_VG_ERROR(incapable, vgPathLength(incapablePath, 0, 1));
    EXPECT_VG_ERROR(illegal, vgPathLength(path, -1, 1));
    EXPECT_VG_ERROR(illegal, vgPathLength(path, 0, 3));
    EXPECT_VG_ERROR(illegal, vgPathLength(path, 0, 0));
    EXPECT_EQ(vgPathLength(path, 0, 0), -1) << "section 8.6.10: -1 after an error";

    EXPECT_VG_ERROR(bad, vgPointAlongPath(dead, 0, 1, 0, &f[0], &f[1], &f[2], &f[3]));
    EXPECT_VG_ERROR(incapable, vgPointAlongPath(incapablePath, 0, 1, 0, &f[0], &f[1], nullptr, nullptr));
    EXPECT_VG_ERROR(incapable, vgPointAlongPath(incapablePath, 0, 1, 0, nullptr, nullptr, &f[0], &f[1]));
    EXPECT_VG_ERROR(illegal, vgPointAlongPath(path, 0, 3, 0, &f[0], &f[1], &f[2], &f[3]));
    EXPECT_VG_ERROR(illegal, vgPointAlongPath(path, 0, 1, 0, misaligned(&f[0]), &f[1], &f[2], &f[3]));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgPointAlongPath(path, 0, 2, 0, nullptr, nullptr, nullptr, nullptr));

    for (const auto query : {vgPathBounds, vgPathTransformedBounds}) {
        EXPECT_VG_ERROR(bad, query(dead, &f[0], &f[1], &f[2], &f[3]));
        EXPECT_VG_ERROR(incapable, query(incapablePath, &f[0], &f[1], &f[2], &f[3]));
        EXPECT_VG_ERROR(illegal, query(path, nullptr, &f[1], &f[2], &f[3]));
        EXPECT_VG_ERROR(illegal, query(path, &f[0], &f[1], &f[2], misaligned(&f[3])));
    }
    EXPECT_VG_ERROR(bad, vgDrawPath(image, VG_FILL_PATH));
    EXPECT_VG_ERROR(illegal, vgDrawPath(path, 0));
    EXPECT_VG_ERROR(illegal, vgDrawPath(path, 7));
}

TEST_F(ErrorsTest, Section9Paints) {
    EXPECT_VG_ERROR(bad, vgDestroyPaint(path));
    EXPECT_VG_ERROR(bad, vgSetPaint(image, VG_FILL_PATH));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgSetPaint(none, VG_FILL_PATH));
    EXPECT_VG_ERROR(illegal, vgSetPaint(paint, 0));
    EXPECT_VG_ERROR(illegal, vgSetPaint(paint, 8));
    EXPECT_VG_ERROR(illegal, vgGetPaint(VGPaintMode(VG_FILL_PATH | VG_STROKE_PATH)));
    EXPECT_VG_ERROR(bad, vgSetColor(dead, 0));
    EXPECT_VG_ERROR(bad, vgGetColor(path));
    EXPECT_VG_ERROR(bad, vgPaintPattern(path, image));
    EXPECT_VG_ERROR(bad, vgPaintPattern(paint, path));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgPaintPattern(paint, none));
}

TEST_F(ErrorsTest, Section10Images) {
    const auto no = VGImageFormat(15);
    const VGbitfield any = VG_IMAGE_QUALITY_FASTER;
    EXPECT_VG_ERROR(noFormat, vgCreateImage(no, 0, 0, 0));
    EXPECT_VG_ERROR(noFormat, vgCreateImage(VGImageFormat(VG_sRGB_565 | 1 << 6), 1, 1, any));
    EXPECT_VG_ERROR(noFormat, vgCreateImage(VGImageFormat(VG_A_8 | 1 << 7), 1, 1, any));
    EXPECT_VG_ERROR(illegal, vgCreateImage(VG_A_8, 0, 1, any));
    EXPECT_VG_ERROR(illegal, vgCreateImage(VG_A_8, 1, -1, any));
    EXPECT_VG_ERROR(illegal, vgCreateImage(VG_A_8, vgGeti(VG_MAX_IMAGE_WIDTH) + 1, 1, any));
    EXPECT_VG_ERROR(illegal, vgCreateImage(VG_A_8, 1, vgGeti(VG_MAX_IMAGE_HEIGHT) + 1, any));
    EXPECT_VG_ERROR(illegal, vgCreateImage(VG_A_8, 1, 1, 0));
    EXPECT_VG_ERROR(illegal, vgCreateImage(VG_A_8, 1, 1, 8));
    EXPECT_VG_ERROR(bad, vgDestroyImage(path));
    EXPECT_VG_ERROR(bad, vgClearImage(path, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgClearImage(image, 0, 0, 1, 0));

    EXPECT_VG_ERROR(bad, vgImageSubData(path, f.data(), 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(noFormat, vgImageSubData(image, f.data(), 0, no, 0, 0, 0, 0));
    EXPECT_VG_ERROR(illegal, vgImageSubData(image, f.data(), 0, VG_A_8, 0, 0, 0, 1));
    EXPECT_VG_ERROR(illegal, vgImageSubData(image, nullptr, 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgImageSubData(image, misaligned(f.data()), 0, VG_sRGBA_8888, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgImageSubData(image, misaligned(f.data()), 0, VG_sRGB_565, 0, 0, 1, 1));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgImageSubData(image, misaligned(f.data()), 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(bad, vgGetImageSubData(path, f.data(), 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(noFormat, vgGetImageSubData(image, f.data(), 0, no, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgGetImageSubData(image, nullptr, 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgGetImageSubData(image, f.data(), 0, VG_A_8, 0, 0, 1, -1));

    EXPECT_VG_ERROR(bad, vgChildImage(path, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgChildImage(image, -1, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgChildImage(image, 4, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgChildImage(image, 0, 0, 0, 1));
    EXPECT_VG_ERROR(illegal, vgChildImage(image, 1, 0, 4, 1));
    EXPECT_VG_ERROR(illegal, vgChildImage(image, 1, 0, greatest, 1));
    EXPECT_VG_ERROR(bad, vgGetParent(path));
    EXPECT_VG_ERROR(bad, vgCopyImage(path, 0, 0, image, 0, 0, 1, 1, VG_FALSE));
    EXPECT_VG_ERROR(bad, vgCopyImage(image, 0, 0, path, 0, 0, 1, 1, VG_FALSE));
    EXPECT_VG_ERROR(illegal, vgCopyImage(image, 0, 0, other, 0, 0, 1, 0, VG_FALSE));
    EXPECT_VG_ERROR(bad, vgDrawImage(path));
    EXPECT_VG_ERROR(bad, vgSetPixels(0, 0, path, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgSetPixels(0, 0, image, 0, 0, 0, 1));
    EXPECT_VG_ERROR(noFormat, vgWritePixels(f.data(), 0, no, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgWritePixels(nullptr, 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgWritePixels(f.data(), 0, VG_A_8, 0, 0, -1, 1));
    EXPECT_VG_ERROR(bad, vgGetPixels(path, 0, 0, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgGetPixels(image, 0, 0, 0, 0, 0, 1));
    EXPECT_VG_ERROR(noFormat, vgReadPixels(f.data(), 0, no, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgReadPixels(misaligned(f.data()), 0, VG_sRGBA_8888, 0, 0, 1, 1));
    EXPECT_VG_ERROR(illegal, vgReadPixels(f.data(), 0, VG_A_8, 0, 0, 1, 0));
    EXPECT_VG_ERROR(illegal, vgCopyPixels(0, 0, 0, 0, 0, 1));
}

TEST_F(ErrorsTest, ImagesThatAreDrawnIntoAreInUse) {
    const VGImage drawn = target();
    EXPECT_VG_ERROR(inUse, vgMask(drawn, VG_SET_MASK, 0, 0, 1, 1));
    EXPECT_VG_ERROR(inUse, vgPaintPattern(paint, drawn));
    EXPECT_VG_ERROR(inUse, vgClearImage(drawn, 0, 0, 1, 1));
    EXPECT_VG_ERROR(inUse, vgImageSubData(drawn, f.data(), 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(inUse, vgGetImageSubData(drawn, f.data(), 0, VG_A_8, 0, 0, 1, 1));
    EXPECT_VG_ERROR(inUse, vgChildImage(drawn, 0, 0, 1, 1));
    EXPECT_VG_ERROR(inUse, vgGetParent(drawn));
    EXPECT_VG_ERROR(inUse, vgCopyImage(drawn, 0, 0, image, 0, 0, 1, 1, VG_FALSE));
    EXPECT_VG_ERROR(inUse, vgCopyImage(image, 0, 0, drawn, 0, 0, 1, 1, VG_FALSE));
    EXPECT_VG_ERROR(inUse, vgDrawImage(drawn));
    EXPECT_VG_ERROR(inUse, vgSetPixels(0, 0, drawn, 0, 0, 1, 1));
    EXPECT_VG_ERROR(inUse, vgGetPixels(drawn, 0, 0, 0, 0, 1, 1));
    EXPECT_VG_ERROR(inUse, vgSetGlyphToImage(font, 0, drawn, f.data(), f.data()));
    EXPECT_VG_ERROR(inUse, vgColorMatrix(drawn, image, f.data()));
    EXPECT_VG_ERROR(inUse, vgGaussianBlur(image, drawn, 1, 1, VG_TILE_PAD));
    vtmMakeCurrent(context, surface);
    EXPECT_VG_ERROR(VG_NO_ERROR, vgDrawImage(drawn));
}

TEST_F(ErrorsTest, Section4ImagesThatCannotBeDrawnInto) {
    VGErrorCode error = VG_NO_ERROR;
    const auto make = [&](VGImage of) { return vtmCreateImageSurface(context, of, 0, &error); };
    EXPECT_EQ(make(path), nullptr);
    EXPECT_EQ(error, bad);
    const VGImage child = vgChildImage(image, 0, 0, 2, 2);
    EXPECT_EQ(make(image), nullptr);
    EXPECT_EQ(error, inUse);
    EXPECT_EQ(make(child), nullptr);
    vgDestroyImage(child);
    vgPaintPattern(paint, image);
    EXPECT_EQ(make(image), nullptr);
    EXPECT_EQ(error, inUse);
    vgPaintPattern(paint, none);
    vgSetGlyphToImage(font, 3, image, f.data(), f.data());
    EXPECT_EQ(make(image), nullptr);
    EXPECT_EQ(error, inUse);
    vgClearGlyph(font, 3);
    VtmSurface* const drawn = make(image);
    EXPECT_NE(drawn, nullptr);
    EXPECT_EQ(error, VG_NO_ERROR);
    vtmDestroySurface(drawn);
}

TEST_F(ErrorsTest, Section11Text) {
    EXPECT_VG_ERROR(illegal, vgCreateFont(-1));
    EXPECT_VG_ERROR(bad, vgDestroyFont(paint));
    EXPECT_VG_ERROR(bad, vgSetGlyphToPath(path, 0, path, VG_FALSE, f.data(), f.data()));
    EXPECT_VG_ERROR(bad, vgSetGlyphToPath(font, 0, image, VG_FALSE, f.data(), f.data()));
    EXPECT_VG_ERROR(illegal, vgSetGlyphToPath(font, 0, path, VG_FALSE, nullptr, f.data()));
    EXPECT_VG_ERROR(illegal, vgSetGlyphToPath(font, 0, path, VG_FALSE, f.data(), misaligned(f.data())));
    EXPECT_VG_ERROR(bad, vgSetGlyphToImage(font, 0, path, f.data(), f.data()));
    EXPECT_VG_ERROR(illegal, vgSetGlyphToImage(font, 0, image, f.data(), nullptr));
    EXPECT_EQ(vgGetParameteri(font, VG_FONT_NUM_GLYPHS), 0);
    EXPECT_VG_ERROR(bad, vgClearGlyph(path, 0));
    EXPECT_VG_ERROR(illegal, vgClearGlyph(font, 0));
    vgSetGlyphToPath(font, 7, path, VG_FALSE, f.data(), f.data());
    EXPECT_VG_ERROR(bad, vgDrawGlyph(path, 7, VG_FILL_PATH, VG_FALSE));
    EXPECT_VG_ERROR(illegal, vgDrawGlyph(font, 8, VG_FILL_PATH, VG_FALSE));
    EXPECT_VG_ERROR(illegal, vgDrawGlyph(font, 7, 4, VG_FALSE));
    const std::array<VGuint, 2> glyphs{7, 8};
    const auto draw = [&](VGint count, const VGuint* indices, const VGfloat* x, VGbitfield modes) {
        vgDrawGlyphs(font, count, indices, x, nullptr, modes, VG_FALSE);
    };
    EXPECT_VG_ERROR(bad, vgDrawGlyphs(path, 1, glyphs.data(), nullptr, nullptr, 0, VG_FALSE));
    EXPECT_VG_ERROR(illegal, draw(0, glyphs.data(), nullptr, 0));
    EXPECT_VG_ERROR(illegal, draw(1, nullptr, nullptr, 0));
    EXPECT_VG_ERROR(illegal, draw(1, misaligned(glyphs.data()), nullptr, 0));
    EXPECT_VG_ERROR(illegal, draw(1, glyphs.data(), misaligned(f.data()), 0));
    EXPECT_VG_ERROR(illegal, draw(1, glyphs.data(), nullptr, 4));
    EXPECT_VG_ERROR(illegal, draw(2, glyphs.data(), nullptr, VG_FILL_PATH));
    EXPECT_VG_ERROR(VG_NO_ERROR, draw(1, glyphs.data(), nullptr, 0));
}

TEST_F(ErrorsTest, Section12Filters) {
    const std::array<VGshort, 4> kernel{};
    const std::array<VGuint, 256> table{};
    const VGTilingMode pad = VG_TILE_PAD, no = VGTilingMode(VG_TILE_REFLECT + 1);
    const auto convolve = [&](VGint w, VGint h, const VGshort* k, VGTilingMode mode) {
        vgConvolve(image, other, w, h, 0, 0, k, 1, 0, mode);
    };
    const auto separable = [&](VGint w, VGint h, const VGshort* x, const VGshort* y, VGTilingMode mode) {
        vgSeparableConvolve(image, other, w, h, 0, 0, x, y, 1, 0, mode);
    };
    EXPECT_VG_ERROR(bad, vgColorMatrix(path, image, f.data()));
    EXPECT_VG_ERROR(bad, vgColorMatrix(image, path, f.data()));
    EXPECT_VG_ERROR(illegal, vgColorMatrix(image, image, f.data()));
    EXPECT_VG_ERROR(illegal, vgColorMatrix(image, other, nullptr));
    EXPECT_VG_ERROR(illegal, vgColorMatrix(image, other, misaligned(f.data())));
    const VGImage left = vgChildImage(image, 0, 0, 3, 4), right = vgChildImage(image, 2, 0, 2, 4),
                  corner = vgChildImage(image, 3, 0, 1, 1);
    EXPECT_VG_ERROR(illegal, vgColorMatrix(left, right, f.data()));
    EXPECT_VG_ERROR(VG_NO_ERROR, vgColorMatrix(left, corner, f.data()));

    EXPECT_VG_ERROR(illegal, convolve(0, 1, kernel.data(), pad));
    EXPECT_VG_ERROR(illegal, convolve(1, vgGeti(VG_MAX_KERNEL_SIZE) + 1, kernel.data(), pad));
    EXPECT_VG_ERROR(illegal, convolve(1, 1, nullptr, pad));
    EXPECT_VG_ERROR(illegal, convolve(1, 1, misaligned(kernel.data()), pad));
    EXPECT_VG_ERROR(illegal, convolve(1, 1, kernel.data(), no));
    EXPECT_VG_ERROR(bad, vgConvolve(image, path, 1, 1, 0, 0, kernel.data(), 1, 0, pad));
    EXPECT_VG_ERROR(illegal, separable(1, 0, kernel.data(), kernel.data(), pad));
    EXPECT_VG_ERROR(
        illegal, separable(vgGeti(VG_MAX_SEPARABLE_KERNEL_SIZE) + 1, 1, kernel.data(), kernel.data(), pad));
    EXPECT_VG_ERROR(illegal, separable(1, 1, nullptr, kernel.data(), pad));
    EXPECT_VG_ERROR(illegal, separable(1, 1, kernel.data(), misaligned(kernel.data()), pad));
    EXPECT_VG_ERROR(illegal, separable(1, 1, kernel.data(), kernel.data(), no));
    EXPECT_VG_ERROR(bad,
                    vgSeparableConvolve(path, image, 1, 1, 0, 0, kernel.data(), kernel.data(), 1, 0, pad));
    EXPECT_VG_ERROR(illegal, vgGaussianBlur(image, other, 0, 1, pad));
    EXPECT_VG_ERROR(illegal, vgGaussianBlur(image, other, 1, vgGetf(VG_MAX_GAUSSIAN_STD_DEVIATION) + 1, pad));
    EXPECT_VG_ERROR(illegal, vgGaussianBlur(image, other, std::nanf(""), 1, pad));
    EXPECT_VG_ERROR(illegal, vgGaussianBlur(image, other, 1, 1, no));
    EXPECT_VG_ERROR(bad, vgGaussianBlur(image, path, 1, 1, pad));
    EXPECT_VG_ERROR(illegal, vgLookup(image, other, bytes.data(), bytes.data(), nullptr, bytes.data(),
                                      VG_FALSE, VG_FALSE));
    EXPECT_VG_ERROR(bad, vgLookup(none, other, nullptr, nullptr, nullptr, nullptr, VG_FALSE, VG_FALSE));
    EXPECT_VG_ERROR(illegal, vgLookupSingle(image, other, nullptr, VG_RED, VG_FALSE, VG_FALSE));
    EXPECT_VG_ERROR(illegal,
                    vgLookupSingle(image, other, misaligned(table.data()), VG_RED, VG_FALSE, VG_FALSE));
    EXPECT_VG_ERROR(illegal,
                    vgLookupSingle(image, other, table.data(), VGImageChannel(3), VG_FALSE, VG_FALSE));
    const VGImage grey = newImage(VG_sL_8, 4, 4);
    EXPECT_VG_ERROR(VG_NO_ERROR,
                    vgLookupSingle(image, grey, table.data(), VGImageChannel(0), VG_FALSE, VG_FALSE));
    EXPECT_VG_ERROR(bad, vgLookupSingle(image, none, table.data(), VG_RED, VG_FALSE, VG_FALSE));
}

TEST_F(ErrorsTest, Section14Queries) {
    EXPECT_VG_ERROR(illegal, vgHardwareQuery(VGHardwareQueryType(0), 0));
    EXPECT_VG_ERROR(illegal, vgHardwareQuery(VG_IMAGE_FORMAT_QUERY, 15));
    EXPECT_VG_ERROR(illegal, vgHardwareQuery(VG_PATH_DATATYPE_QUERY, 4));
}

}  // namespace

}  // namespace vtm::openvg::testing
