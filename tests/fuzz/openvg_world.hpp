/// \file
/// What random OpenVG programs work on: contexts, surfaces, handles, and values that parameters may have.
#pragma once

#include <algorithm>
#include <optional>

#include "tests/fuzz/openvg_arguments.hpp"

namespace vtm::fuzz {

/// Handles of one type that were given out and not destroyed by their maker.
struct Pool {
    std::vector<VGHandle> handles;
};

struct World {
    /// `fixed`: what draws on all surfaces; otherwise the program chooses.
    explicit World(std::span<const std::uint8_t> bytes, std::optional<VtmCompositor> fixed = std::nullopt)
        : a(bytes), compositor(fixed) {
        contexts[0] = vtmCreateContext(nullptr);
        contexts[1] = vtmCreateContext(contexts[0]);
        contexts[2] = vtmCreateContext(nullptr);
        for (VtmSurface*& surface : surfaces)
            surface = newSurface();
        vtmMakeCurrent(contexts[0], surfaces[0]);
    }
    ~World() {
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroyRecording(recording);
        for (VtmSurface* surface : surfaces)
            vtmDestroySurface(surface);
        for (VtmContext* context : contexts)
            vtmDestroyContext(context);
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    VtmSurface* newSurface() {
        constexpr std::array<VtmSurfaceFormat, 8> formats{{{8, 8, 8, 8, 0, 8, VG_FALSE, VG_FALSE},
                                                           {8, 8, 8, 8, 0, 8, VG_TRUE, VG_TRUE},
                                                           {8, 8, 8, 0, 0, 0, VG_FALSE, VG_TRUE},
                                                           {5, 6, 5, 0, 0, 8, VG_TRUE, VG_FALSE},
                                                           {5, 5, 5, 1, 0, 8, VG_FALSE, VG_TRUE},
                                                           {4, 4, 4, 4, 0, 0, VG_FALSE, VG_FALSE},
                                                           {0, 0, 0, 8, 0, 8, VG_FALSE, VG_FALSE},
                                                           {0, 0, 0, 0, 1, 8, VG_FALSE, VG_FALSE}}};
        const VGint width = VGint(a.byte() % maxSide) + 1, height = VGint(a.byte() % maxSide) + 1;
        return chosen(vtmCreateSurface(width, height, &formats[a.byte() % formats.size()]));
    }
    VtmSurface* chosen(VtmSurface* surface) {
        if (compositor)
            vtmChooseCompositor(surface, *compositor);
        return surface;
    }

    VGHandle keep(Pool& pool, VGHandle handle) {
        if (handle != VG_INVALID_HANDLE)
            pool.handles.push_back(handle);
        if (pool.handles.size() > maxHandles) {
            dead = pool.handles.front();
            pool.handles.erase(pool.handles.begin());
            return dead;
        }
        return VG_INVALID_HANDLE;
    }
    VGHandle any(const Pool& pool) {
        if (a.rarely()) {
            const std::array<const Pool*, 5> pools{&paths, &images, &paints, &fonts, &layers};
            const Pool& other = *pools[a.byte() % pools.size()];
            const std::array<VGHandle, 4> odd{VG_INVALID_HANDLE, dead, a.word(),
                                              other.handles.empty() ? 0 : other.handles.back()};
            return odd[a.byte() % odd.size()];
        }
        return pool.handles.empty() ? VG_INVALID_HANDLE : pool.handles[a.byte() % pool.handles.size()];
    }
    /// One that is to be destroyed: no longer among the living.
    VGHandle last(Pool& pool) {
        const VGHandle handle = any(pool);
        std::erase(pool.handles, handle);
        return dead = handle;
    }
    VGHandle object() {
        const std::array<const Pool*, 5> pools{&paints, &paths, &images, &fonts, &layers};
        return any(*pools[std::min(a.byte() % 8u, 4u)]);
    }
    VtmContext*& context() { return contexts[a.byte() % contexts.size()]; }
    VtmSurface*& surface() { return surfaces[a.byte() % surfaces.size()]; }

    static constexpr std::size_t maxHandles = 6;

    Arguments a;
    std::optional<VtmCompositor> compositor;
    std::array<VtmContext*, 3> contexts{};
    std::array<VtmSurface*, 3> surfaces{};
    Pool paths, images, paints, fonts, layers;
    VGHandle dead = VG_INVALID_HANDLE;
    VtmRecording* recording = nullptr;
};

inline VGParamType parameter(Arguments& a) {
    constexpr std::array<VGint, 37> all{VG_MATRIX_MODE,
                                        VG_FILL_RULE,
                                        VG_IMAGE_QUALITY,
                                        VG_RENDERING_QUALITY,
                                        VG_BLEND_MODE,
                                        VG_IMAGE_MODE,
                                        VG_SCISSOR_RECTS,
                                        VG_COLOR_TRANSFORM,
                                        VG_COLOR_TRANSFORM_VALUES,
                                        VG_STROKE_LINE_WIDTH,
                                        VG_STROKE_CAP_STYLE,
                                        VG_STROKE_JOIN_STYLE,
                                        VG_STROKE_MITER_LIMIT,
                                        VG_STROKE_DASH_PATTERN,
                                        VG_STROKE_DASH_PHASE,
                                        VG_STROKE_DASH_PHASE_RESET,
                                        VG_TILE_FILL_COLOR,
                                        VG_CLEAR_COLOR,
                                        VG_GLYPH_ORIGIN,
                                        VG_MASKING,
                                        VG_SCISSORING,
                                        VG_PIXEL_LAYOUT,
                                        VG_SCREEN_LAYOUT,
                                        VG_FILTER_FORMAT_LINEAR,
                                        VG_FILTER_FORMAT_PREMULTIPLIED,
                                        VG_FILTER_CHANNEL_MASK,
                                        VG_MAX_SCISSOR_RECTS,
                                        VG_MAX_DASH_COUNT,
                                        VG_MAX_KERNEL_SIZE,
                                        VG_MAX_SEPARABLE_KERNEL_SIZE,
                                        VG_MAX_COLOR_RAMP_STOPS,
                                        VG_MAX_IMAGE_WIDTH,
                                        VG_MAX_IMAGE_HEIGHT,
                                        VG_MAX_IMAGE_PIXELS,
                                        VG_MAX_IMAGE_BYTES,
                                        VG_MAX_FLOAT,
                                        VG_MAX_GAUSSIAN_STD_DEVIATION};
    return VGParamType(a.rarely() ? VGint(a.word() & 0x7fffffff) : all[a.byte() % all.size()]);
}

/// A value that parameter may have.
inline VGint valueOf(Arguments& a, VGParamType type) {
    const auto from = [&](VGint first, unsigned count) { return first + VGint(a.byte() % count); };
    switch (type) {
        case VG_MATRIX_MODE:
            return from(VG_MATRIX_PATH_USER_TO_SURFACE, 5);
        case VG_FILL_RULE:
            return from(VG_EVEN_ODD, 2);
        case VG_IMAGE_QUALITY:
            return 1 << a.byte() % 3;
        case VG_RENDERING_QUALITY:
            return from(VG_RENDERING_QUALITY_NONANTIALIASED, 3);
        case VG_BLEND_MODE:
            return from(VG_BLEND_SRC, 10);
        case VG_IMAGE_MODE:
            return from(VG_DRAW_IMAGE_NORMAL, 3);
        case VG_STROKE_CAP_STYLE:
            return from(VG_CAP_BUTT, 3);
        case VG_STROKE_JOIN_STYLE:
            return from(VG_JOIN_MITER, 3);
        case VG_PIXEL_LAYOUT:
            return from(VG_PIXEL_LAYOUT_UNKNOWN, 5);
        default:
            return a.integer();
    }
}

inline VGint objectParameter(Arguments& a) {
    constexpr std::array<VGint, 18> all{VG_PAINT_TYPE,
                                        VG_PAINT_COLOR,
                                        VG_PAINT_COLOR_RAMP_SPREAD_MODE,
                                        VG_PAINT_COLOR_RAMP_STOPS,
                                        VG_PAINT_LINEAR_GRADIENT,
                                        VG_PAINT_RADIAL_GRADIENT,
                                        VG_PAINT_PATTERN_TILING_MODE,
                                        VG_PAINT_COLOR_RAMP_PREMULTIPLIED,
                                        VG_PATH_FORMAT,
                                        VG_PATH_DATATYPE,
                                        VG_PATH_SCALE,
                                        VG_PATH_BIAS,
                                        VG_PATH_NUM_SEGMENTS,
                                        VG_PATH_NUM_COORDS,
                                        VG_IMAGE_FORMAT,
                                        VG_IMAGE_WIDTH,
                                        VG_IMAGE_HEIGHT,
                                        VG_FONT_NUM_GLYPHS};
    // Those of paints more often.
    return a.rarely() ? a.integer() : all[a.rarely(3) ? a.byte() % all.size() : a.byte() % 8];
}

inline VGint objectValue(Arguments& a, VGint type) {
    switch (type) {
        case VG_PAINT_TYPE:
            return VG_PAINT_TYPE_COLOR + VGint(a.byte() % 4);
        case VG_PAINT_COLOR_RAMP_SPREAD_MODE:
            return VG_COLOR_RAMP_SPREAD_PAD + VGint(a.byte() % 3);
        case VG_PAINT_PATTERN_TILING_MODE:
            return VG_TILE_FILL + VGint(a.byte() % 4);
        default:
            return a.integer();
    }
}

/// As many numbers as the parameter takes, mostly.
inline VGint objectCount(Arguments& a, VGint type) {
    switch (a.rarely() ? 0 : type) {
        case VG_PAINT_COLOR:
        case VG_PAINT_LINEAR_GRADIENT:
            return 4;
        case VG_PAINT_RADIAL_GRADIENT:
            return 5;
        case VG_PAINT_COLOR_RAMP_STOPS:
            return VGint(a.byte() % 5) * 5;
        default:
            return a.count();
    }
}

inline const VGfloat* matrix(Arguments& a) {
    if (a.rarely(4))
        return a.floats(9);
    // Near the identity, so that something is seen.
    static thread_local std::array<VGfloat, 9> m;
    for (std::size_t i = 0; i < 9; ++i)
        m[i] = (i % 4 == 0 ? 1.0f : 0.0f) + (i % 3 == 2 ? VGfloat(a.byte() % 3) / 256 : a.number() / 16);
    return m.data();
}

inline VGTilingMode tiling(Arguments& a) { return a.one(VG_TILE_FILL, VG_TILE_REFLECT); }
inline VGMaskOperation maskOperation(Arguments& a) { return a.one(VG_CLEAR_MASK, VG_SUBTRACT_MASK); }

struct PathData {
    std::array<VGubyte, 12> commands;
    const void* numbers;
};
inline PathData pathData(Arguments& a, VGint& count) {
    PathData data;
    for (VGubyte& command : data.commands)
        command = VGubyte(a.rarely(200) ? a.byte() : a.byte() % 30);
    count = a.rarely(64) ? a.integer() : VGint(a.byte() % 12);
    count = std::min(count, VGint(data.commands.size()));
    // As floats they are tame, as integers too: whatever the path's datatype is, these bytes are numbers of
    // it.
    data.numbers =
        a.rarely(2) ? static_cast<const void*>(a.floats(120)) : static_cast<const void*>(a.integers(120));
    return data;
}

// Self-appended paths double each time.
inline void limitSize(VGPath path) {
    if (vgGetParameteri(path, VG_PATH_NUM_SEGMENTS) > 60)
        vgClearPath(path, VG_PATH_CAPABILITY_ALL);
}

inline void appendData(World& w, Arguments& a) {
    VGint count = 0;
    const PathData data = pathData(a, count);
    const VGPath path = w.any(w.paths);
    vgAppendPathData(path, count, data.commands.data(), data.numbers);
    limitSize(path);
}

/// Eight corners.
inline const VGfloat* warpPoints(Arguments& a) {
    static thread_local std::array<VGfloat, 16> points;
    for (VGfloat& v : points)
        v = a.number();
    return points.data();
}

}  // namespace vtm::fuzz
