// VG_KHR_EGL_image by vtm/vg_image.h: pixels that contexts share though they share no objects.

#include <vtm/vg_image.h>

#include "api/openvg/tests/extensions_fixture.hpp"

namespace extensions {
namespace {

constexpr int width = 4, height = 3;

/// Beside the fixture's context another that shares nothing with it.
class EglImage : public Extensions {
protected:
    void SetUp() override {
        Extensions::SetUp();
        second_ = vtmCreateContext(nullptr);
        secondSurface_ = vtmCreateSurface(4, 4, &vtm::openvg::testing::sRGBA8888);
    }
    void TearDown() override {
        vtmMakeCurrent(second_, secondSurface_);
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        useFirst();
        vtmDestroyContext(second_);
        vtmDestroySurface(secondSurface_);
        Extensions::TearDown();
    }

    void useFirst() const { ASSERT_TRUE(vtmMakeCurrent(context, surface)); }
    void useSecond() const { ASSERT_TRUE(vtmMakeCurrent(second_, secondSurface_)); }

    /// Shared under the name of its own address.
    VtmSharedImage* share(VGImage image) const {
        VtmSharedImage* const shared = vtmShareImage(context, image, nullptr);
        EXPECT_NE(shared, nullptr);
        EXPECT_TRUE(vtmNameSharedImage(shared, shared));
        return shared;
    }
    VGErrorCode errorOfSharing(VGImage image) const {
        VGErrorCode error = VG_NO_ERROR;
        EXPECT_EQ(vtmShareImage(context, image, &error), nullptr);
        return error;
    }

    VtmContext* second_ = nullptr;
    VtmSurface* secondSurface_ = nullptr;
};

TEST_F(EglImage, IsAnExtension) {
    EXPECT_TRUE(has("VG_KHR_EGL_image"));
    EXPECT_NE(vtmGetProcAddress("vgCreateEGLImageTargetKHR"), nullptr);
}

TEST_F(EglImage, SiblingsHaveTheSamePixels) {
    const Bytes before = noise(width * height * 4), after = noise(width * height * 4);
    const VGImage source = image(sRGBA, width, height, before);
    VtmSharedImage* const shared = share(source);
    useSecond();
    const VGImage target = vgCreateEGLImageTargetKHR(shared);
    ASSERT_NE(target, VG_INVALID_HANDLE);
    EXPECT_NE(target, source);
    EXPECT_EQ(vgGetParameteri(target, VG_IMAGE_FORMAT), sRGBA);
    EXPECT_EQ(vgGetParameteri(target, VG_IMAGE_WIDTH), width);
    EXPECT_EQ(vgGetParameteri(target, VG_IMAGE_HEIGHT), height);
    EXPECT_EQ(vgGetParent(target), target);
    // Keeps pixels, as EGL_IMAGE_PRESERVED wants it.
    EXPECT_EQ(bytesOf(target, sRGBA), before);
    vgImageSubData(target, after.data(), width * 4, sRGBA, 0, 0, width, height);
    useFirst();
    EXPECT_EQ(bytesOf(source, sRGBA), after);
    vgClearImage(source, 0, 0, width, height);
    useSecond();
    EXPECT_EQ(bytesOf(target, sRGBA), Bytes(width * height * 4));
    vtmDestroySharedImage(shared);
}

TEST_F(EglImage, HasEveryFormat) {
    for (const VGint format : {VG_sRGBX_8888, VG_lRGBA_8888_PRE, VG_sRGB_565, VG_sRGBA_5551, VG_sRGBA_4444,
                               VG_sL_8, VG_lL_8, VG_A_8, VG_BW_1, VG_A_1, VG_A_4, VG_lABGR_8888}) {
        SCOPED_TRACE(format);
        useFirst();
        const VGImage source = vgCreateImage(VGImageFormat(format), width, height, VG_IMAGE_QUALITY_FASTER);
        const VGfloat grey[] = {0.75f, 0.75f, 0.75f, 0.75f};
        vgSetfv(VG_CLEAR_COLOR, 4, grey);
        vgClearImage(source, 1, 1, 2, 1);
        const Bytes pixels = bytesOf(source, sRGBA);
        VtmSharedImage* const shared = share(source);
        useSecond();
        const VGImage target = vgCreateEGLImageTargetKHR(shared);
        EXPECT_EQ(vgGetParameteri(target, VG_IMAGE_FORMAT), format);
        EXPECT_EQ(bytesOf(target, sRGBA), pixels);
        vtmDestroySharedImage(shared);
    }
}

TEST_F(EglImage, PixelsStayUntilTheLastSiblingIsGone) {
    const Bytes pixels = noise(width * height * 4);
    const VGImage source = image(sRGBA, width, height, pixels);
    VtmSharedImage* const shared = share(source);
    useSecond();
    const VGImage target = vgCreateEGLImageTargetKHR(shared);
    useFirst();
    vgDestroyImage(source);
    // The source is gone, the EGLImage is not.
    const VGImage another = vgCreateEGLImageTargetKHR(shared);
    EXPECT_EQ(bytesOf(another, sRGBA), pixels);
    vtmDestroySharedImage(shared);
    EXPECT_EQ(vgCreateEGLImageTargetKHR(shared), VG_INVALID_HANDLE);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgDestroyImage(another);
    useSecond();
    EXPECT_EQ(bytesOf(target, sRGBA), pixels);
    vgDestroyImage(target);
}

TEST_F(EglImage, OfAParentHasChildrenOfBoth) {
    const Bytes pixels = noise(width * height * 4);
    const VGImage source = image(sRGBA, width, height, pixels), child = vgChildImage(source, 1, 1, 2, 2);
    EXPECT_EQ(errorOfSharing(child), VG_IMAGE_IN_USE_ERROR);
    VtmSharedImage* const shared = share(source);
    useSecond();
    const VGImage target = vgCreateEGLImageTargetKHR(shared), part = vgChildImage(target, 2, 0, 2, 2);
    EXPECT_EQ(vgGetParent(part), target);
    vgClearImage(part, 0, 0, 1, 2);  // column 2 of all, column 1 of the other child
    useFirst();
    const Bytes seen = bytesOf(child, sRGBA);
    for (const std::size_t pixel : {1u, 3u})
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_EQ(seen[pixel * 4 + c], pixel == 1 ? 0 : pixels[(2 * width + 2) * 4 + c]);
    vtmDestroySharedImage(shared);
}

TEST_F(EglImage, OfAnOrphanedChildIsThatPart) {
    // vgGetParent() of a child whose parent is destroyed is itself.
    const Bytes pixels = noise(width * height * 4);
    const VGImage source = image(sRGBA, width, height, pixels), child = vgChildImage(source, 1, 2, 2, 1);
    const Bytes part = bytesOf(child, sRGBA);
    vgDestroyImage(source);
    VtmSharedImage* const shared = share(child);
    const VGImage target = vgCreateEGLImageTargetKHR(shared);
    EXPECT_EQ(vgGetParameteri(target, VG_IMAGE_WIDTH), 2);
    EXPECT_EQ(vgGetParameteri(target, VG_IMAGE_HEIGHT), 1);
    EXPECT_EQ(bytesOf(target, sRGBA), part);
    vtmDestroySharedImage(shared);
}

TEST_F(EglImage, SiblingsAreNotSharedAgain) {
    const VGImage source = image(sRGBA, width, height, noise(width * height * 4));
    VtmSharedImage* shared = share(source);
    const VGImage target = vgCreateEGLImageTargetKHR(shared);
    EXPECT_EQ(errorOfSharing(source), VG_IMAGE_IN_USE_ERROR);
    EXPECT_EQ(errorOfSharing(target), VG_IMAGE_IN_USE_ERROR);
    EXPECT_EQ(errorOfSharing(VGImage(12345678)), VG_BAD_HANDLE_ERROR);
    vtmDestroySharedImage(shared);
    // There is still a sibling.
    EXPECT_EQ(errorOfSharing(source), VG_IMAGE_IN_USE_ERROR);
    vgDestroyImage(target);
    shared = share(source);
    EXPECT_NE(vgCreateEGLImageTargetKHR(shared), VG_INVALID_HANDLE);
    vtmDestroySharedImage(shared);
}

TEST_F(EglImage, SiblingsAreNoSurfaces) {
    const VGImage source = image(sRGBA, width, height, noise(width * height * 4));
    VGErrorCode error = VG_NO_ERROR;
    VtmSurface* const onSource = vtmCreateImageSurface(context, source, 0, &error);
    ASSERT_NE(onSource, nullptr);
    EXPECT_EQ(errorOfSharing(source), VG_IMAGE_IN_USE_ERROR);
    vtmDestroySurface(onSource);
    VtmSharedImage* const shared = share(source);
    const VGImage target = vgCreateEGLImageTargetKHR(shared);
    for (const VGImage sibling : {source, target}) {
        EXPECT_EQ(vtmCreateImageSurface(context, sibling, 0, &error), nullptr);
        EXPECT_EQ(error, VG_IMAGE_IN_USE_ERROR);
    }
    // Not even the last that is left: a target is one for good.
    vgDestroyImage(source);
    vtmDestroySharedImage(shared);
    EXPECT_EQ(vtmCreateImageSurface(context, target, 0, &error), nullptr);
    EXPECT_EQ(error, VG_IMAGE_IN_USE_ERROR);
}

TEST_F(EglImage, NamesAreOfOneAtATime) {
    int place = 0, other = 0;
    VtmSharedImage* const a = vtmShareImage(context, image(sRGBA, 1, 1, noise(4)), nullptr);
    VtmSharedImage* const b = vtmShareImage(context, image(sRGBA, 2, 1, noise(8)), nullptr);
    const auto widthOf = [](void* name) {
        return vgGetParameteri(vgCreateEGLImageTargetKHR(name), VG_IMAGE_WIDTH);
    };
    EXPECT_TRUE(vtmNameSharedImage(a, &place));
    EXPECT_FALSE(vtmNameSharedImage(b, &place));
    EXPECT_EQ(widthOf(&place), 1);
    EXPECT_TRUE(vtmNameSharedImage(a, &other));
    EXPECT_TRUE(vtmNameSharedImage(b, &place));
    EXPECT_EQ(widthOf(&other), 1);
    EXPECT_EQ(widthOf(&place), 2);
    vtmDestroySharedImage(a);
    EXPECT_EQ(vgCreateEGLImageTargetKHR(&other), VG_INVALID_HANDLE);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vtmDestroySharedImage(b);
    vtmDestroySharedImage(nullptr);
}

TEST_F(EglImage, WithoutANameIsNoSiblingAnyMore) {
    const VGImage source = image(sRGBA, 1, 1, {1, 2, 3, 4});
    VtmSharedImage* const shared = share(source);
    EXPECT_TRUE(vtmNameSharedImage(shared, nullptr));
    EXPECT_FALSE(vtmNameSharedImage(shared, shared));
    EXPECT_EQ(vgCreateEGLImageTargetKHR(shared), VG_INVALID_HANDLE);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vtmDestroySharedImage(share(source));
    Bytes pixels(4);
    EXPECT_EQ(vtmTakeSharedPixels(shared, pixels.data()), VTM_PIXELS_CHANGED);
    EXPECT_EQ(pixels, (Bytes{1, 2, 3, 4}));
    vgDestroyImage(source);
    EXPECT_EQ(vtmTakeSharedPixels(shared, pixels.data()), VTM_PIXELS_GONE);
    vtmPutSharedPixels(shared, pixels.data());
    vtmDestroySharedImage(shared);
}

TEST_F(EglImage, GivesAndTakesPixelsThatChange) {
    // Five bits of red: 7 of 31 are 58 of 255, and so are all bytes near to that.
    const VGImage source = vgCreateImage(VG_sRGB_565, 2, 1, VG_IMAGE_QUALITY_FASTER);
    const std::uint16_t words[] = {7 << 11, 63 << 5};
    vgImageSubData(source, words, 4, VG_sRGB_565, 0, 0, 2, 1);
    VtmSharedImage* const shared = share(source);
    EXPECT_EQ(vtmSharedImageWidth(shared), 2);
    EXPECT_EQ(vtmSharedImageHeight(shared), 1);
    Bytes pixels(8);
    ASSERT_EQ(vtmTakeSharedPixels(shared, pixels.data()), VTM_PIXELS_CHANGED);
    EXPECT_EQ(pixels, (Bytes{58, 0, 0, 255, 0, 255, 0, 255}));
    EXPECT_EQ(vtmTakeSharedPixels(shared, pixels.data()), VTM_PIXELS_SAME);
    pixels = {58, 0, 0, 255, 0, 0, 255, 255};
    vtmPutSharedPixels(shared, pixels.data());
    EXPECT_EQ(vtmTakeSharedPixels(shared, pixels.data()), VTM_PIXELS_SAME);
    std::uint16_t after[2] = {};
    vgGetImageSubData(source, after, 4, VG_sRGB_565, 0, 0, 2, 1);
    EXPECT_EQ(after[0], words[0]);
    EXPECT_EQ(after[1], 31);
    vgClearImage(source, 0, 0, 1, 1);
    ASSERT_EQ(vtmTakeSharedPixels(shared, pixels.data()), VTM_PIXELS_CHANGED);
    EXPECT_EQ(pixels, (Bytes{0, 0, 0, 255, 0, 0, 255, 255}));
    vtmDestroySharedImage(shared);
}

TEST_F(EglImage, IsAPatternAGlyphAndAPicture) {
    const Bytes pixels(side * side * 4, 255);
    const VGImage source = image(sRGBA, side, side, Bytes(side * side * 4));
    VtmSharedImage* const shared = share(source);
    const VGImage target = vgCreateEGLImageTargetKHR(shared);
    useSecond();
    const VGImage far = vgCreateEGLImageTargetKHR(shared);
    vgImageSubData(far, pixels.data(), side * 4, sRGBA, 0, 0, side, side);
    useFirst();
    vgDrawImage(target);
    EXPECT_EQ(surfaceBytes(), pixels);
    const VGfloat clear[] = {0, 0, 0, 0};
    vgSetfv(VG_CLEAR_COLOR, 4, clear);
    vgClear(0, 0, side, side);
    const VGPaint paint = vgCreatePaint();
    vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN);
    vgPaintPattern(paint, target);
    vgSetPaint(paint, VG_FILL_PATH);
    vgDestroyImage(target);
    fillSurface();
    EXPECT_EQ(surfaceBytes(), pixels);
    vtmDestroySharedImage(shared);
}

}  // namespace
}  // namespace extensions
