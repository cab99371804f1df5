// NanoVG on OpenGL ES as a peer process (docs/benchmarks.md). It reads no SVG, so it is given the paths of
// our scene, and reads them as we do.

#include <optional>
#include <stdexcept>

#include <GLES3/gl3.h>

#include <nanovg.h>
#define NANOVG_GLES3_IMPLEMENTATION
#include <nanovg_gl.h>

#include <vtm/gl/context.hpp>
#include <vtm/svg/load.hpp>
#include "bench/engines/gl_framebuffer.hpp"
#include "bench/engines/peer_process.hpp"
#include "bench/engines/shape.hpp"

namespace vtm::bench {
namespace {

constexpr int asItIs = 0;  ///< for nvgPathWinding, which else turns subpaths round

/// A path without arcs.
void trace(NVGcontext* c, const scene::Path& path) {
    nvgBeginPath(c);
    for (const scene::Command& command : path) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command)) {
            nvgMoveTo(c, float(move->to.x), float(move->to.y));
            nvgPathWinding(c, asItIs);
        } else if (const auto* line = std::get_if<scene::LineTo>(&command)) {
            nvgLineTo(c, float(line->to.x), float(line->to.y));
        } else if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            nvgQuadTo(c, float(quad->control.x), float(quad->control.y), float(quad->to.x),
                      float(quad->to.y));
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            nvgBezierTo(c, float(cubic->control1.x), float(cubic->control1.y), float(cubic->control2.x),
                        float(cubic->control2.y), float(cubic->to.x), float(cubic->to.y));
        } else {
            nvgClosePath(c);
        }
    }
}

void stroke(NVGcontext* c, const scene::StrokeStyle& style, NVGcolor color) {
    if (!style.dashes.empty())
        throw std::runtime_error("it strokes without dashes only");
    constexpr int caps[]{NVG_BUTT, NVG_ROUND, NVG_SQUARE};
    constexpr int joins[]{NVG_MITER, NVG_MITER, NVG_ROUND, NVG_BEVEL};
    nvgStrokeWidth(c, float(style.width));
    nvgLineCap(c, caps[int(style.cap)]);
    nvgLineJoin(c, joins[int(style.join)]);
    nvgMiterLimit(c, float(style.miterLimit));
    nvgStrokeColor(c, color);
    nvgStroke(c);
}

void fill(NVGcontext* c, scene::FillRule rule, NVGcolor color) {
    if (rule == scene::FillRule::EvenOdd)
        throw std::runtime_error("it does not fill by even-odd");
    nvgFillColor(c, color);
    nvgFill(c);
}

/// A context of OpenGL ES, NanoVG's in it, and a framebuffer that fits the view.
class Surface {
public:
    Surface() : c_(nvgCreateGLES3(NVG_ANTIALIAS | NVG_STENCIL_STROKES)) {
        if (!c_)
            throw std::runtime_error("NanoVG does not start");
    }

    const std::string& driver() const { return context_.renderer(); }

    void draw(const std::vector<Shape>& shapes, const asset::View& view) {
        if (!target_ || target_->width() != view.width || target_->height() != view.height) {
            target_.reset();
            target_.emplace(view.width, view.height);
        }
        target_->bind();
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        NVGcontext* c = c_.get();
        nvgCancelFrame(c);  // what a drawing has left that threw
        nvgBeginFrame(c, float(view.width), float(view.height), 1);
        for (const Shape& shape : shapes)
            draw(shape, scene::compose(view.toPixels, shape.toPicture));
        nvgEndFrame(c);
        glFinish();
    }

    image::Bitmap pixels() const { return target_.value().pixels(); }

private:
    struct Delete {
        void operator()(NVGcontext* c) const { nvgDeleteGLES3(c); }
    };

    void draw(const Shape& shape, const scene::Affine& m) const {
        NVGcontext* c = c_.get();
        nvgResetTransform(c);
        nvgTransform(c, float(m[0].x), float(m[0].y), float(m[1].x), float(m[1].y), float(m[2].x),
                     float(m[2].y));
        trace(c, shape.path);
        const NVGcolor color = nvgRGBAf(shape.color.r, shape.color.g, shape.color.b, shape.color.a);
        if (const auto* style = std::get_if<scene::StrokeStyle>(&shape.geometry))
            stroke(c, *style, color);
        else
            fill(c, std::get<scene::FillRule>(shape.geometry), color);
    }

    gl::Context context_;
    std::unique_ptr<NVGcontext, Delete> c_;
    std::optional<GlFramebuffer> target_;
};

class NanoVgDocument : public Document {
public:
    NanoVgDocument(Surface& surface, const std::string& path)
        : surface_(surface), shapes_(shapesOf(svg::load(image::readFile(path)).scene)) {}
    void draw(const asset::View& view) override { surface_.draw(shapes_, view); }

private:
    Surface& surface_;
    std::vector<Shape> shapes_;
};

class NanoVg : public Peer {
public:
    std::unique_ptr<Document> read(const std::string& path, double, double) override {
        return std::make_unique<NanoVgDocument>(surface_, path);
    }
    image::Bitmap pixels() const override { return surface_.pixels(); }
    const std::string& driver() const { return surface_.driver(); }

private:
    Surface surface_;
};

}  // namespace
}  // namespace vtm::bench

int main() {
    using namespace vtm::bench;
    PeerProcess process;
    try {
        auto nanovg = std::make_unique<NanoVg>();
        const std::string driver = nanovg->driver();
        process.add("nanovg", "paths", "NanoVG on " + driver + ", the paths of our scene", std::move(nanovg));
    } catch (const std::exception& error) {
        std::cout << "missing nanovg: missing, " << error.what() << ".\n";
    }
    process.run();
}
