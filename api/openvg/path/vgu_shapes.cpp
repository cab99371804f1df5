// Section 17.1: shapes appended to paths.

#include <cmath>
#include <vector>

#include <glm/trigonometric.hpp>

#include <VG/vgu.h>

#include "api/openvg/state/context.hpp"

using namespace vtm::openvg;

namespace {

/// The commands of a shape, as the specification's pseudo-code has them, and their scaled coordinates.
struct Shape {
    std::vector<VGubyte> commands;
    std::vector<double> coordinates;

    void add(VGubyte command, std::initializer_list<double> numbers) {
        commands.push_back(command);
        coordinates.insert(coordinates.end(), numbers);
    }
};

VGUErrorCode vguError(VGErrorCode code) {
    switch (code) {
        case VG_NO_ERROR:
            return VGU_NO_ERROR;
        case VG_BAD_HANDLE_ERROR:
        case VG_NO_CONTEXT_ERROR:
            return VGU_BAD_HANDLE_ERROR;
        case VG_PATH_CAPABILITY_ERROR:
            return VGU_PATH_CAPABILITY_ERROR;
        case VG_OUT_OF_MEMORY_ERROR:
            return VGU_OUT_OF_MEMORY_ERROR;
        default:
            return VGU_ILLEGAL_ARGUMENT_ERROR;
    }
}

/// Appends what `make` draws, once the arguments are known to be legal.
template <class Make>
VGUErrorCode append(VGPath handle, bool isLegal, Make&& make) {
    return callOr(VGU_BAD_HANDLE_ERROR, [&](Context& context) {
        return vguError(errorOf([&] {
            const std::shared_ptr<Path> path = context.objects->get<Path>(handle);
            require(path->capabilities & VG_PATH_CAPABILITY_APPEND_TO, VG_PATH_CAPABILITY_ERROR);
            require(isLegal);
            Shape shape;
            make(shape);
            path->data.append(shape.commands, shape.coordinates);
            path->masks.clear();
        }));
    });
}

}  // namespace

VGUErrorCode vguLine(VGPath path, VGfloat x0, VGfloat y0, VGfloat x1, VGfloat y1) {
    return append(path, true, [&](Shape& shape) {
        shape.add(VG_MOVE_TO_ABS, {x0, y0});
        shape.add(VG_LINE_TO_ABS, {x1, y1});
    });
}

VGUErrorCode vguPolygon(VGPath path, const VGfloat* points, VGint count, VGboolean closed) {
    return append(path, points != nullptr && isAligned(points) && count > 0, [&](Shape& shape) {
        shape.add(VG_MOVE_TO_ABS, {points[0], points[1]});
        for (VGint i = 1; i < count; ++i)
            shape.add(VG_LINE_TO_ABS, {points[2 * i], points[2 * i + 1]});
        if (closed)
            shape.add(VG_CLOSE_PATH, {});
    });
}

VGUErrorCode vguRect(VGPath path, VGfloat x, VGfloat y, VGfloat width, VGfloat height) {
    return append(path, width > 0 && height > 0, [&](Shape& shape) {
        shape.add(VG_MOVE_TO_ABS, {x, y});
        shape.add(VG_HLINE_TO_REL, {width});
        shape.add(VG_VLINE_TO_REL, {height});
        shape.add(VG_HLINE_TO_REL, {-width});
        shape.add(VG_CLOSE_PATH, {});
    });
}

VGUErrorCode vguRoundRect(VGPath path, VGfloat x, VGfloat y, VGfloat width, VGfloat height, VGfloat arcWidth,
                          VGfloat arcHeight) {
    return append(path, width > 0 && height > 0, [&](Shape& shape) {
        const double w = std::min(std::max(arcWidth, 0.0f), width),
                     h = std::min(std::max(arcHeight, 0.0f), height);
        const double rx = w / 2, ry = h / 2, across = double(width) - w, up = double(height) - h;
        const auto arc = [&](double dx, double dy) { shape.add(VG_SCCWARC_TO_REL, {rx, ry, 0, dx, dy}); };
        shape.add(VG_MOVE_TO_ABS, {double(x) + rx, y});
        shape.add(VG_HLINE_TO_REL, {across});
        arc(rx, ry);
        shape.add(VG_VLINE_TO_REL, {up});
        arc(-rx, ry);
        shape.add(VG_HLINE_TO_REL, {-across});
        arc(-rx, -ry);
        shape.add(VG_VLINE_TO_REL, {-up});
        arc(rx, -ry);
        shape.add(VG_CLOSE_PATH, {});
    });
}

VGUErrorCode vguEllipse(VGPath path, VGfloat cx, VGfloat cy, VGfloat width, VGfloat height) {
    return append(path, width > 0 && height > 0, [&](Shape& shape) {
        const double rx = double(width) / 2, ry = double(height) / 2;
        shape.add(VG_MOVE_TO_ABS, {double(cx) + rx, cy});
        shape.add(VG_SCCWARC_TO_REL, {rx, ry, 0, -double(width), 0});
        shape.add(VG_SCCWARC_TO_REL, {rx, ry, 0, double(width), 0});
        shape.add(VG_CLOSE_PATH, {});
    });
}

VGUErrorCode vguArc(VGPath path, VGfloat x, VGfloat y, VGfloat width, VGfloat height, VGfloat startAngle,
                    VGfloat angleExtent, VGUArcType arcType) {
    // More turns than anybody can see would take for ever.
    constexpr double maxExtent = 360.0 * 1000;
    const bool isLegal =
        width > 0 && height > 0 && VGint(arcType) >= VGU_ARC_OPEN && VGint(arcType) <= VGU_ARC_PIE;
    return append(path, isLegal, [&](Shape& shape) {
        const double rx = double(width) / 2, ry = double(height) / 2;
        // Within a turn, where half turns still count.
        const double start = std::isfinite(startAngle) ? std::fmod(double(startAngle), 360.0) : 0;
        const double extent =
            std::isnan(angleExtent) ? 0 : std::clamp(double(angleExtent), -maxExtent, maxExtent);
        const double last = start + extent;
        const auto px = [&](double degrees) { return double(x) + rx * std::cos(glm::radians(degrees)); };
        const auto py = [&](double degrees) { return double(y) + ry * std::sin(glm::radians(degrees)); };
        const bool isPositive = extent > 0;
        const VGubyte type = isPositive ? VG_SCCWARC_TO_ABS : VG_SCWARC_TO_ABS;
        const double half = isPositive ? 180 : -180;
        shape.add(VG_MOVE_TO_ABS, {px(start), py(start)});
        for (double angle = start + half; isPositive ? angle < last : angle > last; angle += half)
            shape.add(type, {rx, ry, 0, px(angle), py(angle)});
        shape.add(type, {rx, ry, 0, px(last), py(last)});
        if (arcType == VGU_ARC_PIE)
            shape.add(VG_LINE_TO_ABS, {x, y});
        if (arcType != VGU_ARC_OPEN)
            shape.add(VG_CLOSE_PATH, {});
    });
}
