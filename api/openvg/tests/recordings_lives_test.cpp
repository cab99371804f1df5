// Recordings as objects: begun and ended, refused, drawn anywhere, kept as files.

#include <limits>

#include "api/openvg/tests/recordings_fixture.hpp"

namespace vtm::openvg::testing {
namespace {

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

TEST_F(Recordings, PixelsOfManyRegionsFollowTheState) {
    resetState();
    const Recording recording = record([&] {
        useColor({0.1f, 0.3f, 0.7f, 1});
        fill(wholeSurface());
        for (int i = 0; i < 12; ++i) {
            useColor({float(i) / 12, 1 - float(i) / 12, float(i % 3) / 2, 1});
            fill(ellipse(float(4 + 5 * i), float(8 + 17 * i % 48), 9, 25));
        }
        useColor({0.9f, 0.6f, 0.2f, 1});
        fill(star());
    });
    /// Under the state that `set` makes, over white.
    const auto drawn = [&](const std::function<void()>& set) {
        resetState();
        clear({1, 1, 1, 1});
        vgTranslate(32, 32);
        vgRotate(20);
        vgScale(1.6f, 1.5f);
        vgTranslate(-32, -32);
        set();
        vtmDrawRecording(recording.get());
        return pixels();
    };
    const std::vector<std::uint8_t> plain = drawn([] {});
    EXPECT_LE(largestDifference(plain, drawn([&] {
                                    vgMask(VG_INVALID_HANDLE, VG_FILL_MASK, 0, 0, side, side);
                                    vgSeti(VG_MASKING, VG_TRUE);
                                })),
              1);
    EXPECT_LE(largestDifference(plain, drawn([] { vgSeti(VG_BLEND_MODE, VG_BLEND_MULTIPLY); })), 1);
    EXPECT_EQ(plain, drawn([] { vgSeti(VG_BLEND_MODE, VG_BLEND_SRC); }));

    const std::vector<std::uint8_t> halved = drawn([] {
        const VGfloat values[] = {0.5f, 1, 1, 1, 0, 0, 0.25f, 0};
        vgSetfv(VG_COLOR_TRANSFORM_VALUES, 8, values);
        vgSeti(VG_COLOR_TRANSFORM, VG_TRUE);
    });
    const std::vector<std::uint8_t> cut = drawn([] {
        const VGint boxes[] = {0, 0, 20, 64, 31, 5, 3, 50};
        vgSetiv(VG_SCISSOR_RECTS, 8, boxes);
        vgSeti(VG_SCISSORING, VG_TRUE);
    });
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto at = [&](const std::vector<std::uint8_t>& bytes) {
                const std::uint8_t* p = &bytes[std::size_t(4 * (y * side + x))];
                return Rgba{p[0], p[1], p[2], p[3]};
            };
            const Rgba all = at(plain);
            ASSERT_TRUE(isNear(at(halved), {(all[0] + 1) / 2, all[1], std::min(all[2] + 64, 255), 255}, 1))
                << x << ", " << y;
            const bool isSeen = x < 20 || (x >= 31 && x < 34 && y >= 9 && y < 59);
            ASSERT_EQ(at(cut), isSeen ? all : (Rgba{255, 255, 255, 255})) << x << ", " << y;
        }
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
        {"vgGetPixels", [&] { vgGetPixels(image, 0, 0, 0, 0, 1, 1); }},
        {"vgCopyPixels", [&] { vgCopyPixels(0, 0, 8, 8, 1, 1); }},
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
