// Section 6.6: matrices.

#include <cmath>

#include <glm/trigonometric.hpp>

#include <VG/vgext.h>

#include "api/openvg/state/context.hpp"

using namespace vtm::openvg;

namespace {

glm::mat3& currentMatrix(Context& context) {
    return context.state.matrices[std::size_t(context.state.matrixMode - VG_MATRIX_PATH_USER_TO_SURFACE)];
}

/// Those of images may be projective, all others end in 0 0 1 unless the program enabled more.
glm::mat3 fitting(const Context& context, glm::mat3 m) {
    const auto mode = VGMatrixMode(context.state.matrixMode);
    if (mode != VG_MATRIX_IMAGE_USER_TO_SURFACE && !context.state.isProjective(mode)) {
        m[0].z = m[1].z = 0;
        m[2].z = 1;
    }
    return m;
}

glm::mat3 read(const Context& context, const VGfloat* m) {
    require(m != nullptr && isAligned(m));
    return fitting(context, {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]});
}

void multiply(const glm::mat3& m) {
    call([&](Context& context) { currentMatrix(context) = currentMatrix(context) * m; });
}

}  // namespace

void vgLoadIdentity(void) {
    call([](Context& context) { currentMatrix(context) = glm::mat3(1); });
}

void vgLoadMatrix(const VGfloat* m) {
    call([&](Context& context) { currentMatrix(context) = read(context, m); });
}

void vgGetMatrix(VGfloat* m) {
    call([&](Context& context) {
        require(m != nullptr && isAligned(m));
        const glm::mat3& matrix = currentMatrix(context);
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                m[3 * column + row] = matrix[column][row];
    });
}

void vgMultMatrix(const VGfloat* m) {
    call([&](Context& context) { currentMatrix(context) = currentMatrix(context) * read(context, m); });
}

void vgProjectiveMatrixNDS(VGboolean enable) {
    call([&](Context& context) {
        State& state = context.state;
        state.projective[std::size_t(state.matrixMode - VG_MATRIX_PATH_USER_TO_SURFACE)] = enable != VG_FALSE;
        currentMatrix(context) = fitting(context, currentMatrix(context));
    });
}

void vgTranslate(VGfloat tx, VGfloat ty) { multiply({1, 0, 0, 0, 1, 0, tx, ty, 1}); }
void vgScale(VGfloat sx, VGfloat sy) { multiply({sx, 0, 0, 0, sy, 0, 0, 0, 1}); }
void vgShear(VGfloat shx, VGfloat shy) { multiply({1, shy, 0, shx, 1, 0, 0, 0, 1}); }

void vgRotate(VGfloat angle) {
    const double a = glm::radians(double(angle));
    const auto c = VGfloat(std::cos(a)), s = VGfloat(std::sin(a));
    multiply({c, s, 0, -s, c, 0, 0, 0, 1});
}
