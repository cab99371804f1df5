/// \file
/// Shapes through OpenVG into memory, call by call and as a recording.
#pragma once

#include <initializer_list>
#include <memory>
#include <variant>
#include <vector>

#include <VG/openvg.h>
#include <vtm/vg.h>

#include "bench/engines/shape.hpp"

namespace vtm::bench {

class VgCanvas {
public:
    static constexpr int side = 1024;

    explicit VgCanvas(VtmCompositor compositor = VTM_COMPOSITOR_CPU, int surfaceSide = side) {
        const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE};
        surface_ = vtmCreateSurface(surfaceSide, surfaceSide, &format);
        vtmChooseCompositor(surface_, compositor);
        context_ = vtmCreateContext(nullptr);
        vtmMakeCurrent(context_, surface_);
        paint_ = vgCreatePaint();
        vgSetPaint(paint_, VG_FILL_PATH | VG_STROKE_PATH);
        const VGfloat white[]{1, 1, 1, 1};
        vgSetfv(VG_CLEAR_COLOR, 4, white);
    }
    ~VgCanvas() {
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroyContext(context_);
        vtmDestroySurface(surface_);
    }
    VgCanvas(const VgCanvas&) = delete;
    VgCanvas& operator=(const VgCanvas&) = delete;

    /// What was asked for draws.
    bool isDrawnBy(VtmCompositor compositor) const { return vtmGetCompositor(surface_) == compositor; }

    void add(const Shape& shape) {
        const VGPath path =
            vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
        set(path, shape.path);
        shapes_.push_back({path, shape});
    }
    /// Gives the shape another outline.
    void change(std::size_t i, const scene::Path& path) {
        vgClearPath(shapes_[i].path, VG_PATH_CAPABILITY_ALL);
        set(shapes_[i].path, path);
    }
    void draw(const scene::Affine& view) {
        vgClear(0, 0, side, side);
        for (const Drawn& drawn : shapes_) {
            const scene::Color& c = drawn.shape.color;
            const VGfloat rgba[]{c.r, c.g, c.b, c.a};
            vgSetParameterfv(paint_, VG_PAINT_COLOR, 4, rgba);
            load(scene::compose(view, drawn.shape.toPicture));
            if (const auto* stroke = std::get_if<scene::StrokeStyle>(&drawn.shape.geometry)) {
                vgSetf(VG_STROKE_LINE_WIDTH, VGfloat(stroke->width));
                vgSetf(VG_STROKE_MITER_LIMIT, VGfloat(stroke->miterLimit));
                vgDrawPath(drawn.path, VG_STROKE_PATH);
            } else {
                vgSeti(VG_FILL_RULE,
                       std::get<scene::FillRule>(drawn.shape.geometry) == scene::FillRule::EvenOdd
                           ? VG_EVEN_ODD
                           : VG_NON_ZERO);
                vgDrawPath(drawn.path, VG_FILL_PATH);
            }
        }
    }

    /// What draw() draws, as one picture. False if it cannot be had.
    bool record() {
        vtmBeginRecording(side, side);
        draw(scene::identity);
        recording_.reset(vtmEndRecording());
        return recording_ != nullptr;
    }
    void drawRecording(const scene::Affine& view) {
        vgClear(0, 0, side, side);
        load(view);
        vtmDrawRecording(recording_.get());
    }

    /// Appends an outline.
    static void set(VGPath to, const scene::Path& path) {
        std::vector<VGubyte> commands;
        std::vector<VGfloat> numbers;
        const auto add = [&](VGubyte command, std::initializer_list<scene::Point> points) {
            commands.push_back(command);
            for (const scene::Point p : points)
                numbers.insert(numbers.end(), {VGfloat(p.x), VGfloat(p.y)});
        };
        for (const scene::Command& command : path) {
            if (const auto* move = std::get_if<scene::MoveTo>(&command))
                add(VG_MOVE_TO_ABS, {move->to});
            else if (const auto* line = std::get_if<scene::LineTo>(&command))
                add(VG_LINE_TO_ABS, {line->to});
            else if (const auto* quad = std::get_if<scene::QuadTo>(&command))
                add(VG_QUAD_TO_ABS, {quad->control, quad->to});
            else if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
                add(VG_CUBIC_TO_ABS, {cubic->control1, cubic->control2, cubic->to});
            else
                add(VG_CLOSE_PATH, {});
        }
        if (!commands.empty())
            vgAppendPathData(to, VGint(commands.size()), commands.data(), numbers.data());
    }

private:
    struct Drawn {
        VGPath path;
        Shape shape;
    };

    static void load(const scene::Affine& m) {
        const VGfloat matrix[]{VGfloat(m[0].x), VGfloat(m[0].y), 0, VGfloat(m[1].x), VGfloat(m[1].y), 0,
                               VGfloat(m[2].x), VGfloat(m[2].y), 1};
        vgLoadMatrix(matrix);
    }

    VtmSurface* surface_;
    VtmContext* context_;
    VGPaint paint_;
    std::vector<Drawn> shapes_;
    std::unique_ptr<VtmRecording, decltype(&vtmDestroyRecording)> recording_{nullptr, vtmDestroyRecording};
};

}  // namespace vtm::bench
