// Section 17.1: shapes appended to paths.

#include <cmath>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include <VG/vgext.h>
#include <VG/vgu.h>

#include "api/openvg/state/context.hpp"
#include "api/openvg/state/matrix.hpp"

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

// Section 17.2: projective maps between quadrilaterals, and of lines (VG_NDS_projective_geometry).

namespace {

using glm::dvec2;

double cross(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }

/// The map that takes (0, 0), (1, 0), (0, 1) and (1, 1) to p00, p10, p01 and p11: p = (A u + B v + C) / (g u
/// + h v + 1).
std::optional<glm::dmat3> squareToQuad(dvec2 p00, dvec2 p10, dvec2 p01, dvec2 p11) {
    const dvec2 sum = p00 - p10 + p11 - p01, d1 = p10 - p11, d2 = p01 - p11;
    double g = 0, h = 0;
    if (sum != dvec2(0)) {
        const double determinant = cross(d1, d2);
        if (determinant == 0)
            return std::nullopt;
        g = cross(sum, d2) / determinant;
        h = cross(d1, sum) / determinant;
    }
    const dvec2 a = p10 - p00 + g * p10, b = p01 - p00 + h * p01;
    return glm::dmat3(a.x, a.y, g, b.x, b.y, h, p00.x, p00.y, 1);
}

VGUErrorCode store(const std::optional<glm::dmat3>& map, VGfloat* matrix) {
    if (!map)
        return VGU_BAD_WARP_ERROR;
    const double determinant = glm::determinant(*map);
    if (!isFinite(*map) || !std::isfinite(determinant) || determinant == 0)
        return VGU_BAD_WARP_ERROR;
    for (int i = 0; i < 9; ++i)
        matrix[i] = VGfloat((*map)[i / 3][i % 3]);
    return VGU_NO_ERROR;
}

std::optional<glm::dmat3> inverse(const std::optional<glm::dmat3>& map) {
    if (!map || glm::determinant(*map) == 0)
        return std::nullopt;
    glm::dmat3 m = glm::inverse(*map);
    // Any multiple is the same map; this one ends in 1, as programs expect of what is affine.
    if (m[2].z != 0)
        m /= m[2].z;
    return m;
}

bool isLegal(const VGfloat* matrix) { return matrix != nullptr && isAligned(matrix); }

}  // namespace

VGUErrorCode vguTransformClipLineNDS(const VGfloat a, const VGfloat b, const VGfloat c, const VGfloat* matrix,
                                     const VGboolean inverse, VGfloat* aOut, VGfloat* bOut, VGfloat* cOut) {
    if (!isLegal(matrix) || !isLegal(aOut) || !isLegal(bOut) || !isLegal(cOut))
        return VGU_ILLEGAL_ARGUMENT_ERROR;
    glm::dmat3 transposed;
    for (int i = 0; i < 9; ++i)
        transposed[i % 3][i / 3] = double(matrix[i]);
    if (!inverse) {
        const double determinant = glm::determinant(transposed);
        transposed = glm::inverse(transposed);
        if (determinant == 0 || !isFinite(transposed))
            return VGU_BAD_WARP_ERROR;
    }
    const glm::dvec3 line = transposed * glm::dvec3(a, b, c);
    *aOut = VGfloat(line.x);
    *bOut = VGfloat(line.y);
    *cOut = VGfloat(line.z);
    return VGU_NO_ERROR;
}

VGUErrorCode vguComputeWarpQuadToSquare(VGfloat sx0, VGfloat sy0, VGfloat sx1, VGfloat sy1, VGfloat sx2,
                                        VGfloat sy2, VGfloat sx3, VGfloat sy3, VGfloat* matrix) {
    if (!isLegal(matrix))
        return VGU_ILLEGAL_ARGUMENT_ERROR;
    return store(inverse(squareToQuad({sx0, sy0}, {sx1, sy1}, {sx2, sy2}, {sx3, sy3})), matrix);
}

VGUErrorCode vguComputeWarpSquareToQuad(VGfloat dx0, VGfloat dy0, VGfloat dx1, VGfloat dy1, VGfloat dx2,
                                        VGfloat dy2, VGfloat dx3, VGfloat dy3, VGfloat* matrix) {
    if (!isLegal(matrix))
        return VGU_ILLEGAL_ARGUMENT_ERROR;
    return store(squareToQuad({dx0, dy0}, {dx1, dy1}, {dx2, dy2}, {dx3, dy3}), matrix);
}

VGUErrorCode vguComputeWarpQuadToQuad(VGfloat dx0, VGfloat dy0, VGfloat dx1, VGfloat dy1, VGfloat dx2,
                                      VGfloat dy2, VGfloat dx3, VGfloat dy3, VGfloat sx0, VGfloat sy0,
                                      VGfloat sx1, VGfloat sy1, VGfloat sx2, VGfloat sy2, VGfloat sx3,
                                      VGfloat sy3, VGfloat* matrix) {
    if (!isLegal(matrix))
        return VGU_ILLEGAL_ARGUMENT_ERROR;
    const std::optional<glm::dmat3> to = squareToQuad({dx0, dy0}, {dx1, dy1}, {dx2, dy2}, {dx3, dy3}),
                                    from =
                                        inverse(squareToQuad({sx0, sy0}, {sx1, sy1}, {sx2, sy2}, {sx3, sy3}));
    if (!to || !from)
        return VGU_BAD_WARP_ERROR;
    glm::dmat3 map = *to * *from;
    if (map[2].z != 0)
        map /= map[2].z;
    return store(map, matrix);
}
