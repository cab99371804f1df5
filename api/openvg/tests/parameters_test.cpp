// Sections 5.1 to 5.3: parameters of contexts and of objects.

#include <cmath>
#include <limits>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

using ParametersTest = VgTest;

/// Section 5.2.1, table 4.
struct Default {
    VGParamType type;
    std::vector<VGfloat> values;
};
const std::vector<Default> defaults{
    {VG_MATRIX_MODE, {VG_MATRIX_PATH_USER_TO_SURFACE}},
    {VG_FILL_RULE, {VG_EVEN_ODD}},
    {VG_IMAGE_QUALITY, {VG_IMAGE_QUALITY_FASTER}},
    {VG_RENDERING_QUALITY, {VG_RENDERING_QUALITY_BETTER}},
    {VG_BLEND_MODE, {VG_BLEND_SRC_OVER}},
    {VG_IMAGE_MODE, {VG_DRAW_IMAGE_NORMAL}},
    {VG_SCISSOR_RECTS, {}},
    {VG_COLOR_TRANSFORM, {0}},
    {VG_COLOR_TRANSFORM_VALUES, {1, 1, 1, 1, 0, 0, 0, 0}},
    {VG_STROKE_LINE_WIDTH, {1}},
    {VG_STROKE_CAP_STYLE, {VG_CAP_BUTT}},
    {VG_STROKE_JOIN_STYLE, {VG_JOIN_MITER}},
    {VG_STROKE_MITER_LIMIT, {4}},
    {VG_STROKE_DASH_PATTERN, {}},
    {VG_STROKE_DASH_PHASE, {0}},
    {VG_STROKE_DASH_PHASE_RESET, {0}},
    {VG_TILE_FILL_COLOR, {0, 0, 0, 0}},
    {VG_CLEAR_COLOR, {0, 0, 0, 0}},
    {VG_GLYPH_ORIGIN, {0, 0}},
    {VG_MASKING, {0}},
    {VG_SCISSORING, {0}},
    {VG_PIXEL_LAYOUT, {VG_PIXEL_LAYOUT_UNKNOWN}},
    {VG_SCREEN_LAYOUT, {VG_PIXEL_LAYOUT_UNKNOWN}},
    {VG_FILTER_FORMAT_LINEAR, {0}},
    {VG_FILTER_FORMAT_PREMULTIPLIED, {0}},
    {VG_FILTER_CHANNEL_MASK, {VG_RED | VG_GREEN | VG_BLUE | VG_ALPHA}},
};

TEST_F(ParametersTest, Defaults) {
    for (const Default& d : defaults) {
        SCOPED_TRACE(VGint(d.type));
        ASSERT_EQ(vgGetVectorSize(d.type), VGint(d.values.size()));
        std::vector<VGfloat> floats(d.values.size());
        std::vector<VGint> integers(d.values.size());
        if (!d.values.empty()) {
            vgGetfv(d.type, VGint(floats.size()), floats.data());
            vgGetiv(d.type, VGint(integers.size()), integers.data());
        }
        EXPECT_EQ(floats, d.values);
        EXPECT_EQ(std::vector<VGfloat>(integers.begin(), integers.end()), d.values);
        if (d.values.size() == 1) {
            EXPECT_EQ(vgGetf(d.type), d.values[0]);
            EXPECT_EQ(vgGeti(d.type), VGint(d.values[0]));
        }
        // Setting what was read changes nothing, by any of the four.
        vgSetfv(d.type, VGint(floats.size()), floats.data());
        vgSetiv(d.type, VGint(integers.size()), integers.data());
    }
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ParametersTest, LimitsAreAtLeastThoseOfTheSpecification) {
    EXPECT_GE(vgGeti(VG_MAX_SCISSOR_RECTS), 32);           // 7.1
    EXPECT_GE(vgGeti(VG_MAX_DASH_COUNT), 16);              // 8.7.5
    EXPECT_GE(vgGeti(VG_MAX_KERNEL_SIZE), 7);              // 12.4
    EXPECT_GE(vgGeti(VG_MAX_SEPARABLE_KERNEL_SIZE), 15);   // 12.4
    EXPECT_GE(vgGeti(VG_MAX_GAUSSIAN_STD_DEVIATION), 16);  // 12.4
    EXPECT_GE(vgGeti(VG_MAX_COLOR_RAMP_STOPS), 32);        // 9.3.3
    EXPECT_GE(vgGeti(VG_MAX_IMAGE_WIDTH), 256);            // 10.3
    EXPECT_GE(vgGeti(VG_MAX_IMAGE_HEIGHT), 256);
    EXPECT_GE(vgGeti(VG_MAX_IMAGE_PIXELS), 65536);
    EXPECT_GE(vgGeti(VG_MAX_IMAGE_BYTES), 65536);
    EXPECT_GE(vgGetf(VG_MAX_FLOAT), 1e10f);  // 3.3
}

TEST_F(ParametersTest, ReadOnlyOnesStayAsTheyAre) {
    for (const VGParamType type :
         {VG_MAX_SCISSOR_RECTS, VG_MAX_DASH_COUNT, VG_MAX_KERNEL_SIZE, VG_MAX_FLOAT,
          VG_MAX_SEPARABLE_KERNEL_SIZE, VG_MAX_COLOR_RAMP_STOPS, VG_MAX_IMAGE_WIDTH, VG_MAX_IMAGE_HEIGHT,
          VG_MAX_IMAGE_PIXELS, VG_MAX_IMAGE_BYTES, VG_MAX_GAUSSIAN_STD_DEVIATION, VG_SCREEN_LAYOUT}) {
        const VGint before = vgGeti(type), other = 3;
        vgSeti(type, other);
        vgSetf(type, 3);
        vgSetiv(type, 1, &other);
        EXPECT_EQ(vgGeti(type), before);
    }
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ParametersTest, IntegersAreFlooredAndSaturated) {
    const std::array<std::pair<VGfloat, VGint>, 5> cases{{{2.9f, 2},
                                                          {-2.1f, -3},
                                                          {1e30f, std::numeric_limits<VGint>::max()},
                                                          {-1e30f, std::numeric_limits<VGint>::min()},
                                                          {-0.0f, 0}}};
    for (const auto& [given, whole] : cases) {
        vgSetf(VG_STROKE_DASH_PHASE, given);
        EXPECT_EQ(vgGeti(VG_STROKE_DASH_PHASE), whole);
        EXPECT_EQ(vgGetf(VG_STROKE_DASH_PHASE), given) << "what was set comes back";
        const std::array<VGfloat, 4> rectangle{given, given, given, given};
        std::array<VGint, 4> integers{};
        vgSetfv(VG_SCISSOR_RECTS, 4, rectangle.data());
        vgGetiv(VG_SCISSOR_RECTS, 4, integers.data());
        EXPECT_EQ(integers[3], whole);
    }
    vgSetf(VG_FILL_RULE, VGfloat(VG_NON_ZERO) + 0.9f);
    EXPECT_EQ(vgGeti(VG_FILL_RULE), VG_NON_ZERO);
    vgSetf(VG_MASKING, 0.5f);
    EXPECT_EQ(vgGeti(VG_MASKING), 0);
    vgSetf(VG_MASKING, -0.5f);
    EXPECT_NE(vgGeti(VG_MASKING), 0);
}

TEST_F(ParametersTest, EveryEnumeratorComesBack) {
    const auto check = [](VGParamType type, VGint first, VGint last) {
        for (VGint value = first; value <= last; ++value) {
            vgSeti(type, value);
            EXPECT_EQ(vgGeti(type), value);
            EXPECT_EQ(vgGetf(type), VGfloat(value));
        }
        EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR, vgSeti(type, first - 1));
        EXPECT_VG_ERROR(VG_ILLEGAL_ARGUMENT_ERROR, vgSeti(type, last + 1));
        EXPECT_EQ(vgGeti(type), last) << "an error changes nothing";
    };
    check(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
    check(VG_FILL_RULE, VG_EVEN_ODD, VG_NON_ZERO);
    check(VG_RENDERING_QUALITY, VG_RENDERING_QUALITY_NONANTIALIASED, VG_RENDERING_QUALITY_BETTER);
    check(VG_BLEND_MODE, VG_BLEND_SRC, VG_BLEND_ADDITIVE);
    check(VG_IMAGE_MODE, VG_DRAW_IMAGE_NORMAL, VG_DRAW_IMAGE_STENCIL);
    check(VG_STROKE_CAP_STYLE, VG_CAP_BUTT, VG_CAP_SQUARE);
    check(VG_STROKE_JOIN_STYLE, VG_JOIN_MITER, VG_JOIN_BEVEL);
    check(VG_PIXEL_LAYOUT, VG_PIXEL_LAYOUT_UNKNOWN, VG_PIXEL_LAYOUT_BGR_HORIZONTAL);
    for (const VGint quality :
         {VG_IMAGE_QUALITY_NONANTIALIASED, VG_IMAGE_QUALITY_FASTER, VG_IMAGE_QUALITY_BETTER}) {
        vgSeti(VG_IMAGE_QUALITY, quality);
        EXPECT_EQ(vgGeti(VG_IMAGE_QUALITY), quality);
    }
}

TEST_F(ParametersTest, VectorsKeepWhatFits) {
    const VGint maximum = vgGeti(VG_MAX_DASH_COUNT);
    std::vector<VGfloat> dashes(std::size_t(maximum) + 3);
    for (std::size_t i = 0; i < dashes.size(); ++i)
        dashes[i] = VGfloat(i) - 1.5f;
    vgSetfv(VG_STROKE_DASH_PATTERN, VGint(dashes.size()), dashes.data());
    EXPECT_EQ(vgGetVectorSize(VG_STROKE_DASH_PATTERN), maximum);
    std::vector<VGfloat> read(2);
    vgGetfv(VG_STROKE_DASH_PATTERN, 2, read.data());  // the first ones only
    EXPECT_EQ(read, (std::vector<VGfloat>{-1.5f, -0.5f}));
    std::vector<VGint> whole(2);
    vgGetiv(VG_STROKE_DASH_PATTERN, 2, whole.data());
    EXPECT_EQ(whole, (std::vector<VGint>{-2, -1}));

    std::vector<VGint> rectangles(4 * std::size_t(vgGeti(VG_MAX_SCISSOR_RECTS)) + 4, 1);
    vgSetiv(VG_SCISSOR_RECTS, VGint(rectangles.size()), rectangles.data());
    EXPECT_EQ(vgGetVectorSize(VG_SCISSOR_RECTS), VGint(rectangles.size()) - 4);

    vgSetfv(VG_STROKE_DASH_PATTERN, 0, nullptr);
    EXPECT_EQ(vgGetVectorSize(VG_STROKE_DASH_PATTERN), 0);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ParametersTest, ColorsOutOfRangeComeBackAsTheyWere) {
    const std::array<VGfloat, 4> wild{-7, 3.5f, 1e20f, 0.25f};
    std::array<VGfloat, 4> read{};
    for (const VGParamType type : {VG_CLEAR_COLOR, VG_TILE_FILL_COLOR}) {
        vgSetfv(type, 4, wild.data());
        vgGetfv(type, 4, read.data());
        EXPECT_EQ(read, wild);
    }
}

TEST_F(ParametersTest, PaintDefaultsAndRoundTrips) {
    // Section 9.1.3, table 10.
    const VGPaint paint = vgCreatePaint();
    EXPECT_EQ(vgGetParameteri(paint, VG_PAINT_TYPE), VG_PAINT_TYPE_COLOR);
    EXPECT_EQ(vgGetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE), VG_COLOR_RAMP_SPREAD_PAD);
    EXPECT_EQ(vgGetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED), VG_TRUE);
    EXPECT_EQ(vgGetParameteri(paint, VG_PAINT_PATTERN_TILING_MODE), VG_TILE_FILL);
    EXPECT_EQ(vgGetParameterVectorSize(paint, VG_PAINT_COLOR_RAMP_STOPS), 0);
    const auto vector = [&](VGPaintParamType type) {
        std::vector<VGfloat> v(std::size_t(vgGetParameterVectorSize(paint, type)));
        vgGetParameterfv(paint, type, VGint(v.size()), v.data());
        return v;
    };
    EXPECT_EQ(vector(VG_PAINT_COLOR), (std::vector<VGfloat>{0, 0, 0, 1}));
    EXPECT_EQ(vector(VG_PAINT_LINEAR_GRADIENT), (std::vector<VGfloat>{0, 0, 1, 0}));
    EXPECT_EQ(vector(VG_PAINT_RADIAL_GRADIENT), (std::vector<VGfloat>{0, 0, 0, 0, 1}));

    const std::vector<VGfloat> numbers{0.5f, -1.25f, 3, 4, -5.5f};
    vgSetParameterfv(paint, VG_PAINT_COLOR, 4, numbers.data());
    vgSetParameterfv(paint, VG_PAINT_LINEAR_GRADIENT, 4, numbers.data());
    vgSetParameterfv(paint, VG_PAINT_RADIAL_GRADIENT, 5, numbers.data());
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, 5, numbers.data());
    EXPECT_EQ(vector(VG_PAINT_COLOR), std::vector<VGfloat>(numbers.begin(), numbers.end() - 1));
    EXPECT_EQ(vector(VG_PAINT_LINEAR_GRADIENT), std::vector<VGfloat>(numbers.begin(), numbers.end() - 1));
    EXPECT_EQ(vector(VG_PAINT_RADIAL_GRADIENT), numbers);
    EXPECT_EQ(vector(VG_PAINT_COLOR_RAMP_STOPS), numbers);
    std::array<VGint, 5> whole{};
    vgGetParameteriv(paint, VG_PAINT_COLOR_RAMP_STOPS, 5, whole.data());
    EXPECT_EQ(whole, (std::array<VGint, 5>{0, -2, 3, 4, -6}));
    const std::array<VGint, 4> given{1, 2, 3, 4};
    vgSetParameteriv(paint, VG_PAINT_COLOR, 4, given.data());
    EXPECT_EQ(vector(VG_PAINT_COLOR), (std::vector<VGfloat>{1, 2, 3, 4}));
    for (VGint type = VG_PAINT_TYPE_COLOR; type <= VG_PAINT_TYPE_PATTERN; ++type) {
        vgSetParameterf(paint, VG_PAINT_TYPE, VGfloat(type));
        EXPECT_EQ(vgGetParameterf(paint, VG_PAINT_TYPE), VGfloat(type));
    }
    for (VGint mode = VG_TILE_FILL; mode <= VG_TILE_REFLECT; ++mode) {
        vgSetParameteri(paint, VG_PAINT_PATTERN_TILING_MODE, mode);
        EXPECT_EQ(vgGetParameteri(paint, VG_PAINT_PATTERN_TILING_MODE), mode);
    }
    for (VGint mode = VG_COLOR_RAMP_SPREAD_PAD; mode <= VG_COLOR_RAMP_SPREAD_REFLECT; ++mode) {
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE, mode);
        EXPECT_EQ(vgGetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE), mode);
    }
    // Section 9.3.3: stops beyond the most are ignored.
    const std::vector<VGfloat> many(5 * std::size_t(vgGeti(VG_MAX_COLOR_RAMP_STOPS)) + 5);
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, VGint(many.size()), many.data());
    EXPECT_EQ(vgGetParameterVectorSize(paint, VG_PAINT_COLOR_RAMP_STOPS), VGint(many.size()) - 5);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ParametersTest, PathsImagesAndFonts) {
    const VGPath path = newPath(VG_PATH_DATATYPE_S_16, 0.5f, -3);
    const VGubyte command = VG_QUAD_TO_REL;
    const std::array<VGshort, 4> data{};
    vgAppendPathData(path, 1, &command, data.data());
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_FORMAT), VG_PATH_FORMAT_STANDARD);
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_DATATYPE), VG_PATH_DATATYPE_S_16);
    EXPECT_EQ(vgGetParameterf(path, VG_PATH_SCALE), 0.5f);
    EXPECT_EQ(vgGetParameterf(path, VG_PATH_BIAS), -3);
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), 1);
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_COORDS), 4);
    const VGImage image = newImage(VG_sBGR_565, 7, 5);
    EXPECT_EQ(vgGetParameteri(image, VG_IMAGE_FORMAT), VG_sBGR_565);
    EXPECT_EQ(vgGetParameteri(image, VG_IMAGE_WIDTH), 7);
    EXPECT_EQ(vgGetParameteri(image, VG_IMAGE_HEIGHT), 5);
    EXPECT_EQ(vgGetParameteri(vgCreateFont(9), VG_FONT_NUM_GLYPHS), 0);
}

}  // namespace

}  // namespace vtm::openvg::testing
