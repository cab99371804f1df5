// EGL specification section 3.4.

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include <vtm/egl.h>
#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

class Configs : public EglTest {
protected:
    /// Red, green, blue, alpha, luminance.
    using Sizes = std::array<EGLint, 5>;

    using Order = std::vector<Sizes>;

    Sizes sizes(EGLConfig c) const {
        return {value(c, EGL_RED_SIZE), value(c, EGL_GREEN_SIZE), value(c, EGL_BLUE_SIZE),
                value(c, EGL_ALPHA_SIZE), value(c, EGL_LUMINANCE_SIZE)};
    }

    /// Of pbuffers for OpenVG with these attributes besides, in order.
    std::vector<EGLConfig> chosenConfigs(Attributes attributes) const {
        attributes.insert(attributes.end(),
                          {EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT});
        return choose(attributes);
    }
    /// Those with as many samples.
    std::vector<Sizes> chosen(const Attributes& attributes, EGLint samples = 0) const {
        std::vector<Sizes> result;
        for (const EGLConfig c : chosenConfigs(attributes))
            if (value(c, EGL_SAMPLES) == samples)
                result.push_back(sizes(c));
        return result;
    }

    /// Rule 7: formats that OpenGL draws into as well have depth, and come behind others with as many bits.
    Order converted() const {
        Order order{rgb565, rgba5551, rgba4444};
        std::ranges::stable_sort(
            order, {}, [&](const Sizes& s) { return value(config(s[0], s[1], s[2], s[3]), EGL_DEPTH_SIZE); });
        return order;
    }

    static constexpr Sizes rgba8888{8, 8, 8, 8, 0}, rgbx8888{8, 8, 8, 0, 0}, rgb565{5, 6, 5, 0, 0},
        rgba5551{5, 5, 5, 1, 0}, rgba4444{4, 4, 4, 4, 0}, a8{0, 0, 0, 8, 0}, l8{0, 0, 0, 0, 8},
        l1{0, 0, 0, 0, 1};
};

TEST_F(Configs, EveryFormatIsThereWithAndWithoutSamples) {
    const Attributes anyColors{EGL_COLOR_BUFFER_TYPE, EGL_DONT_CARE};
    EXPECT_EQ(chosenConfigs(anyColors).size(), 16u);
    for (const EGLint samples : {0, 4}) {
        const Order all = chosen(anyColors, samples);
        EXPECT_EQ(all.size(), 8u);
        EXPECT_EQ(std::set<Sizes>(all.begin(), all.end()),
                  (std::set<Sizes>{rgba8888, rgbx8888, rgb565, rgba5551, rgba4444, a8, l8, l1}));
    }
}

TEST_F(Configs, SamplesMayBeAskedFor) {
    const Order smallestFirst{rgbx8888, rgba8888, a8, rgb565, rgba5551, rgba4444};
    for (const Attributes& asked :
         {Attributes{EGL_SAMPLE_BUFFERS, 1}, Attributes{EGL_SAMPLE_BUFFERS, 1, EGL_SAMPLES, 4},
          Attributes{EGL_SAMPLES, 1}, Attributes{EGL_SAMPLES, 4}}) {
        EXPECT_EQ(chosen(asked), Order{}) << "all that are found have samples";
        EXPECT_EQ(chosen(asked, 4), smallestFirst);
    }
    EXPECT_EQ(chosen({EGL_SAMPLES, 4, EGL_RED_SIZE, 8, EGL_ALPHA_SIZE, 8}, 4), Order{rgba8888});
    EXPECT_TRUE(chosenConfigs({EGL_SAMPLES, 5}).empty());
}

// Rules 5 and 6: of as many bits, fewer samples come first. Rule 4, fewer bits, is before that.
TEST_F(Configs, WithoutSamplesComesFirst) {
    using Found = std::vector<std::pair<Sizes, EGLint>>;
    const auto found = [&](const Attributes& attributes) {
        Found result;
        for (const EGLConfig c : chosenConfigs(attributes))
            result.emplace_back(sizes(c), value(c, EGL_SAMPLES));
        return result;
    };
    EXPECT_EQ(found({EGL_CONFIG_CAVEAT, EGL_NONE}),
              (Found{{rgbx8888, 0}, {rgbx8888, 4}, {rgba8888, 0}, {rgba8888, 4}}));
    EXPECT_EQ(found({EGL_CONFIG_CAVEAT, EGL_NONE, EGL_ALPHA_SIZE, 8, EGL_SAMPLES, EGL_DONT_CARE}),
              (Found{{rgba8888, 0}, {rgba8888, 4}}));
    EXPECT_EQ(found({EGL_COLOR_BUFFER_TYPE, EGL_LUMINANCE_BUFFER}),
              (Found{{l1, 0}, {l1, 4}, {l8, 0}, {l8, 4}}));
}

TEST_F(Configs, OpenGlDoesNotDrawIntoSamples) {
    EXPECT_TRUE(choose({EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT | EGL_OPENVG_BIT, EGL_SURFACE_TYPE,
                        EGL_PBUFFER_BIT, EGL_SAMPLES, 4})
                    .empty());
}

TEST_F(Configs, TheirAttributesAreThoseOfOpenVg) {
    for (const EGLConfig c : choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                     EGL_COLOR_BUFFER_TYPE, EGL_DONT_CARE})) {
        const EGLint type = EGL_PBUFFER_BIT | EGL_VG_COLORSPACE_LINEAR_BIT | EGL_VG_ALPHA_FORMAT_PRE_BIT;
        EXPECT_EQ(value(c, EGL_SURFACE_TYPE) & type, type);
        EXPECT_EQ((value(c, EGL_CONFORMANT) & EGL_OPENVG_BIT) != 0, value(c, EGL_SAMPLES) == 0);
        EXPECT_EQ(value(c, EGL_ALPHA_MASK_SIZE), 8);
        EXPECT_EQ(value(c, EGL_SAMPLE_BUFFERS), value(c, EGL_SAMPLES) == 4);
        const Sizes s = sizes(c);
        EXPECT_EQ(value(c, EGL_BUFFER_SIZE), s[0] + s[1] + s[2] + s[3] + s[4]);
        EXPECT_EQ(value(c, EGL_COLOR_BUFFER_TYPE), s[4] ? EGL_LUMINANCE_BUFFER : EGL_RGB_BUFFER);
        EXPECT_GE(value(c, EGL_MAX_PBUFFER_WIDTH), 4096);
    }
}

TEST_F(Configs, EveryAttributeOfTheTableIsThere) {
    const EGLConfig c = config(8, 8, 8, 8);
    // These numbers are those of table 3.1, less two that are none and one that only chooses.
    for (EGLint name = EGL_BUFFER_SIZE; name <= EGL_CONFORMANT; ++name) {
        EGLint ignored = 0;
        const bool isAttribute = name != 0x3030 && name != EGL_NONE && name != EGL_MATCH_NATIVE_PIXMAP;
        EXPECT_EQ(eglGetConfigAttrib(display, c, name, &ignored), EGLBoolean(isAttribute))
            << std::hex << name;
        EXPECT_EGL_ERROR(isAttribute ? EGL_SUCCESS : EGL_BAD_ATTRIBUTE);
    }
}

TEST_F(Configs, IdsAreDistinctAndFindTheirConfig) {
    EGLint count = 0;
    ASSERT_EGL(eglGetConfigs(display, nullptr, 0, &count));
    std::vector<EGLConfig> all(std::size_t(count), nullptr);
    ASSERT_EGL(eglGetConfigs(display, all.data(), count, &count));
    std::set<EGLint> ids;
    for (const EGLConfig c : all) {
        const EGLint id = value(c, EGL_CONFIG_ID);
        EXPECT_TRUE(ids.insert(id).second);
        // All other attributes are ignored.
        EXPECT_EQ(choose({EGL_CONFIG_ID, id, EGL_RED_SIZE, 99}), std::vector{c});
    }
    EXPECT_EQ(*ids.begin(), 1);
    EXPECT_EQ(*ids.rbegin(), count);
    // Twice as many of ours follow, for who asks for their compositor.
    EXPECT_EQ(choose({EGL_CONFIG_ID, count + 1}).size(), 1u);
    EXPECT_TRUE(choose({EGL_CONFIG_ID, count + 33}).empty());
}

TEST_F(Configs, NoMoreAreGivenThanThereIsRoomFor) {
    std::array<EGLConfig, 3> few{};
    few[2] = this;
    EGLint count = 0;
    ASSERT_EGL(eglGetConfigs(display, few.data(), 2, &count));
    EXPECT_EQ(count, 2);
    EXPECT_EQ(few[2], this);
    const EGLint attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    ASSERT_EGL(eglChooseConfig(display, attributes, few.data(), 2, &count));
    EXPECT_EQ(count, 2);
    EXPECT_EQ(few[2], this);
    EXPECT_FALSE(eglGetConfigs(display, few.data(), 2, nullptr));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_FALSE(eglChooseConfig(display, attributes, few.data(), 2, nullptr));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
}

// Rule 1 puts formats that are converted behind; then what was not asked for counts as nothing (rule 3), so
// that fewer bits come first (rule 4), and then smaller IDs (rule 11).
TEST_F(Configs, WithoutSizesTheSmallestComesFirst) {
    Order order{rgbx8888, rgba8888, a8};
    std::ranges::copy(converted(), std::back_inserter(order));
    EXPECT_EQ(chosen({}), order);
}

// Rule 3: the sum of the bits of what was asked for.
TEST_F(Configs, DeeperColoursComeFirstIfAskedFor) {
    EXPECT_EQ(chosen({EGL_RED_SIZE, 1, EGL_GREEN_SIZE, 1, EGL_BLUE_SIZE, 1}),
              (Order{rgbx8888, rgba8888, rgb565, rgba5551, rgba4444}));
    EXPECT_EQ(chosen({EGL_RED_SIZE, 1, EGL_ALPHA_SIZE, 1}), (Order{rgba8888, rgba4444, rgba5551}));
    EXPECT_EQ(chosen({EGL_ALPHA_SIZE, 1}), (Order{rgba8888, a8, rgba4444, rgba5551}));
    EXPECT_EQ(chosen({EGL_ALPHA_SIZE, 1, EGL_RED_SIZE, EGL_DONT_CARE}),
              (Order{rgba8888, a8, rgba4444, rgba5551}));
    EXPECT_EQ(chosen({EGL_GREEN_SIZE, 6}), (Order{rgbx8888, rgba8888, rgb565}));
    EXPECT_EQ(chosen({EGL_BUFFER_SIZE, 17}), (Order{rgbx8888, rgba8888}));
}

TEST_F(Configs, LuminanceComesBehindAndOnlyIfAskedFor) {
    EXPECT_EQ(chosen({EGL_COLOR_BUFFER_TYPE, EGL_LUMINANCE_BUFFER}), (Order{l1, l8}));
    EXPECT_EQ(chosen({EGL_COLOR_BUFFER_TYPE, EGL_LUMINANCE_BUFFER, EGL_LUMINANCE_SIZE, 1}), (Order{l8, l1}));
    const Order all = chosen({EGL_COLOR_BUFFER_TYPE, EGL_DONT_CARE});
    EXPECT_EQ((Order(all.end() - 2, all.end())), (Order{l1, l8}));
    EXPECT_EQ(chosen({EGL_LUMINANCE_SIZE, 1}), Order{});
}

TEST_F(Configs, ExactAttributesAreExact) {
    EXPECT_EQ(chosen({EGL_CONFIG_CAVEAT, EGL_NONE}), (Order{rgbx8888, rgba8888}));
    EXPECT_EQ(chosen({EGL_CONFIG_CAVEAT, EGL_SLOW_CONFIG, EGL_GREEN_SIZE, 6}), Order{rgb565});
    EXPECT_EQ(chosen({EGL_LEVEL, 1}), Order{});
    EXPECT_EQ(chosen({EGL_TRANSPARENT_TYPE, EGL_TRANSPARENT_RGB}), Order{});
    EXPECT_EQ(chosen({EGL_BIND_TO_TEXTURE_RGBA, EGL_TRUE}), Order{});
    EXPECT_EQ(chosen({EGL_NATIVE_RENDERABLE, EGL_TRUE}), Order{});
}

TEST_F(Configs, MasksAndMinimaAreMet) {
    EXPECT_EQ(chosen({EGL_ALPHA_MASK_SIZE, 8, EGL_RED_SIZE, 8, EGL_ALPHA_SIZE, 8}), Order{rgba8888});
    EXPECT_EQ(chosen({EGL_ALPHA_MASK_SIZE, 9}), Order{});
    EXPECT_EQ(chosen({EGL_RED_SIZE, 4, EGL_ALPHA_SIZE, 4, EGL_DEPTH_SIZE, 1}),
              isAlone() ? Order{} : Order{rgba8888});
    EXPECT_EQ(chosen({EGL_CONFORMANT, EGL_OPENVG_BIT, EGL_ALPHA_SIZE, 8}), (Order{rgba8888, a8}));
    // Those that do not count.
    EXPECT_EQ(chosen({EGL_MAX_PBUFFER_WIDTH, 1 << 30, EGL_NATIVE_VISUAL_ID, 77, EGL_TRANSPARENT_RED_VALUE, 3,
                      EGL_NATIVE_VISUAL_TYPE, 99, EGL_GREEN_SIZE, 8}),
              (Order{rgbx8888, rgba8888}));
}

TEST_F(Configs, LinearAndPremultipliedSurfacesMayBeAskedFor) {
    EXPECT_FALSE(choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE,
                         EGL_PBUFFER_BIT | EGL_VG_COLORSPACE_LINEAR_BIT | EGL_VG_ALPHA_FORMAT_PRE_BIT |
                             EGL_SWAP_BEHAVIOR_PRESERVED_BIT})
                     .empty());
    EXPECT_TRUE(choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE,
                        EGL_PBUFFER_BIT | EGL_MULTISAMPLE_RESOLVE_BOX_BIT})
                    .empty());
}

TEST_F(Configs, WhatIsNoAttributeIsAnError) {
    for (const Attributes& bad :
         {Attributes{EGL_WIDTH, 1}, Attributes{99, 0}, Attributes{EGL_RED_SIZE, -2},
          Attributes{EGL_LEVEL, EGL_DONT_CARE}, Attributes{EGL_COLOR_BUFFER_TYPE, 7},
          Attributes{EGL_CONFIG_CAVEAT, EGL_TRUE}, Attributes{EGL_TRANSPARENT_TYPE, EGL_TRUE}}) {
        Attributes list{EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT};
        list.insert(list.end(), bad.begin(), bad.end());
        list.push_back(EGL_NONE);
        EGLint count = -1;
        EXPECT_FALSE(eglChooseConfig(display, list.data(), nullptr, 0, &count)) << std::hex << bad[0];
        EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
        EXPECT_EQ(count, -1);
    }
}

TEST_F(Configs, ProgramsOfOpenGlGetWhatTheSystemGives) {
    for (const EGLConfig c : choose({EGL_SURFACE_TYPE, EGL_PBUFFER_BIT}))
        EXPECT_TRUE(value(c, EGL_RENDERABLE_TYPE) & EGL_OPENGL_ES_BIT);
    EXPECT_EQ(choose({EGL_SURFACE_TYPE, EGL_PBUFFER_BIT}).empty(), isAlone());
}

TEST_F(Configs, SayWhatDrawsOnTheirSurfaces) {
    const auto chosen = [&](EGLint compositor) {
        return choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                       EGL_COMPOSITOR_VTM, compositor});
    };
    for (const EGLint compositor :
         {EGL_COMPOSITOR_AUTOMATIC_VTM, EGL_COMPOSITOR_CPU_VTM, EGL_COMPOSITOR_GL_VTM}) {
        const auto configs = chosen(compositor);
        ASSERT_FALSE(configs.empty());
        for (const EGLConfig config : configs)
            EXPECT_EQ(value(config, EGL_COMPOSITOR_VTM), compositor);
    }
    // Programs that do not know of it find the first kind only.
    EXPECT_EQ(choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT}),
              chosen(EGL_COMPOSITOR_AUTOMATIC_VTM));
}

TEST_F(Configs, TheCompositorDrawsWhatIsRead) {
    for (const EGLint compositor : {EGL_COMPOSITOR_CPU_VTM, EGL_COMPOSITOR_GL_VTM}) {
        const EGLConfig config = choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE,
                                         EGL_PBUFFER_BIT, EGL_COMPOSITOR_VTM, compositor})
                                     .front();
        const EGLint size[] = {EGL_WIDTH, 8, EGL_HEIGHT, 8, EGL_NONE};
        const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
        eglBindAPI(EGL_OPENVG_API);
        const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
        ASSERT_EGL(eglMakeCurrent(display, surface, surface, context));
        const bool isGl = compositor == EGL_COMPOSITOR_GL_VTM && *vtmGetCompositorFault() == '\0';
        EXPECT_EQ(vtmGetCompositor(vtmGetCurrentSurface()), isGl ? VTM_COMPOSITOR_GL : VTM_COMPOSITOR_CPU);
        const VGfloat white[] = {1, 1, 1, 1};
        vgSetfv(VG_CLEAR_COLOR, 4, white);
        vgClear(2, 2, 3, 3);
        std::array<std::uint32_t, 64> pixels{};
        vgReadPixels(pixels.data(), 32, VG_sRGBX_8888, 0, 0, 8, 8);
        EXPECT_EQ(std::ranges::count_if(pixels, [](std::uint32_t p) { return p >> 8 == 0xffffff; }), 9);
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        eglDestroySurface(display, surface);
        eglBindAPI(EGL_OPENGL_ES_API);
    }
}

// Rules 4 and 9: with as many bits, the system's have no alpha mask.
TEST_F(Configs, BothKindsAreMergedInOrder) {
    const auto all = choose({EGL_RENDERABLE_TYPE, 0, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RED_SIZE, 8,
                             EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8});
    const auto isVg = [&](EGLConfig c) { return (value(c, EGL_RENDERABLE_TYPE) & EGL_OPENVG_BIT) != 0; };
    EXPECT_EQ(std::ranges::count_if(all, isVg), 2) << "without samples and with them";
    const EGLConfig vg = *std::ranges::find_if(all, isVg);
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i] != vg)
            continue;
        // Nothing before it has fewer bits of what was asked for; those with as many are smaller or have less
        // besides.
        const EGLConfig before = all[i - 1];
        EXPECT_GE(value(before, EGL_BUFFER_SIZE), 32);
        if (value(before, EGL_BUFFER_SIZE) == 32) {
            EXPECT_LE(value(before, EGL_DEPTH_SIZE), value(vg, EGL_DEPTH_SIZE));
            EXPECT_EQ(value(before, EGL_SAMPLES), 0);
        }
    }
}

}  // namespace
}  // namespace vtm::egl::testing
