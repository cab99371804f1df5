#include "api/src/picture_state.hpp"

#include <algorithm>
#include <cmath>

#include <dlfcn.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <vtm/compiler/view.hpp>
#include <vtm/error.hpp>
#include "api/gl_entry.hpp"
#include "raster/scan_rows.hpp"

/// Null unless the program itself is linked with libvtm_gl.
#pragma weak vtm_gl_draw

namespace vtm {

namespace {

using GlDraw = bool (*)(GlRequest&);

/// Beside libvtm, or where the loader looks. It stays loaded: drivers do not like to be unloaded.
GlDraw loadGlDraw() {
#ifdef VTM_GL_LIBRARY
    if (void* library = dlopen(VTM_GL_LIBRARY, RTLD_NOW | RTLD_LOCAL))
        return reinterpret_cast<GlDraw>(dlsym(library, "vtm_gl_draw"));
#endif
    return nullptr;
}

GlDraw findGlDraw() {
    static const GlDraw found = vtm_gl_draw ? &vtm_gl_draw : loadGlDraw();
    return found;
}

}  // namespace

CpuEngine::CpuEngine(const asset::Asset& asset) {
    if (asset::isSumOfMaps(asset))
        scanner_.emplace(asset);
    else
        evaluator_.emplace(asset);
}

void CpuEngine::draw(const asset::View& view, const image::PixelWriter& writer,
                     const image::RowSink& sink) const {
    if (scanner_)
        asset::scanRows(*scanner_, view, writer, sink);
    else
        asset::scanRows(*evaluator_, view, writer, sink);
}

std::optional<image::Raster> drawWithGl(const asset::Asset& asset, const asset::View& view, bool required) {
    const GlDraw draw = findGlDraw();
    if (!draw && required)
        throw Error("libvtm_gl, which draws with OpenGL ES, is not installed");
    GlRequest request{&asset, view, required, {}};
    if (!draw || !draw(request))
        return std::nullopt;
    return std::move(request.drawn);
}

bool glDrawsExact() {
    const GlDraw draw = findGlDraw();
    GlRequest request;
    return draw && draw(request);
}

namespace {

/// The shorter side of a pixel, user units.
double pixelOf(const scene::Affine& toPixels) {
    return 1 / std::max(glm::length(toPixels[0]), glm::length(toPixels[1]));
}

double toleranceOf(std::size_t level) { return std::ldexp(compiler::Options().tolerance, -2 * int(level)); }

/// What a matrix shows, as compileView takes it: in pixels that are no coarser than the matrix's.
compiler::ViewResult compileSeen(const scene::Scene& scene, const asset::View& view) {
    const scene::Affine fromPixels = *scene::inverse(view.toPixels);
    const scene::Point x = double(view.width) * fromPixels[0], y = double(view.height) * fromPixels[1];
    const scene::Point min = fromPixels[2] + glm::min(x, 0.0) + glm::min(y, 0.0);
    const scene::Point size = glm::abs(x) + glm::abs(y);
    const double pixel = pixelOf(view.toPixels);
    compiler::Options options;
    constexpr double finest = 0x1p-26;  // of Options::tolerance
    options.tolerance =
        std::clamp(compiler::viewShare * pixel / std::max(size.x, size.y), finest, options.tolerance);
    // The raster is of the view's bounds, which are larger than the view and may be beyond the limits; the
    // tolerance decides.
    constexpr double maxSide = 8192;
    const auto side = [&](double length) { return int(std::clamp(std::ceil(length / pixel), 1.0, maxSide)); };
    compiler::ViewResult made =
        compiler::compileView(scene, {min.x, min.y, size.x, size.y}, side(size.x), side(size.y), options);
    made.view = view;
    made.view.toPixels = scene::compose(view.toPixels, *scene::inverse(made.fromScene));
    return made;
}

}  // namespace

std::shared_ptr<const Compiled> Picture::State::atLevel(std::size_t level) {
    const std::lock_guard lock(compiling_);
    std::shared_ptr<const Compiled>& made = compiled_[level];
    if (!made) {
        compiler::Options options;
        options.tolerance = toleranceOf(level);
        made = take(compiler::compile(*scene, options));
    }
    isCompiled_[level] = true;
    return made;
}

std::size_t Picture::State::levelFor(const Shot& shot) const {
    if (!scene || !scene::inverse(shot.view.toPixels))
        return 0;
    const double needed = compiler::viewShare * pixelOf(shot.view.toPixels) / std::max(width, height);
    std::size_t level = 0;
    while (level < levels && needed < toleranceOf(level))
        ++level;
    return level;
}

Drawing Picture::State::drawingFor(const Shot& shot) {
    if (!scene)
        return nullptr;
    const std::size_t level = levelFor(shot);
    if (level == finerThanAll) {
        if (!shot.frame)
            return nullptr;
    } else {
        const bool isFirst = !isDrawn_[level].exchange(true);
        if (isCompiled_[level] || !(isFirst || (level == 0 && isCompiling_)))
            return nullptr;
    }
    compiler::Options options;
    options.tolerance = toleranceOf(std::min(level, levels - 1));
    Drawing drawing = shot.frame ? compiler::ViewDrawing::make(*scene, *shot.frame)
                                 : compiler::ViewDrawing::make(*scene, shot.view, options);
    if (drawing)
        for (const std::string& warning : drawing->warnings())
            warn(warning);
    return drawing;
}

void Picture::State::compileInBackground() {
    const std::lock_guard lock(background_.mutex);
    if (isCompiled_[0] || background_.compiling.valid())
        return;
    isCompiling_ = true;
    background_.compiling = std::async(std::launch::async, [this] {
        try {
            whole();
        } catch (const std::exception&) {  // who needs it meets the error himself
        }
        isCompiling_ = false;
    });
}

Seen Picture::State::compileFor(const Shot& shot) {
    if (const std::size_t level = levelFor(shot); level != finerThanAll)
        return {atLevel(level), shot.view};
    compiler::ViewResult made =
        shot.frame ? compiler::compileView(*scene, *shot.frame) : compileSeen(*scene, shot.view);
    return {take(std::move(made.result)), made.view};
}

std::shared_ptr<const Compiled> Picture::State::take(compiler::Result result) {
    for (std::string& warning : result.warnings)
        warn(std::move(warning));
    return std::make_shared<const Compiled>(std::move(result.asset));
}

void Picture::State::warn(std::string message) {
    const std::lock_guard lock(warning_);
    if (std::find(warnings_.begin(), warnings_.end(), message) == warnings_.end())
        warnings_.push_back(std::move(message));
}

std::vector<std::string> Picture::State::warnings() {
    const std::lock_guard lock(warning_);
    return warnings_;
}

}  // namespace vtm
