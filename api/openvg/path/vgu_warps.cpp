// Section 17.2: projective maps between quadrilaterals, and of lines (VG_NDS_projective_geometry).

#include <cmath>
#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <VG/vgext.h>

#include "api/openvg/state/context.hpp"
#include "api/openvg/state/matrix.hpp"

using namespace vtm::openvg;

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
