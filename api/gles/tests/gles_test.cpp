// What OpenVG drew, in framebuffers of a GLES context that is the program's own.

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <GLES3/gl3.h>
#include <VG/vgu.h>
#include <vtm/gles.h>

#include <vtm/gl/context.hpp>

namespace vtm {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr int side = 32;

class Gles : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        try {
            context = std::make_unique<gl::Context>();
        } catch (const gl::GlError& error) {
            refusal = error.what();
        }
    }
    static void TearDownTestSuite() { context.reset(); }

    void SetUp() override {
        if (!context)
            GTEST_SKIP() << refusal;
        vg = vtmCreateContext(nullptr);
        use({8, 8, 8, 8, 0, 8, VG_FALSE, VG_TRUE});
        gl = vtmCreateGl();
        ASSERT_TRUE(gl) << vtmGetGlFault();
    }
    void TearDown() override {
        if (!context)
            return;
        vtmDestroyGl(gl);
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroySurface(surface);
        vtmDestroyContext(vg);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteTextures(1, &texture);
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    }

    /// A surface, in place of what was.
    void use(const VtmSurfaceFormat& format) {
        VtmSurface* const other = vtmCreateSurface(side, side, &format);
        ASSERT_TRUE(vtmMakeCurrent(vg, other));
        vtmDestroySurface(surface);
        surface = other;
    }

    /// A framebuffer whose pixels are `ground`; it stays bound.
    void target(GLenum format, int width, int height, std::array<float, 4> ground = {0, 0, 0, 0}) {
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        glClearBufferfv(GL_COLOR, 0, ground.data());
        columns = width;
        rows = height;
    }
    /// From the framebuffer's first row on.
    Bytes shown() const {
        Bytes bytes(std::size_t(columns * rows) * 4);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glReadPixels(0, 0, columns, rows, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        return bytes;
    }
    /// Of the surface, the lowest row first.
    Bytes drawn() const {
        Bytes bytes(side * side * 4);
        for (int y = 0; y < side; ++y)
            vtmReadSurfacePart(surface, 0, y, side, 1, &bytes[std::size_t(y) * side * 4], side * 4);
        return bytes;
    }
    static Bytes reversed(const Bytes& bytes) {
        Bytes result(bytes.size());
        for (std::size_t y = 0; y < side; ++y)
            std::memcpy(&result[(side - 1 - y) * side * 4], &bytes[y * side * 4], side * 4);
        return result;
    }
    static int distance(const Bytes& a, const Bytes& b) {
        EXPECT_EQ(a.size(), b.size());
        int maximum = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            maximum = std::max(maximum, std::abs(int(a[i]) - int(b[i])));
        return maximum;
    }

    VtmGlTarget plain() const {
        VtmGlTarget result{};
        result.framebuffer = framebuffer;
        return result;
    }

    static void useColor(std::array<VGfloat, 4> color) {
        const VGPaint paint = vgCreatePaint();
        vgSetParameterfv(paint, VG_PAINT_COLOR, 4, color.data());
        vgSetPaint(paint, VG_FILL_PATH);
        vgDestroyPaint(paint);
    }
    static void ellipse(VGfloat x, VGfloat y, VGfloat width, VGfloat height) {
        const VGPath path =
            vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
        vguEllipse(path, x, y, width, height);
        vgDrawPath(path, VG_FILL_PATH);
        vgDestroyPath(path);
    }
    /// No two rows or columns that are alike in both halves; `ground` is what it is drawn on.
    static void picture(std::array<VGfloat, 4> ground) {
        vgSetfv(VG_CLEAR_COLOR, 4, ground.data());
        vgClear(0, 0, side, side);
        useColor({0.9f, 0.3f, 0.1f, 1});
        ellipse(10, 20, 14, 20);
        useColor({0.1f, 0.3f, 0.8f, 0.5f});
        ellipse(18, 9, 22, 11);
    }

    static inline std::unique_ptr<gl::Context> context;
    static inline std::string refusal;
    VtmContext* vg = nullptr;
    VtmSurface* surface = nullptr;
    VtmGl* gl = nullptr;
    GLuint texture = 0, framebuffer = 0;
    int columns = 0, rows = 0;
};

TEST_F(Gles, SurfacesAreShownAsTheyAre) {
    const VtmSurfaceFormat formats[] = {{8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE},
                                        {8, 8, 8, 8, 0, 0, VG_TRUE, VG_FALSE},
                                        {5, 6, 5, 0, 0, 0, VG_FALSE, VG_FALSE},
                                        {0, 0, 0, 0, 8, 0, VG_FALSE, VG_FALSE}};
    target(GL_RGBA8, side, side);
    for (const VtmSurfaceFormat& format : formats) {
        use(format);
        picture({0.2f, 0.2f, 0, 0.3f});
        VtmGlTarget where = plain();
        ASSERT_TRUE(vtmPresentGl(gl, surface, &where)) << vtmGetGlFault();
        EXPECT_EQ(shown(), drawn());
        where.upsideDown = VG_TRUE;
        ASSERT_TRUE(vtmPresentGl(gl, surface, &where)) << vtmGetGlFault();
        EXPECT_EQ(shown(), reversed(drawn()));
    }
}

TEST_F(Gles, SurfacesAreShownWhereTheyAreWanted) {
    target(GL_RGBA8, 48, 40, {0, 1, 0, 1});
    picture({0.2f, 0.2f, 0, 1});
    const Bytes before = drawn();
    for (const auto& [x, y] : {std::pair(10, 5), std::pair(-7, -9), std::pair(30, 20)}) {
        const std::array<float, 4> green{0, 1, 0, 1};
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glClearBufferfv(GL_COLOR, 0, green.data());
        VtmGlTarget where = plain();
        where.x = x;
        where.y = y;
        ASSERT_TRUE(vtmPresentGl(gl, surface, &where)) << vtmGetGlFault();
        const Bytes after = shown();
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const bool isInside = i >= x && j >= y && i < x + side && j < y + side;
                const std::array<std::uint8_t, 4> ground{0, 255, 0, 255};
                const std::uint8_t* want =
                    isInside ? &before[std::size_t((j - y) * side + i - x) * 4] : ground.data();
                ASSERT_EQ(std::memcmp(&after[std::size_t(j * columns + i) * 4], want, 4), 0)
                    << i << ' ' << j << " at " << x << ' ' << y;
            }
    }
}

TEST_F(Gles, OnlyWhatIsDamagedChanges) {
    target(GL_RGBA8, side, side);
    picture({1, 1, 1, 1});
    VtmGlTarget where = plain();
    ASSERT_TRUE(vtmPresentGl(gl, surface, &where));
    const Bytes before = shown();
    const VGfloat black[] = {0, 0, 0, 1};
    vgSetfv(VG_CLEAR_COLOR, 4, black);
    vgClear(0, 0, side, side);
    const VGint damage[] = {3, 4, 5, 6, 20, 28, 100, 2000000000, -5, -5, 7, 6, 1, 1, -3, 4};
    where.damage = damage;
    where.damageCount = 4;
    for (const VGboolean upsideDown : {VG_FALSE, VG_TRUE}) {
        where.upsideDown = upsideDown;
        where.damageCount = upsideDown ? 0 : 4;
        ASSERT_TRUE(vtmPresentGl(gl, surface, &where)) << vtmGetGlFault();
        const Bytes after = shown();
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const bool isDamaged =
                    (x >= 3 && x < 8 && y >= 4 && y < 10) || (x >= 20 && y >= 28) || (x < 2 && y < 1);
                const std::size_t i = std::size_t(y * side + x) * 4;
                if (isDamaged)
                    EXPECT_EQ(after[i] + after[i + 1] + after[i + 2], 0) << x << ' ' << y;
                else
                    EXPECT_EQ(std::memcmp(&after[i], &before[i], 4), 0) << x << ' ' << y;
            }
    }
}

TEST_F(Gles, TargetsTakeTheirNumbers) {
    const VGfloat color[] = {0.5f, 0.25f, 1, 0.5f};
    vgSetfv(VG_CLEAR_COLOR, 4, color);
    vgClear(0, 0, side, side);
    const auto first = [&](VtmGlTarget where) {
        where.framebuffer = framebuffer;
        EXPECT_TRUE(vtmPresentGl(gl, surface, &where)) << vtmGetGlFault();
        const Bytes bytes = shown();
        return std::array<int, 4>{bytes[0], bytes[1], bytes[2], bytes[3]};
    };
    const auto isNear = [](std::array<int, 4> a, std::array<int, 4> b) {
        for (std::size_t c = 0; c < 4; ++c)
            if (std::abs(a[c] - b[c]) > 1)
                return false;
        return true;
    };
    target(GL_RGBA8, side, side, {1, 1, 1, 1});
    VtmGlTarget where{};
    EXPECT_TRUE(isNear(first(where), {64, 32, 128, 128}));
    where.straight = VG_TRUE;
    EXPECT_TRUE(isNear(first(where), {128, 64, 255, 128}));
    where.linear = VG_TRUE;
    EXPECT_TRUE(isNear(first(where), {55, 13, 255, 128}));  // IEC 61966-2-1 of 0.5, 0.25
    const std::array<float, 4> white{1, 1, 1, 1};
    glClearBufferfv(GL_COLOR, 0, white.data());
    where = {};
    where.over = VG_TRUE;
    EXPECT_TRUE(isNear(first(where), {191, 159, 255, 255}));
}

TEST_F(Gles, SrgbFormatsShowTheSame) {
    target(GL_SRGB8_ALPHA8, side, side);
    picture({1, 0.8f, 0.5f, 1});
    const VtmGlTarget where = plain();
    ASSERT_TRUE(vtmPresentGl(gl, surface, &where)) << vtmGetGlFault();
    EXPECT_LE(distance(shown(), drawn()), 1);  // drivers may encode by table
}

TEST_F(Gles, RecordingsAreDrawnByShaders) {
    vtmBeginRecording(side, side);
    picture({1, 0.8f, 0.5f, 1});
    VtmRecording* const recording = vtmEndRecording();
    ASSERT_TRUE(recording) << vtmGetRecordingFault();
    VtmGlPicture* const uploaded = vtmUploadRecordingGl(gl, recording);
    ASSERT_TRUE(uploaded) << vtmGetGlFault();
    target(GL_RGBA8, side, side);
    for (const VGfloat angle : {0.0f, 25.0f}) {
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
        vgLoadIdentity();
        vgTranslate(3, -2);
        vgRotate(angle);
        vgScale(2, 1.5f);
        std::array<VGfloat, 9> matrix{};
        vgGetMatrix(matrix.data());
        // The picture's border is blended in other numbers, so it lies outside, or the ground is its own.
        const VGfloat ground[] = {1, 0.8f, 0.5f, 1};
        vgSetfv(VG_CLEAR_COLOR, 4, ground);
        vgClear(0, 0, side, side);
        vtmDrawRecording(recording);
        for (const VGboolean upsideDown : {VG_FALSE, VG_TRUE}) {
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
            glClearBufferfv(GL_COLOR, 0, ground);
            VtmGlTarget where = plain();
            where.over = VG_TRUE;
            where.upsideDown = upsideDown;
            ASSERT_TRUE(vtmDrawPictureGl(gl, uploaded, side, side, matrix.data(), &where)) << vtmGetGlFault();
            EXPECT_LE(distance(shown(), upsideDown ? reversed(drawn()) : drawn()), 3) << angle;
        }
    }
    vtmDestroyPictureGl(uploaded);
    vtmDestroyRecording(recording);
}

TEST_F(Gles, StateStaysAsItWas) {
    target(GL_RGBA8, side, side);
    GLuint other = 0;
    glGenTextures(1, &other);
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, other);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(1, 2, 3, 4);
    glScissor(5, 6, 7, 8);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 3);
    const auto state = [] {
        std::vector<GLint> values;
        for (const GLenum name : {GL_ACTIVE_TEXTURE, GL_TEXTURE_BINDING_2D, GL_DRAW_FRAMEBUFFER_BINDING,
                                  GL_READ_FRAMEBUFFER_BINDING, GL_VIEWPORT, GL_SCISSOR_BOX, GL_SCISSOR_TEST,
                                  GL_BLEND, GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_UNPACK_ROW_LENGTH,
                                  GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_ARRAY_BUFFER_BINDING}) {
            std::array<GLint, 4> v{};
            glGetIntegerv(GLenum(name), v.data());
            values.insert(values.end(), v.begin(), v.end());
        }
        return values;
    };
    const std::vector<GLint> before = state();
    picture({1, 1, 1, 1});
    for (const VGboolean over : {VG_FALSE, VG_TRUE}) {
        VtmGlTarget where = plain();
        where.over = over;
        ASSERT_TRUE(vtmPresentGl(gl, surface, &where)) << vtmGetGlFault();
        EXPECT_EQ(state(), before);
    }
    EXPECT_EQ(shown(), drawn()) << "whatever the state is";
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glActiveTexture(GL_TEXTURE0);
    glDeleteTextures(1, &other);
}

TEST_F(Gles, FaultsAreTold) {
    target(GL_RGBA8, side, side, {0, 1, 0, 1});
    const Bytes before = shown();
    const auto refused = [&](const std::function<void(VtmGlTarget&)>& change, const char* word) {
        VtmGlTarget where = plain();
        change(where);
        EXPECT_FALSE(vtmPresentGl(gl, surface, &where)) << word;
        EXPECT_NE(std::string(vtmGetGlFault()).find(word), std::string::npos) << vtmGetGlFault();
    };
    refused([](VtmGlTarget& t) { t.straight = t.over = VG_TRUE; }, "straight");
    refused([](VtmGlTarget& t) { t.framebuffer = 0; }, "framebuffer 0");
    const VGint one[4] = {0, 0, 1, 1};
    refused(
        [&](VtmGlTarget& t) {
            t.damage = one;
            t.damageCount = -1;
        },
        "negative");
    EXPECT_FALSE(vtmPresentGl(gl, nullptr, nullptr));
    EXPECT_FALSE(vtmUploadRecordingGl(gl, nullptr));

    vtmBeginRecording(side, side);
    VtmRecording* const recording = vtmEndRecording();
    VtmGlPicture* const picture = vtmUploadRecordingGl(gl, recording);
    const VtmGlTarget where = plain();
    const VGfloat perspective[9] = {1, 0, 0.1f, 0, 1, 0, 0, 0, 1};
    EXPECT_FALSE(vtmDrawPictureGl(gl, picture, side, side, perspective, &where));
    EXPECT_NE(std::string(vtmGetGlFault()).find("affine"), std::string::npos);
    EXPECT_EQ(shown(), before);
    vtmDestroyPictureGl(picture);
    vtmDestroyRecording(recording);

    const gl::Context second;
    EXPECT_FALSE(vtmPresentGl(gl, surface, &where));
    EXPECT_NE(std::string(vtmGetGlFault()).find("current"), std::string::npos) << vtmGetGlFault();
    context->makeCurrent();
}

}  // namespace
}  // namespace vtm
