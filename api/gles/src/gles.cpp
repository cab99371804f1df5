// Surfaces and recordings of OpenVG in a user's GLES context (vtm/gles.h), by backend_gl.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <vtm/gles.h>
#include <glm/vec2.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/gl/renderer.hpp>

using namespace vtm;

struct VtmGl {
    gl::Renderer renderer;
    std::vector<std::uint8_t> pixels;  ///< of the surface that was presented last
};

struct VtmGlPicture {
    gl::Texture texture;
    double height;
};

namespace {

std::string& fault() {
    thread_local std::string text;
    return text;
}

/// The result of work(), or `otherwise` with the reason kept.
template <class Result, class Work>
Result attempt(Result otherwise, Work&& work) noexcept {
    try {
        return std::forward<Work>(work)();
    } catch (const std::exception& error) {
        fault() = error.what();
    }
    return otherwise;
}

void require(bool condition, const char* otherwise) {
    if (!condition)
        throw std::invalid_argument(otherwise);
}

/// Rectangles within a surface, y upwards.
std::vector<gl::PixelRectangle> damageOf(const VtmGlTarget& target, int width, int height) {
    if (!target.damage)
        return {{0, 0, width, height}};
    require(target.damageCount >= 0, "the number of rectangles is negative");
    std::vector<gl::PixelRectangle> result;
    for (const VGint* r = target.damage; r != target.damage + 4 * std::ptrdiff_t(target.damageCount);
         r += 4) {
        const auto end = [](VGint start, VGint size, int maximum) {
            return int(std::min(std::int64_t(start) + size, std::int64_t(maximum)));
        };
        const int x = std::max(r[0], 0), y = std::max(r[1], 0);
        const int columns = end(r[0], r[2], width) - x, rows = end(r[1], r[3], height) - y;
        if (columns > 0 && rows > 0)
            result.push_back({x, y, columns, rows});
    }
    return result;
}

gl::Output outputOf(const VtmGlTarget& target, std::vector<gl::PixelRectangle> damage, int height) {
    gl::Output output;
    output.framebuffer = target.framebuffer;
    output.x = target.x;
    output.y = target.y;
    output.firstRow = target.upsideDown ? gl::Output::FirstRow::Bottom : gl::Output::FirstRow::Top;
    output.encoding = target.linear ? gl::Output::Encoding::Linear : gl::Output::Encoding::Srgb;
    output.alpha = target.straight ? gl::Output::Alpha::Straight : gl::Output::Alpha::Premultiplied;
    output.write = target.over ? gl::Output::Write::Over : gl::Output::Write::Replace;
    for (gl::PixelRectangle& r : damage)
        r.y = height - r.y - r.height;  // views begin at the top
    output.damage = std::move(damage);
    return output;
}

void present(VtmGl& gl, VtmSurface* surface, const VtmGlTarget& target) {
    const int width = vtmSurfaceWidth(surface), height = vtmSurfaceHeight(surface);
    const std::size_t rowBytes = std::size_t(width) * 4;
    gl.pixels.resize(rowBytes * std::size_t(height));
    const std::vector<gl::PixelRectangle> damage = damageOf(target, width, height);
    for (const gl::PixelRectangle& r : damage)
        vtmReadSurfacePart(
            surface, r.x, r.y, r.width, r.height,
            gl.pixels.data() + std::size_t(height - r.y - r.height) * rowBytes + std::size_t(r.x) * 4,
            rowBytes);
    gl.renderer.draw(gl::BytePixels{gl.pixels.data(), width, height, rowBytes},
                     outputOf(target, damage, height));
}

/// From the picture, whose y runs down from its upper border, to a view whose y does.
asset::View viewOf(const VGfloat* m, double pictureHeight, int width, int height) {
    require(std::all_of(m, m + 9, [](VGfloat v) { return std::isfinite(v); }), "the matrix is not finite");
    require(m[2] == 0 && m[5] == 0 && m[8] == 1, "the matrix is not affine");
    const glm::dvec2 x(m[0], m[1]), y(m[3], m[4]), origin = glm::dvec2(m[6], m[7]) + y * pictureHeight;
    return {width, height, {x.x, -x.y, -y.x, y.y, origin.x, height - origin.y}};
}

}  // namespace

VtmGl* vtmCreateGl(void) {
    return attempt<VtmGl*>(nullptr, [] { return new VtmGl; });
}

void vtmDestroyGl(VtmGl* gl) { delete gl; }

VGboolean vtmPresentGl(VtmGl* gl, VtmSurface* surface, const VtmGlTarget* target) {
    return attempt(VG_FALSE, [&] {
        require(gl && surface && target, "an argument is NULL");
        present(*gl, surface, *target);
        return VG_TRUE;
    });
}

VtmGlPicture* vtmUploadRecordingGl(VtmGl* gl, const VtmRecording* recording) {
    return attempt<VtmGlPicture*>(nullptr, [&] {
        require(gl && recording, "an argument is NULL");
        std::size_t size = 0;
        const auto* bytes = static_cast<const std::uint8_t*>(vtmGetRecordingBytes(recording, &size));
        const asset::Asset asset = asset::read({bytes, size});
        return new VtmGlPicture{gl->renderer.upload(asset), asset.height};
    });
}

void vtmDestroyPictureGl(VtmGlPicture* picture) { delete picture; }

VGboolean vtmDrawPictureGl(VtmGl* gl, const VtmGlPicture* picture, VGint width, VGint height,
                           const VGfloat matrix[9], const VtmGlTarget* target) {
    return attempt(VG_FALSE, [&] {
        require(gl && picture && matrix && target, "an argument is NULL");
        require(width >= 0 && height >= 0, "a side is negative");
        gl::Output output = outputOf(*target, damageOf(*target, width, height), height);
        output.linearLight = true;
        gl->renderer.draw(picture->texture, viewOf(matrix, picture->height, width, height), output);
        return VG_TRUE;
    });
}

const char* vtmGetGlFault(void) { return fault().c_str(); }
