/// \file
/// What the tests of recordings share: calls recorded and drawn, things to draw.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

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
        int maximum = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            maximum = std::max(maximum, std::abs(int(a[i]) - int(b[i])));
        return maximum;
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
inline constexpr int edgeTolerance = 3;

}  // namespace vtm::openvg::testing
