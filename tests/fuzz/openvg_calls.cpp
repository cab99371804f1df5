#include "tests/fuzz/openvg_calls.hpp"

#include "tests/fuzz/openvg_world.hpp"

namespace vtm::fuzz {

namespace {

using Call = void (*)(World&, Arguments&);

// One of each function; what draws little and what is needed to draw more than once.
constexpr Call table[] = {
    // ---- vtm/vg.h
    [](World& w, Arguments&) { vtmMakeCurrent(w.context(), w.surface()); },
    [](World& w, Arguments&) { vtmMakeCurrent(w.context(), w.surface()); },
    [](World& w, Arguments& a) {
        if (a.rarely(8))
            vtmMakeCurrent(nullptr, a.rarely() ? w.surface() : nullptr);
    },
    [](World& w, Arguments&) {
        // The surface may be current: it then goes when it no longer is.
        VtmSurface*& old = w.surface();
        vtmDestroySurface(old);
        old = w.newSurface();
    },
    [](World& w, Arguments& a) {
        VGErrorCode error;
        VtmContext* const context = w.context();
        const VGImage image = w.any(w.images);
        if (VtmSurface* const surface = vtmCreateImageSurface(context, image, a.rarely(2) ? 8 : 0, &error)) {
            VtmSurface*& old = w.surface();
            vtmDestroySurface(old);
            old = w.chosen(surface);
        }
    },
    [](World& w, Arguments& a) {
        constexpr std::array compositors{VTM_COMPOSITOR_AUTOMATIC, VTM_COMPOSITOR_CPU, VTM_COMPOSITOR_GL};
        VtmSurface* const surface = w.surface();
        const VtmCompositor compositor = compositors[a.byte() % compositors.size()];
        if (!w.compositor)
            vtmChooseCompositor(surface, compositor);
        vtmGetCompositor(surface);
        vtmGetCompositorFault();
    },
    [](World& w, Arguments& a) {
        VtmSurface* const surface = w.surface();
        vtmResizeSurface(surface, VGint(a.byte() % (maxSide + 1)), VGint(a.byte() % (maxSide + 1)));
        std::vector<std::uint8_t> pixels(std::size_t(vtmSurfaceWidth(surface)) *
                                         std::size_t(vtmSurfaceHeight(surface)) * 4);
        vtmReadSurface(surface, pixels.data(), std::size_t(vtmSurfaceWidth(surface)) * 4);
    },
    [](World& w, Arguments& a) {
        if (!a.rarely(8))
            return;
        VtmContext*& old = w.context();
        vtmDestroyContext(old);
        old = vtmCreateContext(w.contexts[0] == old ? nullptr : w.contexts[0]);
    },
    [](World&, Arguments&) { vtmGetProcAddress("vgClear"); },
    // ---- Sections 4 and 5
    [](World&, Arguments&) { vgGetError(); },
    [](World&, Arguments&) { vgFlush(); },
    [](World&, Arguments&) { vgFinish(); },
    [](World&, Arguments& a) { vgSetf(parameter(a), a.number()); },
    [](World&, Arguments& a) {
        const VGParamType type = parameter(a);
        vgSeti(type, valueOf(a, type));
    },
    [](World&, Arguments& a) {
        const VGParamType type = parameter(a);
        vgSeti(type, valueOf(a, type));
    },
    [](World&, Arguments& a) {
        constexpr std::array vectors{VG_STROKE_DASH_PATTERN, VG_CLEAR_COLOR, VG_TILE_FILL_COLOR,
                                     VG_GLYPH_ORIGIN, VG_COLOR_TRANSFORM_VALUES};
        constexpr std::array counts{4, 4, 4, 2, 8};
        const std::size_t i = a.byte() % vectors.size();
        const VGint count = a.rarely() ? a.count() : counts[i];
        vgSetfv(a.rarely() ? parameter(a) : vectors[i], count, a.floats(count, i == 1 || i == 2));
    },
    [](World&, Arguments& a) {
        const VGint count = a.rarely() ? a.count() : 8;
        vgSetiv(a.rarely() ? parameter(a) : VG_SCISSOR_RECTS, count, a.integers(count));
    },
    [](World&, Arguments& a) { vgGetf(parameter(a)); },
    [](World&, Arguments& a) { vgGeti(parameter(a)); },
    [](World&, Arguments& a) { vgGetVectorSize(parameter(a)); },
    [](World&, Arguments& a) { vgGetfv(parameter(a), a.count(), a.results()); },
    [](World&, Arguments& a) { vgGetiv(parameter(a), a.count(), a.integerResults()); },
    [](World& w, Arguments& a) { vgSetParameterf(w.object(), objectParameter(a), a.number()); },
    [](World& w, Arguments& a) {
        const VGint type = objectParameter(a);
        vgSetParameteri(w.object(), type, objectValue(a, type));
    },
    [](World& w, Arguments& a) {
        const VGint type = objectParameter(a), count = objectCount(a, type);
        vgSetParameterfv(w.object(), type, count, a.floats(count, type == VG_PAINT_COLOR_RAMP_STOPS));
    },
    [](World& w, Arguments& a) {
        const VGint type = objectParameter(a), count = objectCount(a, type);
        vgSetParameteriv(w.object(), type, count, a.integers(count));
    },
    [](World& w, Arguments& a) { vgGetParameterf(w.object(), objectParameter(a)); },
    [](World& w, Arguments& a) { vgGetParameteri(w.object(), objectParameter(a)); },
    [](World& w, Arguments& a) { vgGetParameterVectorSize(w.object(), objectParameter(a)); },
    [](World& w, Arguments& a) { vgGetParameterfv(w.object(), objectParameter(a), a.count(), a.results()); },
    [](World& w, Arguments& a) {
        vgGetParameteriv(w.object(), objectParameter(a), a.count(), a.integerResults());
    },
    // ---- Section 6
    [](World&, Arguments&) { vgLoadIdentity(); },
    [](World&, Arguments&) { vgLoadIdentity(); },
    [](World&, Arguments& a) { vgLoadMatrix(matrix(a)); },
    [](World&, Arguments& a) { vgGetMatrix(a.results()); },
    [](World&, Arguments& a) { vgMultMatrix(matrix(a)); },
    [](World&, Arguments& a) { vgTranslate(a.number(), a.number()); },
    [](World&, Arguments& a) { vgScale(a.number() / 16, a.number() / 16); },
    [](World&, Arguments& a) { vgShear(a.number() / 64, a.number() / 64); },
    [](World&, Arguments& a) { vgRotate(a.number() * 4); },
    // ---- Section 7
    [](World& w, Arguments& a) {
        const VGHandle mask = w.any(a.rarely(2) ? w.layers : w.images);
        const Area r = a.area();
        vgMask(mask, maskOperation(a), r.x, r.y, r.width, r.height);
    },
    [](World& w, Arguments& a) { vgRenderToMask(w.any(w.paths), a.bits(2), maskOperation(a)); },
    [](World& w, Arguments& a) {
        vgDestroyMaskLayer(w.keep(w.layers, vgCreateMaskLayer(a.side(), a.side())));
    },
    [](World& w, Arguments& a) {
        if (a.rarely(4))
            vgDestroyMaskLayer(w.last(w.layers));
    },
    [](World& w, Arguments& a) {
        const Area r = a.area();
        vgFillMaskLayer(w.any(w.layers), r.x, r.y, r.width, r.height, a.unit());
    },
    [](World& w, Arguments& a) {
        const Area r = a.area();
        vgCopyMask(w.any(w.layers), r.x, r.y, a.integer(), a.integer(), r.width, r.height);
    },
    [](World&, Arguments& a) {
        const Area r = a.area();
        vgClear(r.x, r.y, r.width, r.height);
    },
    // ---- Section 8
    [](World& w, Arguments& a) {
        const VGPath path =
            vgCreatePath(a.rarely() ? a.integer() : VG_PATH_FORMAT_STANDARD,
                         a.one(VG_PATH_DATATYPE_S_8, VG_PATH_DATATYPE_F), a.rarely(4) ? a.number() : 1.0f,
                         a.rarely(4) ? a.number() : 0.0f, a.integer(), a.integer(),
                         a.rarely(8) ? a.word() : VGbitfield(VG_PATH_CAPABILITY_ALL));
        vgDestroyPath(w.keep(w.paths, path));
    },
    [](World& w, Arguments& a) {
        vgClearPath(w.any(w.paths), a.rarely(8) ? a.word() : VGbitfield(VG_PATH_CAPABILITY_ALL));
    },
    [](World& w, Arguments& a) {
        if (a.rarely(4))
            vgDestroyPath(w.last(w.paths));
    },
    [](World& w, Arguments& a) {
        if (a.rarely(4))
            vgRemovePathCapabilities(w.any(w.paths), 1u << a.byte() % 12);
    },
    [](World& w, Arguments&) { vgGetPathCapabilities(w.any(w.paths)); },
    [](World& w, Arguments&) {
        const VGPath path = w.any(w.paths);
        vgAppendPath(path, w.any(w.paths));
        limitSize(path);
    },
    [](World& w, Arguments& a) { appendData(w, a); },
    [](World& w, Arguments& a) { appendData(w, a); },
    [](World& w, Arguments& a) { appendData(w, a); },
    [](World& w, Arguments& a) {
        VGint count = 0;
        const PathData data = pathData(a, count);
        vgModifyPathCoords(w.any(w.paths), a.integer(), count, data.numbers);
    },
    [](World& w, Arguments&) {
        const VGPath path = w.any(w.paths);
        vgTransformPath(path, w.any(w.paths));
        limitSize(path);
    },
    [](World& w, Arguments& a) {
        const VGPath path = w.any(w.paths), from = w.any(w.paths);
        vgInterpolatePath(path, from, a.rarely(2) ? from : w.any(w.paths), a.unit());
        limitSize(path);
    },
    [](World& w, Arguments& a) { vgPathLength(w.any(w.paths), a.integer(), a.integer()); },
    [](World& w, Arguments& a) {
        VGfloat* const r = a.results();
        vgPointAlongPath(w.any(w.paths), a.integer(), a.integer(), a.number(), r, r ? r + 1 : r,
                         a.rarely() ? nullptr : r, r);
    },
    [](World& w, Arguments& a) {
        VGfloat* const r = a.results();
        vgPathBounds(w.any(w.paths), r, r, a.results(), r);
    },
    [](World& w, Arguments& a) {
        VGfloat* const r = a.results();
        vgPathTransformedBounds(w.any(w.paths), r, r, a.results(), r);
    },
    [](World& w, Arguments& a) { vgDrawPath(w.any(w.paths), a.bits(2)); },
    [](World& w, Arguments& a) { vgDrawPath(w.any(w.paths), a.bits(2)); },
    // ---- Section 9
    [](World& w, Arguments&) { vgDestroyPaint(w.keep(w.paints, vgCreatePaint())); },
    [](World& w, Arguments& a) {
        if (a.rarely(4))
            vgDestroyPaint(w.last(w.paints));
    },
    [](World& w, Arguments& a) { vgSetPaint(w.any(w.paints), a.bits(2)); },
    [](World&, Arguments& a) { vgGetPaint(a.one(VG_STROKE_PATH, VG_FILL_PATH)); },
    [](World& w, Arguments& a) { vgSetColor(w.any(w.paints), a.word()); },
    [](World& w, Arguments&) { vgGetColor(w.any(w.paints)); },
    [](World& w, Arguments&) {
        const VGPaint paint = w.any(w.paints);
        vgPaintPattern(paint, w.any(w.images));
    },
    // ---- Section 10
    [](World& w, Arguments& a) {
        const VGImage image =
            vgCreateImage(a.format(), a.side(), a.side(), a.rarely() ? a.word() : 1 + a.byte() % 7);
        vgDestroyImage(w.keep(w.images, image));
    },
    [](World& w, Arguments& a) {
        if (a.rarely(4))
            vgDestroyImage(w.last(w.images));
    },
    [](World& w, Arguments& a) {
        const Area r = a.area();
        vgClearImage(w.any(w.images), r.x, r.y, r.width, r.height);
    },
    [](World& w, Arguments& a) {
        const Arguments::Memory m = a.pixels();
        vgImageSubData(w.any(w.images), m.data, m.stride, a.format(), m.area.x, m.area.y, m.area.width,
                       m.area.height);
    },
    [](World& w, Arguments& a) {
        const Arguments::Memory m = a.pixels();
        vgGetImageSubData(w.any(w.images), m.data, m.stride, a.format(), m.area.x, m.area.y, m.area.width,
                          m.area.height);
    },
    [](World& w, Arguments& a) {
        const VGint x = VGint(a.byte() % 8), y = a.rarely() ? a.integer() : 0;
        const VGImage image = vgChildImage(w.any(w.images), x, y, VGint(a.byte() % 12), a.side());
        vgDestroyImage(w.keep(w.images, image));
    },
    [](World& w, Arguments&) { vgGetParent(w.any(w.images)); },
    [](World& w, Arguments& a) {
        const VGImage dst = w.any(w.images), src = a.rarely(2) ? dst : w.any(w.images);
        const Area r = a.area();
        vgCopyImage(dst, r.x, r.y, src, a.integer(), a.integer(), r.width, r.height, a.boolean());
    },
    [](World& w, Arguments&) { vgDrawImage(w.any(w.images)); },
    [](World& w, Arguments&) { vgDrawImage(w.any(w.images)); },
    [](World& w, Arguments& a) {
        const Area r = a.area();
        vgSetPixels(r.x, r.y, w.any(w.images), a.integer(), a.integer(), r.width, r.height);
    },
    [](World&, Arguments& a) {
        const Arguments::Memory m = a.pixels();
        vgWritePixels(m.data, m.stride, a.format(), m.area.x, m.area.y, m.area.width, m.area.height);
    },
    [](World& w, Arguments& a) {
        const Area r = a.area();
        vgGetPixels(w.any(w.images), r.x, r.y, a.integer(), a.integer(), r.width, r.height);
    },
    [](World&, Arguments& a) {
        const Arguments::Memory m = a.pixels();
        vgReadPixels(m.data, m.stride, a.format(), m.area.x, m.area.y, m.area.width, m.area.height);
    },
    [](World&, Arguments& a) {
        const Area r = a.area();
        vgCopyPixels(r.x, r.y, a.integer(), a.integer(), r.width, r.height);
    },
    // ---- Section 11
    [](World& w, Arguments& a) { vgDestroyFont(w.keep(w.fonts, vgCreateFont(a.integer()))); },
    [](World& w, Arguments& a) {
        if (a.rarely(4))
            vgDestroyFont(w.last(w.fonts));
    },
    [](World& w, Arguments& a) {
        const VGFont font = w.any(w.fonts);
        vgSetGlyphToPath(font, a.byte() % 8, w.any(w.paths), a.boolean(), a.floats(2), a.floats(2));
    },
    [](World& w, Arguments& a) {
        const VGFont font = w.any(w.fonts);
        vgSetGlyphToImage(font, a.byte() % 8, w.any(w.images), a.floats(2), a.floats(2));
    },
    [](World& w, Arguments& a) { vgClearGlyph(w.any(w.fonts), a.byte() % 8); },
    [](World& w, Arguments& a) { vgDrawGlyph(w.any(w.fonts), a.byte() % 8, a.bits(2), a.boolean()); },
    [](World& w, Arguments& a) {
        const VGint count = a.rarely() ? std::min(a.integer(), 6) : VGint(a.byte() % 6);
        std::array<VGuint, 6> glyphs;
        for (VGuint& glyph : glyphs)
            glyph = a.byte() % 4;
        const VGfloat* const adjustments = a.floats(6);
        vgDrawGlyphs(w.any(w.fonts), count, a.rarely() ? nullptr : glyphs.data(),
                     a.rarely(3) ? nullptr : adjustments, a.rarely(3) ? nullptr : adjustments, a.bits(2),
                     a.boolean());
    },
    // ---- Section 12
    [](World& w, Arguments& a) {
        const VGImage dst = w.any(w.images);
        vgColorMatrix(dst, w.any(w.images), a.floats(20));
    },
    [](World& w, Arguments& a) {
        const VGImage dst = w.any(w.images);
        const VGint width = a.rarely() ? a.integer() : VGint(a.byte() % 6),
                    height = a.rarely() ? a.integer() : 3;
        vgConvolve(dst, w.any(w.images), width, height, a.integer(), a.integer(),
                   static_cast<const VGshort*>(a.table()), a.number(), a.number(), tiling(a));
    },
    [](World& w, Arguments& a) {
        const VGImage dst = w.any(w.images);
        const VGint width = a.rarely() ? a.integer() : VGint(a.byte() % 10),
                    height = a.rarely() ? a.integer() : 3;
        const auto* kernel = static_cast<const VGshort*>(a.table());
        vgSeparableConvolve(dst, w.any(w.images), width, height, a.integer(), a.integer(), kernel, kernel,
                            a.number(), a.number(), tiling(a));
    },
    [](World& w, Arguments& a) {
        const VGImage dst = w.any(w.images);
        vgGaussianBlur(dst, w.any(w.images), a.number() / 16, a.number() / 16, tiling(a));
    },
    [](World& w, Arguments& a) {
        const VGImage dst = w.any(w.images);
        const auto* lookup = static_cast<const VGubyte*>(a.table());
        vgLookup(dst, w.any(w.images), lookup, lookup, lookup, lookup, a.boolean(), a.boolean());
    },
    [](World& w, Arguments& a) {
        const VGImage dst = w.any(w.images);
        const auto channel =
            a.rarely() ? VGImageChannel(a.word() & 0x7fffffff) : VGImageChannel(1 << a.byte() % 5);
        vgLookupSingle(dst, w.any(w.images), static_cast<const VGuint*>(a.table()), channel, a.boolean(),
                       a.boolean());
    },
    // ---- Sections 14 and 15
    [](World&, Arguments& a) {
        vgHardwareQuery(a.one(VG_IMAGE_FORMAT_QUERY, VG_PATH_DATATYPE_QUERY), a.integer());
    },
    [](World&, Arguments& a) { vgGetString(a.one(VG_VENDOR, VG_EXTENSIONS)); },
    // ---- VGU
    [](World& w, Arguments& a) { vguLine(w.any(w.paths), a.number(), a.number(), a.number(), a.number()); },
    [](World& w, Arguments& a) {
        const VGint count = VGint(a.byte() % 10) - 1;
        vguPolygon(w.any(w.paths), a.floats(2 * count), count, a.boolean());
    },
    [](World& w, Arguments& a) { vguRect(w.any(w.paths), a.number(), a.number(), a.number(), a.number()); },
    [](World& w, Arguments& a) {
        vguRoundRect(w.any(w.paths), a.number(), a.number(), a.number(), a.number(), a.number(), a.number());
    },
    [](World& w, Arguments& a) {
        vguEllipse(w.any(w.paths), a.number(), a.number(), a.number(), a.number());
    },
    [](World& w, Arguments& a) {
        const VGPath path = w.any(w.paths);
        vguArc(path, a.number(), a.number(), a.number(), a.number(), a.number() * 8, a.number() * 8,
               a.one(VGU_ARC_OPEN, VGU_ARC_PIE));
    },
    // ---- Extensions
    [](World& w, Arguments& a) {
        VtmSharedImage* const shared = vtmShareImage(w.context(), w.any(w.images), nullptr);
        if (!shared)
            return;
        vtmNameSharedImage(shared, shared);
        vgDestroyImage(w.keep(w.images, vgCreateEGLImageTargetKHR(shared)));
        std::vector<std::uint8_t> pixels(std::size_t(vtmSharedImageWidth(shared)) *
                                         std::size_t(vtmSharedImageHeight(shared)) * 4);
        vtmTakeSharedPixels(shared, pixels.data());
        pixels[a.byte() % pixels.size()] ^= 255;
        vtmPutSharedPixels(shared, pixels.data());
        vtmDestroySharedImage(shared);
    },
    [](World&, Arguments& a) { vgCreateEGLImageTargetKHR(a.results()); },
    [](World&, Arguments&) { vgGetString(VG_EXTENSIONS); },
    [](World&, Arguments& a) { vgProjectiveMatrixNDS(a.boolean()); },
    [](World&, Arguments& a) {
        const auto lines = VGParamType(VG_CLIP_LINES_NDS), mode = VGParamType(VG_CLIP_MODE_NDS);
        const VGint count = a.rarely() ? a.count() : 3 * VGint(a.byte() % 3);
        vgSetfv(lines, count, a.floats(count));
        vgSeti(mode, VG_CLIPMODE_NONE_NDS + VGint(a.byte() % 5));
    },
    [](World&, Arguments& a) {
        VGfloat* const out = a.results();
        vguTransformClipLineNDS(a.number(), a.number(), a.number(), matrix(a), a.boolean(), out, out, out);
    },
    [](World&, Arguments& a) {
        const VGfloat* const p = warpPoints(a);
        vguComputeWarpQuadToSquare(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], a.results());
    },
    [](World&, Arguments& a) {
        const VGfloat* const p = warpPoints(a);
        vguComputeWarpSquareToQuad(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], a.results());
    },
    [](World&, Arguments& a) {
        const VGfloat* const p = warpPoints(a);
        vguComputeWarpQuadToQuad(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10], p[11],
                                 p[12], p[13], p[14], p[15], a.results());
    },
    // ---- Recordings
    [](World&, Arguments& a) {
        if (a.rarely(4))
            vtmBeginRecording(a.rarely(8) ? a.number() : VGfloat(1 + a.byte()), VGfloat(1 + a.byte()));
    },
    [](World& w, Arguments& a) {
        VtmRecording* const recording = vtmEndRecording();
        if (!recording)
            return static_cast<void>(vtmGetRecordingFault());
        vtmDestroyRecording(w.recording);
        w.recording = recording;
        std::size_t size = 0;
        const void* const bytes = vtmGetRecordingBytes(recording, &size);
        vtmDestroyRecording(vtmLoadRecording(bytes, a.rarely() ? size / 2 : size));
    },
    [](World&, Arguments&) { vtmDestroyRecording(vtmEndRecording()); },
    [](World& w, Arguments&) { vtmDrawRecording(w.recording); },
};

}  // namespace

namespace {

std::size_t run(World& world) {
    std::size_t count = 0;
    for (; !world.a.atEnd(); ++count)
        table[world.a.byte() % std::size(table)](world, world.a);
    return count;
}

}  // namespace

std::size_t runOpenVgCalls(std::span<const std::uint8_t> bytes) {
    World world(bytes);
    return run(world);
}

std::vector<SurfacePicture> drawnByOpenVgCalls(std::span<const std::uint8_t> bytes,
                                               VtmCompositor compositor) {
    World world(bytes, compositor);
    run(world);
    std::vector<SurfacePicture> pictures;
    for (VtmSurface* const surface : world.surfaces) {
        SurfacePicture& picture = pictures.emplace_back(
            SurfacePicture{vtmSurfaceWidth(surface), vtmSurfaceHeight(surface), {}, {}});
        vtmGetSurfaceFormat(surface, &picture.format);
        picture.pixels.resize(std::size_t(picture.width) * std::size_t(picture.height) * 4);
        vtmReadSurface(surface, picture.pixels.data(), std::size_t(picture.width) * 4);
    }
    return pictures;
}

}  // namespace vtm::fuzz
