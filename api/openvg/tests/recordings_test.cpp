// Recordings: calls as one picture. What they draw is compared with what the same calls draw at once.

#include <limits>

#include <VG/vgext.h>

#include "api/openvg/tests/recordings_fixture.hpp"

namespace vtm::openvg::testing {
namespace {

/// A recording's gradient is its mean over a pixel, a direct one's its colour in the middle. At the tip of a
/// cone they differ by 0.38 of a pixel's change, and the most here is 255 / (0.4 · 12.8): the first stretch
/// of the ramp, where the circle is nearest to the focus. Stops, where it is an eighth of what the change
/// changes by, take less.
constexpr int gradientBend = 19;

TEST_F(Recordings, FillsAreWhatCallsDraw) {
    for (const VGint rule : {VG_EVEN_ODD, VG_NON_ZERO}) {
        EXPECT_LE(difference([&] {
                      vgSeti(VG_FILL_RULE, rule);
                      useColor({0.2f, 0.4f, 0.7f, 1});
                      fill(star());
                  }),
                  edgeTolerance);
        EXPECT_LE(difference([&] {
                      vgSeti(VG_FILL_RULE, rule);
                      useColor({0.9f, 0.1f, 0.3f, 0.4f});
                      fill(star());
                  }),
                  edgeTolerance);
    }
}

TEST_F(Recordings, StrokesAreWhatCallsDraw) {
    for (const bool isDashed : {false, true})
        for (const VGint cap : {VG_CAP_BUTT, VG_CAP_ROUND, VG_CAP_SQUARE})
            EXPECT_LE(difference([&] {
                          const VGfloat dashes[] = {11, 9};
                          vgSetfv(VG_STROKE_DASH_PATTERN, isDashed ? 2 : 0, dashes);
                          vgSetf(VG_STROKE_DASH_PHASE, 4);
                          vgSetf(VG_STROKE_LINE_WIDTH, 3.5f);
                          vgSeti(VG_STROKE_CAP_STYLE, cap);
                          useColor({0, 0.3f, 0, 1});
                          // The pattern goes on from one to the other.
                          const VGPath path =
                              newPath({VG_MOVE_TO_ABS, VG_CUBIC_TO_ABS, VG_MOVE_TO_ABS, VG_LINE_TO_ABS},
                                      {8, 8, 20, 70, 44, 60, 56, 36, 8, 50, 20, 58});
                          vgDrawPath(path, VG_STROKE_PATH);
                          vgDestroyPath(path);
                      }),
                      edgeTolerance)
                << isDashed << " " << cap;
}

TEST_F(Recordings, GradientsAreWhatCallsDraw) {
    for (const VGint spread :
         {VG_COLOR_RAMP_SPREAD_PAD, VG_COLOR_RAMP_SPREAD_REPEAT, VG_COLOR_RAMP_SPREAD_REFLECT})
        for (const bool premultiplied : {false, true})
            for (const bool transformed : {false, true})
                for (const VGPaintType type : {VG_PAINT_TYPE_LINEAR_GRADIENT, VG_PAINT_TYPE_RADIAL_GRADIENT})
                    EXPECT_LE(difference([&] {
                                  const VGfloat values[] = {0.5f, 1, 1, 0.8f, 0.25f, 0, -0.1f, 0};
                                  vgSeti(VG_COLOR_TRANSFORM, transformed);
                                  vgSetfv(VG_COLOR_TRANSFORM_VALUES, 8, values);
                                  const auto place = type == VG_PAINT_TYPE_LINEAR_GRADIENT
                                                         ? std::vector<VGfloat>{10.37f, 20.11f, 44, 30}
                                                         : std::vector<VGfloat>{30, 30, 36, 26, 20};
                                  // Where a ramp repeats, recordings have no steps.
                                  std::vector<VGfloat> stops{0, 1,    0, 0, 1,    0.4f, 1, 1,
                                                             0, 0.2f, 1, 0, 0.2f, 1,    0};
                                  if (spread == VG_COLOR_RAMP_SPREAD_REPEAT)
                                      std::copy_n(stops.begin() + 1, 4, stops.end() - 4);
                                  const VGPaint paint = gradient(type, place, stops, spread, premultiplied);
                                  usePaint(paint);
                                  fill(wholeSurface());
                                  vgDestroyPaint(paint);
                              }),
                              2 + gradientBend)
                        << spread << premultiplied << transformed << type;
}

TEST_F(Recordings, GradientsWithoutExtentAreTheirLastColor) {
    for (const VGfloat radius : {0.0f, -1.0f, std::numeric_limits<VGfloat>::quiet_NaN()})
        EXPECT_LE(difference([&] {
                      const VGPaint paint =
                          gradient(VG_PAINT_TYPE_RADIAL_GRADIENT, {3, 3, 3, 3, radius},
                                   {0, 1, 0, 0, 1, 1, 0, 0, 1, 1}, VG_COLOR_RAMP_SPREAD_PAD);
                      usePaint(paint);
                      fill(wholeSurface());
                      vgDestroyPaint(paint);
                  }),
                  1);
}

TEST_F(Recordings, PatternsAreWhatCallsDraw) {
    const VGImage image = checks();
    for (const VGint tiling : {VG_TILE_FILL, VG_TILE_PAD, VG_TILE_REPEAT, VG_TILE_REFLECT})
        EXPECT_LE(difference([&] {
                      const VGPaint paint = vgCreatePaint();
                      const VGfloat around[] = {0, 0.5f, 0.5f, 0.5f};
                      vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_NONANTIALIASED);
                      vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN);
                      vgSetParameteri(paint, VG_PAINT_PATTERN_TILING_MODE, tiling);
                      vgSetfv(VG_TILE_FILL_COLOR, 4, around);
                      vgPaintPattern(paint, image);
                      vgSeti(VG_MATRIX_MODE, VG_MATRIX_FILL_PAINT_TO_USER);
                      vgLoadIdentity();
                      vgTranslate(12, 20);
                      vgScale(4, 4);
                      usePaint(paint);
                      fill(rectangle(2, 2, 60, 60));
                      vgDestroyPaint(paint);
                  }),
                  1)
            << tiling;
}

TEST_F(Recordings, ImagesAreWhatCallsDraw) {
    const VGImage image = checks();
    for (const VGint quality : {VG_IMAGE_QUALITY_NONANTIALIASED, VG_IMAGE_QUALITY_BETTER})
        EXPECT_LE(difference([&] {
                      vgSeti(VG_IMAGE_QUALITY, quality);
                      vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
                      vgLoadIdentity();
                      vgTranslate(4, 12);
                      vgScale(10, 12);
                      vgDrawImage(image);
                  }),
                  2)
            << quality;
}

/// Values of every kind of the mask, rows of them; with `isHard` 0 and 1 alone.
VGImage maskImage(VGImageFormat format, int width, int height, bool isHard) {
    const VGImage image =
        vgCreateImage(format, width, height, VG_IMAGE_QUALITY_NONANTIALIASED | VG_IMAGE_QUALITY_BETTER);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const unsigned value = isHard ? ((x / 3 + y / 5) % 2) * 255u : unsigned(37 * x + 11 * y) & 255;
            const std::uint32_t word = format == VG_A_8 ? value : value * 0x01010100u | 255;
            vgImageSubData(image, &word, 4, format == VG_A_8 ? VG_A_8 : VG_sRGBX_8888, x, y, 1, 1);
        }
    return image;
}

TEST_F(Recordings, ImagesInOtherModesAreWhatCallsDraw) {
    const VGImage image = checks(), alpha = maskImage(VG_A_8, 12, 7, false),
                  opaque = maskImage(VG_sRGBX_8888, 9, 8, false);
    const auto drawn = [](VGImageMode mode, VGImage what, VGPaint paint) {
        vgSeti(VG_IMAGE_MODE, mode);
        vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_NONANTIALIASED);
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_FILL_PAINT_TO_USER);
        vgLoadIdentity();
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
        vgLoadIdentity();
        vgTranslate(4, 12);
        vgScale(4, 5);
        usePaint(paint);
        vgDrawImage(what);
        vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_NORMAL);
    };
    const VGPaint color = newPaint({0.3f, 0.8f, 0.6f, 0.7f}),
                  ramp = gradient(VG_PAINT_TYPE_LINEAR_GRADIENT, {0, 0, 12, 7},
                                  {0, 1, 0, 0.2f, 1, 1, 0.1f, 1, 0.8f, 1}, VG_COLOR_RAMP_SPREAD_PAD);
    for (const VGImage what : {image, alpha, opaque})
        EXPECT_LE(difference([&] { drawn(VG_DRAW_IMAGE_MULTIPLY, what, color); }), 1) << what;
    for (const VGImage what : {image, opaque})
        EXPECT_LE(difference([&] { drawn(VG_DRAW_IMAGE_MULTIPLY, what, ramp); }), 2) << what;
    for (const VGPaint paint : {color, ramp})
        EXPECT_LE(difference([&] { drawn(VG_DRAW_IMAGE_STENCIL, alpha, paint); }), 2) << paint;
    // Colours for each channel are no scene's.
    for (const VGImage what : {image, opaque})
        EXPECT_EQ(faultOf([&] { drawn(VG_DRAW_IMAGE_STENCIL, what, color); }).first,
                  VTM_NOT_RECORDABLE_ERROR);
}

TEST_F(Recordings, PixelsReplaceWhatIsThere) {
    const VGImage image = checks();
    std::array<std::uint32_t, 20 * 20> words;
    for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = std::uint32_t(i * 2654435761u);
    EXPECT_LE(difference(
                  [&] {
                      useColor({0.2f, 0.3f, 1, 1});
                      fill(wholeSurface());
                      vgSetPixels(10, 20, image, 0, 0, 5, 3);
                      vgSetPixels(-2, 40, image, 1, 1, 5, 3);
                      const VGint rectangles[] = {30, 30, 8, 9, 35, 36, 20, 4};
                      vgSetiv(VG_SCISSOR_RECTS, 8, rectangles);
                      vgSeti(VG_SCISSORING, VG_TRUE);
                      vgWritePixels(words.data(), 80, VG_sRGBA_8888, 25, 25, 20, 20);
                      vgSeti(VG_SCISSORING, VG_FALSE);
                      vgWritePixels(words.data(), 80, VG_lXRGB_8888, 50, 50, 20, 20);
                      vgWritePixels(words.data(), 4, VG_BW_1, 2, 2, 19, 7);
                      // A colour transform and blending take no part.
                      vgSeti(VG_COLOR_TRANSFORM, VG_TRUE);
                      const VGfloat values[] = {0.5f, 0.5f, 0.5f, 0.5f, 0, 0, 0, 0};
                      vgSetfv(VG_COLOR_TRANSFORM_VALUES, 8, values);
                      vgSeti(VG_BLEND_MODE, VG_BLEND_MULTIPLY);
                      vgSetPixels(30, 5, image, 0, 0, 5, 3);
                  },
                  {0, 0, 0, 0}),
              1);
}

TEST_F(Recordings, MasksOfImagesCut) {
    for (const VGImageFormat format : {VG_A_8, VG_sRGBX_8888}) {
        const VGImage image = maskImage(format, 40, 30, true);
        for (const VGMaskOperation operation :
             {VG_SET_MASK, VG_UNION_MASK, VG_INTERSECT_MASK, VG_SUBTRACT_MASK})
            for (const bool isAll : {false, true})
                EXPECT_LE(difference([&] {
                              vgSeti(VG_MASKING, VG_TRUE);
                              const VGPath first = rectangle(8, 8, 30, 30);
                              vgRenderToMask(first, VG_FILL_PATH, VG_SET_MASK);
                              vgDestroyPath(first);
                              if (isAll)
                                  vgMask(image, VG_SET_MASK, 0, 0, 64, 64);
                              vgMask(image, operation, 12, 5, 64, 20);
                              useColor({0.5f, 0, 0, 0.5f});
                              fill(wholeSurface());
                              useColor({0, 0, 0.5f, 1});
                              fill(rectangle(0, 24, 64, 8));
                          }),
                          1)
                    << operation << " " << isAll;
    }
}

// Values between 0 and 1 multiply alpha, as those of an image that is drawn.
TEST_F(Recordings, SoftMasksAreAlpha) {
    const VGImage mask = maskImage(VG_A_8, side, side, false),
                  painted = vgCreateImage(VG_sRGBA_8888, side, side, VG_IMAGE_QUALITY_NONANTIALIASED);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const std::uint32_t word = 0xCC330000 | (unsigned(37 * x + 11 * y) & 255);
            vgImageSubData(painted, &word, 4, VG_sRGBA_8888, x, y, 1, 1);
        }
    const Recording masked = record([&] {
        resetState();
        vgSeti(VG_MASKING, VG_TRUE);
        vgMask(mask, VG_SET_MASK, 0, 0, side, side);
        useColor({0.8f, 0.2f, 0, 1});
        fill(wholeSurface());
        fill(rectangle(0, 0, side, 1));
    });
    resetState();
    clear({1, 1, 1, 1});
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgLoadIdentity();
    vgDrawImage(painted);
    const VGint lowest[] = {0, 0, side, 1};
    vgSetiv(VG_SCISSOR_RECTS, 4, lowest);
    vgSeti(VG_SCISSORING, VG_TRUE);
    vgDrawImage(painted);
    const std::vector<std::uint8_t> direct = pixels();
    resetState();
    clear({1, 1, 1, 1});
    vtmDrawRecording(masked.get());
    EXPECT_LE(largestDifference(direct, pixels()), 1);
}

TEST_F(Recordings, MaskLayersFromBefore) {
    const VGMaskLayer layer = vgCreateMaskLayer(40, 50);
    ASSERT_NE(layer, VG_INVALID_HANDLE);
    vgFillMaskLayer(layer, 0, 0, 40, 50, 0);
    vgFillMaskLayer(layer, 10, 20, 25, 20, 1);
    EXPECT_LE(difference([&] {
                  vgSeti(VG_MASKING, VG_TRUE);
                  vgMask(layer, VG_SET_MASK, 5, -3, 30, 60);
                  useColor({0.5f, 0, 0, 0.5f});
                  fill(wholeSurface());
              }),
              1);
    vgDestroyMaskLayer(layer);
}

TEST_F(Recordings, GlyphsAreWhatCallsDraw) {
    EXPECT_LE(difference([&] {
                  const VGFont font = vgCreateFont(2);
                  const VGfloat origin[] = {0, 0}, escapement[] = {22, 3};
                  const VGPath path = ellipse(9, 9, 16, 16);
                  vgSetGlyphToPath(font, 5, path, VG_FALSE, origin, escapement);
                  vgDestroyPath(path);
                  const VGuint indices[] = {5, 5};
                  const VGfloat start[] = {3, 20};
                  vgSetfv(VG_GLYPH_ORIGIN, 2, start);
                  useColor({0, 0, 0.5f, 1});
                  vgDrawGlyphs(font, 2, indices, nullptr, nullptr, VG_FILL_PATH, VG_TRUE);
                  vgDrawGlyph(font, 5, VG_FILL_PATH, VG_FALSE);
                  vgDestroyFont(font);
              }),
              edgeTolerance);
}

/// Glyphs of a font that stand many times are stored once.
TEST_F(Recordings, GlyphsAreInstances) {
    const auto bytesOf = [&](int rows) {
        const Recording recording = record(
            [&] {
                const VGFont font = vgCreateFont(2);
                const VGfloat origin[] = {0.5f, 0.25f}, escapement[] = {64.1f, 0};
                for (VGuint glyph = 0; glyph < 2; ++glyph) {
                    const VGPath path = glyph == 0 ? star() : ellipse(20, 20, 30, 25);
                    vgSetGlyphToPath(font, glyph, path, VG_FALSE, origin, escapement);
                    vgDestroyPath(path);
                }
                useColor({0, 0, 0.5f, 1});
                for (int row = 0; row < rows; ++row) {
                    const VGuint indices[] = {0, 1, 1, 0, 1, 0, 0, 1, 0, 1};
                    const VGfloat start[] = {3.3f, 64.1f * VGfloat(row)};
                    vgSetfv(VG_GLYPH_ORIGIN, 2, start);
                    vgDrawGlyphs(font, 10, indices, nullptr, nullptr, VG_FILL_PATH, VG_TRUE);
                }
                vgDestroyFont(font);
            },
            650, 650);
        size_t size = 0;
        vtmGetRecordingBytes(recording.get(), &size);
        return size;
    };
    constexpr std::size_t glyphs = 90, perInstance = 32;
    EXPECT_LE(bytesOf(10), bytesOf(1) + glyphs * perInstance);
}

TEST_F(Recordings, ScissoringCuts) {
    EXPECT_LE(difference([&] {
                  const VGint rectangles[] = {4, 4, 20, 30, 16, 20, 30, 40, 50, 50, 0, 10};
                  vgSetiv(VG_SCISSOR_RECTS, 12, rectangles);
                  vgSeti(VG_SCISSORING, VG_TRUE);
                  useColor({0.5f, 0, 0, 0.5f});
                  fill(wholeSurface());
                  useColor({0, 0, 0.5f, 0.5f});
                  fill(rectangle(10, 10, 30, 40));
                  const VGfloat half[] = {0, 1, 0, 0.25f};
                  vgSetfv(VG_CLEAR_COLOR, 4, half);
              }),
              1);
}

TEST_F(Recordings, MasksCut) {
    const auto layered = [](VGMaskOperation operation) {
        vgSeti(VG_MASKING, VG_TRUE);
        const VGPath first = rectangle(8, 8, 30, 30), second = rectangle(20, 16, 36, 40);
        vgRenderToMask(first, VG_FILL_PATH, VG_SET_MASK);
        vgRenderToMask(second, VG_FILL_PATH, operation);
        vgDestroyPath(first);
        vgDestroyPath(second);
        useColor({0.5f, 0, 0, 0.5f});
        fill(wholeSurface());
        useColor({0, 0, 0.5f, 1});
        fill(rectangle(0, 24, 64, 8));
    };
    for (const VGMaskOperation operation : {VG_SET_MASK, VG_UNION_MASK, VG_INTERSECT_MASK, VG_SUBTRACT_MASK})
        EXPECT_LE(difference([&] { layered(operation); }), 1) << operation;
    // The mask of a stroke, parts of the mask, and gradients through a mask with a hole.
    EXPECT_LE(difference([&] {
                  vgSeti(VG_MASKING, VG_TRUE);
                  vgMask(VG_INVALID_HANDLE, VG_FILL_MASK, 0, 0, side, side);
                  vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 20, 20, 20, 20);
                  vgMask(VG_INVALID_HANDLE, VG_FILL_MASK, 28, 28, 4, 4);
                  const VGPaint paint =
                      gradient(VG_PAINT_TYPE_LINEAR_GRADIENT, {0, 0, 64, 64},
                               {0, 1, 0, 0, 0.5f, 1, 0, 0, 1, 0.5f}, VG_COLOR_RAMP_SPREAD_PAD);
                  usePaint(paint);
                  fill(wholeSurface());
                  vgDestroyPaint(paint);
              }),
              2);
}

TEST_F(Recordings, MaskLayersKeepMasks) {
    EXPECT_LE(difference([&] {
                  vgSeti(VG_MASKING, VG_TRUE);
                  const VGMaskLayer before = vgCreateMaskLayer(side, side);
                  const VGPath left = rectangle(4, 4, 30, 56), low = rectangle(4, 4, 56, 30);
                  vgRenderToMask(left, VG_FILL_PATH, VG_SET_MASK);
                  vgCopyMask(before, 0, 0, 0, 0, side, side);
                  vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 0, 0, side, side);
                  vgRenderToMask(low, VG_FILL_PATH, VG_UNION_MASK);
                  vgMask(before, VG_INTERSECT_MASK, 0, 0, side, side);
                  useColor({1, 0, 0, 1});
                  fill(wholeSurface());
                  vgMask(before, VG_SET_MASK, 0, 0, side, side);
                  useColor({0, 0, 1, 0.5f});
                  fill(wholeSurface());
                  vgDestroyMaskLayer(before);
                  vgDestroyPath(left);
                  vgDestroyPath(low);
              }),
              1);
}

TEST_F(Recordings, BlendModesAreWhatCallsDraw) {
    // Over an opaque ground, which a recording must have itself: it does not see the surface.
    for (const VGint mode :
         {VGint(VG_BLEND_SRC), VGint(VG_BLEND_SRC_OVER), VGint(VG_BLEND_DST_OVER), VGint(VG_BLEND_MULTIPLY),
          VGint(VG_BLEND_SCREEN), VGint(VG_BLEND_DARKEN), VGint(VG_BLEND_LIGHTEN), VGint(VG_BLEND_ADDITIVE),
          VGint(VG_BLEND_OVERLAY_KHR), VGint(VG_BLEND_HARDLIGHT_KHR), VGint(VG_BLEND_SOFTLIGHT_KHR),
          VGint(VG_BLEND_DIFFERENCE_KHR), VGint(VG_BLEND_EXCLUSION_KHR)})
        for (const VGfloat alpha : {1.0f, 0.4f})
            EXPECT_LE(difference(
                          [&] {
                              const VGPaint paint =
                                  gradient(VG_PAINT_TYPE_LINEAR_GRADIENT, {0, 0, 64, 0},
                                           {0, 0, 0, 0, 1, 0.5f, 1, 0.5f, 0, 0.7f, 1, 1, 1, 1, 1},
                                           VG_COLOR_RAMP_SPREAD_PAD, false);
                              usePaint(paint);
                              vgSeti(VG_BLEND_MODE, VG_BLEND_SRC_OVER);
                              fill(rectangle(8, 8, 48, 48));
                              const VGPaint up = gradient(
                                  VG_PAINT_TYPE_LINEAR_GRADIENT, {0, 0, 0, 64},
                                  {0, 0, 0, 0, alpha, 0.5f, 0.8f, 0.2f, 0.5f, alpha, 1, 1, 1, 1, alpha},
                                  VG_COLOR_RAMP_SPREAD_PAD, false);
                              usePaint(up);
                              vgSeti(VG_BLEND_MODE, mode);
                              fill(rectangle(16, 0, 32, 64));
                              vgSeti(VG_BLEND_MODE, VG_BLEND_SRC_OVER);
                              vgDestroyPaint(paint);
                              vgDestroyPaint(up);
                          },
                          {0, 0, 0, 0}),
                      3)
                << mode << " " << alpha;
}

TEST_F(Recordings, ClearingReplaces) {
    EXPECT_LE(difference(
                  [&] {
                      useColor({1, 0, 0, 1});
                      fill(wholeSurface());
                      const VGfloat green[] = {0, 0.5f, 0, 1}, glass[] = {0, 0, 1, 0.25f};
                      vgSetfv(VG_CLEAR_COLOR, 4, green);
                      vgClear(8, 4, 16, 40);
                      vgSetfv(VG_CLEAR_COLOR, 4, glass);
                      vgClear(30, 20, 12, 12);
                      const VGint rectangles[] = {40, 40, 8, 8, 44, 44, 12, 12};
                      vgSetiv(VG_SCISSOR_RECTS, 8, rectangles);
                      vgSeti(VG_SCISSORING, VG_TRUE);
                      vgClear(42, 0, 100, 100);
                      vgSeti(VG_SCISSORING, VG_FALSE);
                  },
                  {0, 0, 0, 0}),
              1);
}

TEST_F(Recordings, ShapesThatAbutLeaveNoSeam) {
    const auto halves = [&] {
        useColor({0.8f, 0.1f, 0.1f, 1});
        fill(newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH},
                     {-20, -20, 90, -20, 80, 90}));
        fill(newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH},
                     {-20, -20, 80, 90, -20, 100}));
    };
    const auto leak = [&] {
        int maximum = 0;
        for (int y = 4; y < 60; ++y)
            for (int x = 4; x < 60; ++x)
                maximum = std::max(maximum, pixel(x, y)[2]);
        return maximum - 26;
    };
    resetState();
    clear({1, 1, 1, 1});
    halves();
    EXPECT_GT(leak(), 60) << "layers blended one after the other show what is below";
    resetState();
    const Recording recording = record(halves);
    for (const VGfloat angle : {0.0f, 17.0f, 45.0f}) {
        resetState();
        vgTranslate(32, 32);
        vgScale(1.3f, 1.3f);
        vgRotate(angle);
        vgTranslate(-32, -32);
        clear({1, 1, 1, 1});
        vtmDrawRecording(recording.get());
        EXPECT_LE(leak(), 1) << angle;
    }
}

}  // namespace
}  // namespace vtm::openvg::testing
