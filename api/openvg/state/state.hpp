/// \file
/// A context's parameters (specification sections 5.2 and 6.6).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>

#include <VG/vgext.h>

#include "api/openvg/state/objects.hpp"

namespace vtm::openvg {

/// Limits that programs can ask for.
inline constexpr VGint maxScissorRects = 256, maxDashCount = 256, maxKernelSize = 31,
                       maxSeparableKernelSize = 127, maxColorRampStops = 256, maxImageSide = 16384,
                       maxImagePixels = 1 << 28, maxImageBytes = 1 << 30, maxGaussianStdDeviation = 128,
                       maxAverageBlurDimension = 256, maxAverageBlurIterations = 16, maxClipLines = 32;
inline constexpr VGfloat maxFloat = 1e30f;

/// Values as they were set (vgGet returns them); ranges are applied where they are used. Initial values:
/// table 4.
struct State {
    /// The program has asked for VG_EXTENSIONS. Until then parameters of extensions do not exist: one of them
    /// has the value behind the last of VGParamType, which is illegal for programs that know of no extension
    /// (section 15).
    bool knowsExtensions = false;

    VGint matrixMode = VG_MATRIX_PATH_USER_TO_SURFACE;
    VGint fillRule = VG_EVEN_ODD;
    VGint imageQuality = VG_IMAGE_QUALITY_FASTER;
    VGint renderingQuality = VG_RENDERING_QUALITY_BETTER;
    VGint blendMode = VG_BLEND_SRC_OVER;
    VGint imageMode = VG_DRAW_IMAGE_NORMAL;
    std::vector<VGint> scissorRects;
    bool colorTransform = false;
    std::array<VGfloat, 8> colorTransformValues{1, 1, 1, 1, 0, 0, 0, 0};
    VGfloat lineWidth = 1;
    VGint capStyle = VG_CAP_BUTT;
    VGint joinStyle = VG_JOIN_MITER;
    VGfloat miterLimit = 4;
    std::vector<VGfloat> dashPattern;
    VGfloat dashPhase = 0;
    bool dashPhaseReset = false;
    std::array<VGfloat, 4> tileFillColor{};
    std::array<VGfloat, 4> clearColor{};
    std::array<VGfloat, 2> glyphOrigin{};
    bool masking = false;
    bool scissoring = false;
    VGint pixelLayout = VG_PIXEL_LAYOUT_UNKNOWN;
    bool filterFormatLinear = false;
    bool filterFormatPremultiplied = false;
    VGbitfield filterChannelMask = VG_RED | VG_GREEN | VG_BLUE | VG_ALPHA;

    /// By VGMatrixMode - VG_MATRIX_PATH_USER_TO_SURFACE.
    std::array<glm::mat3, 5> matrices{glm::mat3(1), glm::mat3(1), glm::mat3(1), glm::mat3(1), glm::mat3(1)};
    const glm::mat3& matrix(VGMatrixMode mode) const {
        return matrices[std::size_t(mode - VG_MATRIX_PATH_USER_TO_SURFACE)];
    }

    // VG_NDS_projective_geometry.
    VGint clipMode = VG_CLIPMODE_NONE_NDS;
    std::vector<VGfloat> clipLines;  ///< three numbers each
    std::array<bool, 5>
        projective{};  ///< by mode, like the matrices: their last row is kept, images' mode too
    bool isProjective(VGMatrixMode mode) const {
        return projective[std::size_t(mode - VG_MATRIX_PATH_USER_TO_SURFACE)];
    }

    std::shared_ptr<Paint> fillPaint, strokePaint;  ///< null: the default paint
};

}  // namespace vtm::openvg
