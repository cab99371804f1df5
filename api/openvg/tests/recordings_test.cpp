// Recordings: calls as one picture. What they draw is compared with what the same calls draw at once.

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <VG/vgext.h>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {
namespace {

using Recording = std::unique_ptr<VtmRecording, decltype(&vtmDestroyRecording)>;

class Recordings : public VgTest {
protected:
    static constexpr int side = 64;
    Recordings() : VgTest(side, side) {}

    /// Everything that changes how a recording is drawn.
    static void resetState() {
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
        vgLoadIdentity();
        vgSeti(VG_BLEND_MODE, VG_BLEND_SRC_OVER);
        for (const VGParamType name : {VG_MASKING, VG_SCISSORING, VG_COLOR_TRANSFORM})
            vgSeti(name, VG_FALSE);
    }

    static Recording record(const std::function<void()>& calls, VGfloat width = side, VGfloat height = side) {
        vtmBeginRecording(width, height);
        calls();
        Recording recording(vtmEndRecording(), vtmDestroyRecording);
        EXPECT_EQ(vgGetError(), VG_NO_ERROR) << vtmGetRecordingFault();
        EXPECT_TRUE(recording) << vtmGetRecordingFault();
        return recording;
    }

    std::vector<std::uint8_t> pixels() const {
        std::vector<std::uint8_t> bytes(side * side * 4);
        vtmReadSurface(surface, bytes.data(), side * 4);
        return bytes;
    }

    /// The largest difference between what calls draw at once and what their recording draws over the same.
    int difference(const std::function<void()>& calls, std::array<VGfloat, 4> ground = {1, 1, 1, 1}) {
        resetState();
        clear(ground);
        vgMask(VG_INVALID_HANDLE, VG_FILL_MASK, 0, 0, side, side);
        calls();
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        const std::vector<std::uint8_t> direct = pixels();
        resetState();
        const Recording recording = record(calls);
        resetState();
        clear(ground);
        const std::vector<std::uint8_t> empty = pixels();
        EXPECT_NE(direct, empty) << "the calls draw nothing";
        vtmDrawRecording(recording.get());
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        return largestDifference(direct, pixels());
    }

    static int largestDifference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
        int most = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            most = std::max(most, std::abs(int(a[i]) - int(b[i])));
        return most;
    }

    /// An error that a call leaves in a recording, and why.
    static std::pair<VGErrorCode, std::string> faultOf(const std::function<void()>& calls) {
        vgGetError();
        vtmBeginRecording(side, side);
        calls();
        const VGErrorCode error = vgGetError();
        const Recording recording(vtmEndRecording(), vtmDestroyRecording);
        EXPECT_EQ(recording == nullptr, vgGetError() == VTM_NOT_RECORDABLE_ERROR);
        return {error, vtmGetRecordingFault()};
    }

    static void usePaint(VGPaint paint) { vgSetPaint(paint, VG_FILL_PATH | VG_STROKE_PATH); }
    static void useColor(std::array<VGfloat, 4> color) {
        const VGPaint paint = newPaint(color);
        usePaint(paint);
        vgDestroyPaint(paint);
    }
    static void fill(VGPath path) {
        vgDrawPath(path, VG_FILL_PATH);
        vgDestroyPath(path);
    }
    static VGPath ellipse(VGfloat x, VGfloat y, VGfloat width, VGfloat height) {
        const VGPath path = newPath();
        vguEllipse(path, x, y, width, height);
        return path;
    }
    static VGPath wholeSurface() { return rectangle(0, 0, side, side); }
    static VGPath star() {
        return newPath(
            {VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH},
            {32, 60, 15, 8, 60, 40, 4, 40, 49, 8});
    }
    static VGPaint gradient(VGPaintType type, const std::vector<VGfloat>& place,
                            const std::vector<VGfloat>& stops, VGint spread, bool premultiplied = true) {
        const VGPaint paint = vgCreatePaint();
        vgSetParameteri(paint, VG_PAINT_TYPE, type);
        vgSetParameterfv(
            paint,
            type == VG_PAINT_TYPE_LINEAR_GRADIENT ? VG_PAINT_LINEAR_GRADIENT : VG_PAINT_RADIAL_GRADIENT,
            VGint(place.size()), place.data());
        vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, VGint(stops.size()), stops.data());
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE, spread);
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, premultiplied);
        return paint;
    }
    /// Red, green, blue and translucent yellow, three rows of five.
    static VGImage checks() {
        const VGImage image = newImage(VG_sRGBA_8888, 5, 3);
        const std::uint32_t colors[] = {0xFF0000FF, 0x00C000FF, 0x2040FFFF, 0xFFFF0080};
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x)
                vgImageSubData(image, &colors[(x + 2 * y) % 4], 4, VG_sRGBA_8888, x, y, 1, 1);
        return image;
    }
};

/// Both mix one edge in the same way, over the same. Each one's coverage is exact within a 255th, and over
/// white no colour here turns a 255th of coverage into more than one of 255 steps, but in what is rounded
/// twice.
constexpr int edgeTolerance = 3;
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
        int most = 0;
        for (int y = 4; y < 60; ++y)
            for (int x = 4; x < 60; ++x)
                most = std::max(most, pixel(x, y)[2]);
        return most - 26;
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

TEST_F(Recordings, AreDrawnUnderTheMatrix) {
    const auto shapes = [&] {
        useColor({0.1f, 0.2f, 0.6f, 1});
        fill(star());
        useColor({0.8f, 0.5f, 0, 0.5f});
        fill(ellipse(32, 6, 8, 8));
    };
    const auto place = [] {
        resetState();
        vgTranslate(40, 20);
        vgRotate(30);
        vgScale(1.7f, -0.6f);
        vgTranslate(-32, -32);
    };
    place();
    clear({1, 1, 1, 1});
    shapes();
    const std::vector<std::uint8_t> direct = pixels();
    resetState();
    const Recording recording = record(shapes);
    place();
    clear({1, 1, 1, 1});
    vtmDrawRecording(recording.get());
    EXPECT_LE(largestDifference(direct, pixels()), edgeTolerance);
}

TEST_F(Recordings, AreDrawnByTheStateOfNow) {
    resetState();
    const Recording recording = record([&] {
        useColor({1, 0, 0, 1});
        fill(wholeSurface());
    });
    resetState();
    clear({0, 0, 1, 1});
    const VGint box[] = {0, 0, 32, 64};
    vgSetiv(VG_SCISSOR_RECTS, 4, box);
    vgSeti(VG_SCISSORING, VG_TRUE);
    vgSeti(VG_BLEND_MODE, VG_BLEND_ADDITIVE);
    vtmDrawRecording(recording.get());
    EXPECT_EQ(pixel(10, 10), (Rgba{255, 0, 255, 255}));
    EXPECT_EQ(pixel(40, 10), (Rgba{0, 0, 255, 255}));
}

TEST_F(Recordings, LinearSurfacesGetTheSameLight) {
    useSurface(side, side, linear8888);
    constexpr int stepOfLight = 4;  // a byte of light more is as many encoded, near the darkest colour here
    EXPECT_LE(difference([&] {
                  useColor({0.2f, 0.4f, 0.7f, 1});
                  fill(star());
              }),
              stepOfLight);
}

TEST_F(Recordings, LeaveTheSurfaceAlone) {
    resetState();
    clear({0, 1, 0, 1});
    const std::vector<std::uint8_t> before = pixels();
    record([&] {
        vgClear(0, 0, side, side);
        useColor({1, 0, 0, 1});
        fill(wholeSurface());
        const VGPath path = star();
        vgRenderToMask(path, VG_FILL_PATH, VG_SET_MASK);
        vgDestroyPath(path);
    });
    EXPECT_EQ(pixels(), before);
    vgSeti(VG_MASKING, VG_TRUE);
    useColor({1, 0, 0, 1});
    fill(wholeSurface());
    EXPECT_EQ(pixel(0, 0), (Rgba{255, 0, 0, 255})) << "the mask is 1 as before";
}

TEST_F(Recordings, RefuseWhatAPictureCannotHold) {
    const VGImage image = checks();
    std::uint32_t word = 0;
    const std::pair<const char*, std::function<void()>> refused[] = {
        {"vgReadPixels", [&] { vgReadPixels(&word, 4, VG_sRGBA_8888, 0, 0, 1, 1); }},
        {"vgWritePixels", [&] { vgWritePixels(&word, 4, VG_sRGBA_8888, 0, 0, 1, 1); }},
        {"vgGetPixels", [&] { vgGetPixels(image, 0, 0, 0, 0, 1, 1); }},
        {"vgSetPixels", [&] { vgSetPixels(0, 0, image, 0, 0, 1, 1); }},
        {"vgCopyPixels", [&] { vgCopyPixels(0, 0, 8, 8, 1, 1); }},
        {"image", [&] { vgMask(image, VG_SET_MASK, 0, 0, 4, 4); }},
        {"mode",
         [&] {
             vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_STENCIL);
             vgDrawImage(image);
             vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_NORMAL);
         }},
        {"blend",
         [&] {
             vgSeti(VG_BLEND_MODE, VG_BLEND_DST_IN);
             fill(star());
         }},
        {"perspective",
         [&] {
             vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
             const VGfloat matrix[] = {1, 0, 0.01f, 0, 1, 0, 0, 0, 1};
             vgLoadMatrix(matrix);
             vgDrawImage(image);
         }},
    };
    for (const auto& [word_, calls] : refused) {
        resetState();
        const auto [error, fault] = faultOf([&] {
            fill(star());
            calls();
            vgClear(0, 0, 0, 0);  // illegal, but not the first error
        });
        EXPECT_EQ(error, VTM_NOT_RECORDABLE_ERROR) << word_;
        EXPECT_NE(fault.find(word_), std::string::npos) << fault;
        EXPECT_EQ(fault.rfind("call ", 0), 0u) << fault;
    }
    // Errors of OpenVG are what they always are: the call counts for nothing.
    const auto [error, fault] = faultOf([&] { vgDrawPath(VG_INVALID_HANDLE, VG_FILL_PATH); });
    EXPECT_EQ(error, VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(fault, "");
}

TEST_F(Recordings, BeginAndEndInTurn) {
    EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR, vtmEndRecording());
    for (const VGfloat bad : {0.0f, -1.0f, 1e7f, std::numeric_limits<VGfloat>::quiet_NaN()}) {
        EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR, vtmBeginRecording(bad, 10));
        EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR, vtmBeginRecording(10, bad));
    }
    vtmBeginRecording(10, 20);
    EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR, vtmBeginRecording(10, 10));
    const Recording recording(vtmEndRecording(), vtmDestroyRecording);
    ASSERT_TRUE(recording);
    EXPECT_EQ(vtmRecordingWidth(recording.get()), 10);
    EXPECT_EQ(vtmRecordingHeight(recording.get()), 20);
    EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR, vtmDrawRecording(nullptr));
    EXPECT_VG_ERROR(VG_NO_ERROR, vtmDrawRecording(recording.get()));
    const auto [error, fault] = faultOf([&] { vtmDrawRecording(recording.get()); });
    EXPECT_EQ(error, VTM_NOT_RECORDABLE_ERROR);
}

TEST_F(Recordings, AreFiles) {
    resetState();
    const Recording recording = record([&] {
        useColor({0.2f, 0.4f, 0.7f, 1});
        fill(star());
    });
    std::size_t size = 0;
    const void* const bytes = vtmGetRecordingBytes(recording.get(), &size);
    const Recording loaded(vtmLoadRecording(bytes, size), vtmDestroyRecording);
    ASSERT_TRUE(loaded);
    std::vector<std::vector<std::uint8_t>> drawn;
    for (const VtmRecording* one : {recording.get(), std::as_const(loaded).get()}) {
        clear({1, 1, 1, 1});
        vtmDrawRecording(one);
        drawn.push_back(pixels());
    }
    EXPECT_EQ(drawn[0], drawn[1]);
    EXPECT_EQ(vtmLoadRecording(nullptr, 0), nullptr);
    for (std::size_t cut = 0; cut < size; cut += 97)
        EXPECT_EQ(vtmLoadRecording(bytes, cut), nullptr) << cut;
}

TEST_F(Recordings, GoWithTheirContext) {
    VtmContext* const other = vtmCreateContext(nullptr);
    VtmSurface* const small = vtmCreateSurface(4, 4, &sRGBA8888);
    ASSERT_TRUE(vtmMakeCurrent(other, small));
    vtmBeginRecording(4, 4);
    fill(star());
    ASSERT_TRUE(vtmMakeCurrent(context, surface));
    vtmDestroyContext(other);
    vtmDestroySurface(small);
}

}  // namespace
}  // namespace vtm::openvg::testing
