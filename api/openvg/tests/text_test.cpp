// Section 11: fonts.

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

class TextTest : public VgTest {
protected:
    TextTest() {
        vgSetPaint(newPaint({1, 1, 1, 1}), VG_FILL_PATH | VG_STROKE_PATH);
        const std::array<VGfloat, 2> origin{1, 2}, escapement{3, 0.5f}, zero{0, 0};
        const VGPath path = rectangle(1, 2, 1, 1);
        vgSetGlyphToPath(font, 65, path, VG_FALSE, origin.data(), escapement.data());
        vgDestroyPath(path);
        const VGImage image = newImage({{255, 0, 0, 255}});
        vgSetGlyphToImage(font, 66, image, zero.data(), escapement.data());
        vgDestroyImage(image);
        vgSetGlyphToPath(font, 32, VG_INVALID_HANDLE, VG_FALSE, zero.data(), escapement.data());
    }
    static std::array<VGfloat, 2> origin() {
        std::array<VGfloat, 2> o{};
        vgGetfv(VG_GLYPH_ORIGIN, 2, o.data());
        return o;
    }
    static void moveTo(VGfloat x, VGfloat y) {
        const std::array<VGfloat, 2> o{x, y};
        vgSetfv(VG_GLYPH_ORIGIN, 2, o.data());
    }

    VGFont font = vgCreateFont(3);
    const Rgba white{255, 255, 255, 255}, red{255, 0, 0, 255}, nothing{0, 0, 0, 0};
};

TEST_F(TextTest, GlyphsKeepWhatTheyAreMadeOf) {
    EXPECT_EQ(vgGetParameteri(font, VG_FONT_NUM_GLYPHS), 3);
    vgDrawGlyph(font, 65, VG_FILL_PATH, VG_FALSE);  // its path was destroyed by the program
    EXPECT_EQ(pixel(0, 0), white);
    EXPECT_EQ(pixel(1, 0), nothing);
    vgClearGlyph(font, 65);
    EXPECT_EQ(vgGetParameteri(font, VG_FONT_NUM_GLYPHS), 2);
    const std::array<VGfloat, 2> zero{};
    vgSetGlyphToPath(font, 66, rectangle(0, 0, 1, 1), VG_TRUE, zero.data(), zero.data());
    EXPECT_EQ(vgGetParameteri(font, VG_FONT_NUM_GLYPHS), 2) << "replaced";
}

TEST_F(TextTest, OriginsAdvanceByEscapements) {
    moveTo(4, 5);
    vgDrawGlyph(font, 65, VG_FILL_PATH, VG_TRUE);
    EXPECT_EQ(origin(), (std::array<VGfloat, 2>{7, 5.5f}));
    EXPECT_EQ(pixel(4, 5), white);
    moveTo(7, 8);
    vgDrawGlyph(font, 66, VG_FILL_PATH, VG_TRUE);
    EXPECT_EQ(pixel(7, 8), red);
    vgDrawGlyph(font, 32, VG_FILL_PATH, VG_TRUE);
    EXPECT_EQ(origin(), (std::array<VGfloat, 2>{13, 9}));
    // Modes of 0 draw nothing and move on.
    moveTo(0, 0);
    vgDrawGlyph(font, 65, 0, VG_TRUE);
    EXPECT_EQ(origin(), (std::array<VGfloat, 2>{3, 0.5f}));
    EXPECT_EQ(pixel(0, 0), nothing);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(TextTest, AdjustmentsAreAdded) {
    const std::array<VGuint, 3> text{65, 32, 66};
    const std::array<VGfloat, 3> x{1, 2, 4}, y{0, 0.5f, 1};
    moveTo(0, 0);
    vgDrawGlyphs(font, 3, text.data(), x.data(), y.data(), VG_FILL_PATH, VG_FALSE);
    EXPECT_EQ(origin(), (std::array<VGfloat, 2>{9 + 7, 1.5f + 1.5f}));
    moveTo(0, 0);
    vgDrawGlyphs(font, 3, text.data(), nullptr, nullptr, 0, VG_FALSE);
    EXPECT_EQ(origin(), (std::array<VGfloat, 2>{9, 1.5f}));
    // The image was drawn at (9, 1.5): half of two rows.
    EXPECT_EQ(pixel(9, 1)[0], 255);
    EXPECT_NEAR(pixel(9, 1)[3], 128, 2);
    EXPECT_NEAR(pixel(9, 2)[3], 128, 2);
    // An unknown glyph stops all, before anything is drawn.
    moveTo(0, 0);
    const std::array<VGuint, 2> wrong{65, 1};
    EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR,
                    vgDrawGlyphs(font, 2, wrong.data(), nullptr, nullptr, 0, VG_FALSE));
    EXPECT_EQ(origin(), (std::array<VGfloat, 2>{0, 0}));
}

TEST_F(TextTest, TheGlyphMatrixIsUsed) {
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
    vgTranslate(2, 3);
    vgScale(4, 4);
    moveTo(1, 1);
    vgDrawGlyph(font, 65, VG_FILL_PATH, VG_FALSE);
    EXPECT_EQ(pixel(6, 7), white);
    EXPECT_EQ(pixel(9, 10), white);
    EXPECT_EQ(pixel(10, 10), nothing);
    EXPECT_EQ(pixel(5, 7), nothing);
    vgDestroyFont(font);
    EXPECT_VG_ERROR(VG_BAD_HANDLE_ERROR, vgDrawGlyph(font, 65, VG_FILL_PATH, VG_FALSE));
}

// Coverage is kept, by matrix and place.
TEST_F(TextTest, GlyphsThatAreDrawnAgainAreThoseOfTheirPaths) {
    const VGPath path =
        newPath({VG_MOVE_TO_ABS, VG_QUAD_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH}, {0, 0, 9, 2, 7, 9, -2, 6});
    const std::array<VGfloat, 2> zero{};
    vgSetGlyphToPath(font, 70, path, VG_FALSE, zero.data(), zero.data());
    useSurface(40, 40, linear8888);
    const auto pixels = [](auto&& draw) {
        clear({0, 0, 0, 1});
        draw();
        std::vector<std::uint32_t> words(40 * 40);
        vgReadPixels(words.data(), 160, VG_lRGBA_8888, 0, 0, 40, 40);
        return words;
    };
    const auto expectSame = [&](const std::string& what) {
        const auto ofPath = pixels([&] { vgDrawPath(path, VG_FILL_PATH | VG_STROKE_PATH); });
        const auto glyph = [&] { vgDrawGlyph(font, 70, VG_FILL_PATH | VG_STROKE_PATH, VG_FALSE); };
        const auto first = pixels(glyph), again = pixels(glyph);
        EXPECT_EQ(first, again) << what;
        int wrong = 0;
        for (std::size_t i = 0; i < first.size(); ++i)
            wrong += !isNear(rgbaOf(first[i]), rgbaOf(ofPath[i]), 1);
        EXPECT_EQ(wrong, 0) << what;
    };
    for (const VGfloat scale : {0.7f, 1.3f, 9.0f})  // the last one is not kept
        for (const VGfloat angle : {0.0f, 33.0f, 180.0f})
            for (const VGfloat place : {-3.0f, 0.1f, 12.349f, 39.998f}) {
                for (const auto mode : {VG_MATRIX_GLYPH_USER_TO_SURFACE, VG_MATRIX_PATH_USER_TO_SURFACE}) {
                    vgSeti(VG_MATRIX_MODE, mode);
                    vgLoadIdentity();
                    vgTranslate(place, 10.77f);
                    vgRotate(angle);
                    vgScale(scale, scale);
                }
                expectSame(std::to_string(scale) + " " + std::to_string(angle) + " " + std::to_string(place));
            }
    append(path, {VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS}, {1, 1, 3, 1, 3, 5});
    expectSame("edited");
    const std::array<VGint, 8> scissor{3, 2, 5, 20, 20, 11, 10, 3};
    vgSetiv(VG_SCISSOR_RECTS, 8, scissor.data());
    vgSeti(VG_SCISSORING, VG_TRUE);
    expectSame("scissored");
}

/// A line of text in four ways of colours, surfaces and states, glyph by glyph as paths and in one call: the
/// same within 1/255. Places are those that the cache keeps.
class GlyphLine : public TextTest {
protected:
    static constexpr int width = 90, height = 24;

    GlyphLine() {
        const std::array<VGfloat, 2> zero{}, next{11.25f, 0.125f};
        for (VGuint i = 0; i < 5; ++i) {
            const auto s = VGfloat(i);
            paths_[i] = newPath({VG_MOVE_TO_ABS, VG_CUBIC_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH},
                                {1, 1, 4 + s, -2, 12, 6 + s, 7 - s, 12, 2, 9 - s});
            vgSetGlyphToPath(font, 100 + i, paths_[i], VG_FALSE, zero.data(), next.data());
        }
    }
    static void loadMatrix(VGMatrixMode mode, VGfloat x, VGfloat y) {
        vgSeti(VG_MATRIX_MODE, mode);
        vgLoadIdentity();
        vgTranslate(x, y);
        vgScale(1.25f, 1.25f);
    }
    template <class Draw>
    static std::vector<std::uint32_t> pixels(const VtmSurfaceFormat& format,
                                             const std::array<VGfloat, 4>& ground, Draw&& draw) {
        clear(ground);
        draw();
        const VGImageFormat read = format.linear ? format.premultiplied ? VG_lRGBA_8888_PRE : VG_lRGBA_8888
                                   : format.premultiplied ? VG_sRGBA_8888_PRE
                                                          : VG_sRGBA_8888;
        std::vector<std::uint32_t> words(width * height);
        vgReadPixels(words.data(), 4 * width, read, 0, 0, width, height);
        return words;
    }
    void expectSame(const VtmSurfaceFormat& format, const std::array<VGfloat, 4>& ground, VGbitfield modes,
                    VGfloat x, const std::string& what) {
        useSurface(width, height, format);
        const std::array<VGuint, 7> text{100, 103, 101, 104, 102, 100, 103};
        const auto byPath = pixels(format, ground, [&] {
            for (std::size_t i = 0; i < text.size(); ++i) {
                loadMatrix(VG_MATRIX_PATH_USER_TO_SURFACE, x + 1.25f * 11.25f * VGfloat(i),
                           3.5f + 1.25f * 0.125f * VGfloat(i));
                vgDrawPath(paths_[text[i] - 100], modes);
            }
        });
        loadMatrix(VG_MATRIX_GLYPH_USER_TO_SURFACE, x, 3.5f);
        for (int again = 0; again < 2; ++again) {
            const auto together = pixels(format, ground, [&] {
                moveTo(0, 0);
                vgDrawGlyphs(font, VGint(text.size()), text.data(), nullptr, nullptr, modes, VG_FALSE);
            });
            int wrong = 0;
            for (std::size_t i = 0; i < together.size(); ++i)
                wrong += !isNear(rgbaOf(together[i]), rgbaOf(byPath[i]), 1);
            EXPECT_EQ(wrong, 0) << what << ", drawn " << again;
        }
    }
    void expectSameEverywhere(const std::string& what) {
        for (const bool linear : {false, true})
            for (const bool premultiplied : {false, true})
                for (const VGint alpha : {0, 8})
                    for (const std::array<VGfloat, 4>& ground : {std::array<VGfloat, 4>{1, 1, 1, 1},
                                                                 {0, 0, 0, 1},
                                                                 {0.8f, 0.3f, 0.1f, 1},
                                                                 {0, 0, 0, 0},
                                                                 {0.2f, 0.9f, 0.4f, 0.5f}})
                        for (const VGfloat x : {-4.25f, 2.5f})  // cut off on the left, on the right
                            expectSame({8, 8, 8, alpha, 0, 8, VGboolean(linear), VGboolean(premultiplied)},
                                       ground, mode_, x,
                                       what + (linear ? ", linear" : ", sRGB") +
                                           (premultiplied ? ", premultiplied" : "") + ", alpha " +
                                           std::to_string(alpha) + ", ground " + std::to_string(ground[1]) +
                                           " at " + std::to_string(x));
    }

    std::array<VGPath, 5> paths_;
    VGbitfield mode_ = VG_FILL_PATH;
};

TEST_F(GlyphLine, IsThatOfItsPaths) {
    for (const std::array<VGfloat, 4>& ink : {std::array<VGfloat, 4>{0, 0, 0, 1},
                                              {1, 1, 1, 1},
                                              {0.9f, 0.1f, 0.4f, 1},
                                              {0, 0, 0, 0.5f},
                                              {0.2f, 0.7f, 1, 0.25f},
                                              {1, 1, 1, 0}}) {
        vgSetPaint(newPaint(ink), VG_FILL_PATH | VG_STROKE_PATH);
        expectSameEverywhere("ink " + std::to_string(ink[0]) + " " + std::to_string(ink[3]));
    }
}

TEST_F(GlyphLine, InEveryState) {
    vgSetPaint(newPaint({0.9f, 0.1f, 0.4f, 0.75f}), VG_FILL_PATH | VG_STROKE_PATH);
    vgSeti(VG_BLEND_MODE, VG_BLEND_SRC);
    expectSameEverywhere("VG_BLEND_SRC");
    vgSeti(VG_BLEND_MODE, VG_BLEND_SRC_OVER);
    const std::array<VGint, 8> scissor{3, 2, 40, 9, 30, 6, 25, 18};
    vgSetiv(VG_SCISSOR_RECTS, 8, scissor.data());
    vgSeti(VG_SCISSORING, VG_TRUE);
    expectSameEverywhere("scissored by two");
    vgSetiv(VG_SCISSOR_RECTS, 4, scissor.data());
    expectSameEverywhere("scissored");
    vgSetiv(VG_SCISSOR_RECTS, 0, nullptr);
    expectSameEverywhere("scissored by none");
    vgSeti(VG_SCISSORING, VG_FALSE);
    mode_ = VG_STROKE_PATH;
    expectSameEverywhere("stroked");
    mode_ = VG_FILL_PATH | VG_STROKE_PATH;
    expectSameEverywhere("both");
    mode_ = VG_FILL_PATH;
    vgSeti(VG_RENDERING_QUALITY, VG_RENDERING_QUALITY_NONANTIALIASED);
    expectSameEverywhere("not antialiased");
}

// On one ground again and again: what came out before.
TEST_F(GlyphLine, OnAFlatGround) {
    for (const VGint alpha : {0, 8})
        for (const std::array<VGfloat, 4>& ink :
             {std::array<VGfloat, 4>{0, 0, 0, 1}, {1, 1, 1, 1}, {0.9f, 0.1f, 0.4f, 1}})
            for (const std::array<VGfloat, 4>& ground :
                 {std::array<VGfloat, 4>{1, 1, 1, 1}, {0, 0, 0, 1}, {0.8f, 0.3f, 0.1f, 1}, {0, 0, 0, 0}}) {
                vgSetPaint(newPaint(ink), VG_FILL_PATH | VG_STROKE_PATH);
                const VtmSurfaceFormat format{8, 8, 8, alpha, 0, 0, VG_FALSE, VG_TRUE};
                for (int i = 0; i < 40; ++i)
                    expectSame(format, ground, VG_FILL_PATH, 2.5f,
                               "ink " + std::to_string(ink[0]) + ", ground " + std::to_string(ground[0]));
            }
}

// Also where another ground begins within glyphs, and where they overlap.
TEST_F(GlyphLine, DrawnAgainIsTheSame) {
    const std::array<VGuint, 7> text{100, 103, 101, 104, 102, 100, 103};
    for (const VGint alpha : {0, 8})
        for (const std::array<VGfloat, 4>& ink : {std::array<VGfloat, 4>{0, 0, 0, 1}, {0.9f, 0.1f, 0.4f, 1}})
            for (const int column : {0, 5, 20, 47, 48})
                for (const VGfloat closer : {0.0f, -6.0f}) {
                    vgSetPaint(newPaint(ink), VG_FILL_PATH | VG_STROKE_PATH);
                    useSurface(width, height, {8, 8, 8, alpha, 0, 0, VG_FALSE, VG_TRUE});
                    loadMatrix(VG_MATRIX_GLYPH_USER_TO_SURFACE, 2.5f, 3.5f);
                    std::array<VGfloat, 7> adjustments;
                    adjustments.fill(closer);
                    const auto drawn = [&] {
                        return pixels({8, 8, 8, alpha, 0, 0, VG_FALSE, VG_TRUE}, {1, 1, 1, 1}, [&] {
                            const std::array<VGfloat, 4> other{0.2f, 0.9f, 0.4f, 1};
                            vgSetfv(VG_CLEAR_COLOR, 4, other.data());
                            vgClear(0, 0, column, height);
                            moveTo(0, 0);
                            vgDrawGlyphs(font, 7, text.data(), adjustments.data(), nullptr, VG_FILL_PATH,
                                         VG_FALSE);
                        });
                    };
                    const auto first = drawn();
                    for (int again = 0; again < 4; ++again)
                        EXPECT_EQ(drawn(), first)
                            << "ink " << ink[0] << ", column " << column << ", " << closer;
                }
}

// Up to the last pixel of a surface's memory.
TEST_F(GlyphLine, DrawnAgainAtTheEnd) {
    const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE};
    useSurface(width, height, format);
    vgSetPaint(newPaint({0, 0, 0, 1}), VG_FILL_PATH);
    for (const VGuint glyph : {100u, 101u, 102u, 103u, 104u})
        for (int back = 0; back < 24; ++back) {
            loadMatrix(VG_MATRIX_GLYPH_USER_TO_SURFACE, VGfloat(width - back), VGfloat(height - back));
            const auto drawn = [&] {
                return pixels(format, {1, 1, 1, 1}, [&] {
                    moveTo(0, 0);
                    vgDrawGlyph(font, glyph, VG_FILL_PATH, VG_FALSE);
                });
            };
            const auto first = drawn();
            for (int again = 0; again < 3; ++again)
                EXPECT_EQ(drawn(), first) << glyph << ", " << back;
        }
}

// More than is kept: what was forgotten is covered anew.
TEST_F(GlyphLine, ManyPlaces) {
    const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE};
    useSurface(width, height, format);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
    const auto drawn = [&](VGfloat x) {
        vgLoadIdentity();
        vgTranslate(x, 3);
        return pixels(format, {1, 1, 1, 1}, [&] {
            moveTo(0, 0);
            vgDrawGlyph(font, 103, VG_FILL_PATH, VG_FALSE);
        });
    };
    const auto first = drawn(2.25f);
    for (int i = 0; i < 1024; ++i)
        for (int k = 0; k < 24; ++k) {
            vgLoadIdentity();
            vgTranslate(2 + VGfloat(i) / 1024, 2 + VGfloat(k) / 1024);
            moveTo(0, 0);
            vgDrawGlyph(font, 103, VG_FILL_PATH, VG_FALSE);
        }
    EXPECT_EQ(drawn(2.25f), first);
}

}  // namespace

}  // namespace vtm::openvg::testing
