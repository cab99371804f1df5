/* vgext.h is plain C89, alone and together with the headers that it stands on. */
#include <VG/vgext.h>

#include <VG/openvg.h>
#include <VG/vgu.h>

PFNVGITERATIVEAVERAGEBLURKHRPROC const averageBlurInC = vgIterativeAverageBlurKHR;
PFNVGPARAMETRICFILTERKHRPROC const parametricFilterInC = vgParametricFilterKHR;
PFNVGUDROPSHADOWKHRPROC const dropShadowInC = vguDropShadowKHR;
PFNVGUGLOWKHRPROC const glowInC = vguGlowKHR;
PFNVGUBEVELKHRPROC const bevelInC = vguBevelKHR;
PFNVGUGRADIENTGLOWKHRPROC const gradientGlowInC = vguGradientGlowKHR;
PFNVGUGRADIENTBEVELKHRPROC const gradientBevelInC = vguGradientBevelKHR;

VGBlendModeKHR const blendModeInC = VG_BLEND_XOR_KHR;
VGParamTypeKHR const paramTypeInC = VG_MAX_AVERAGE_BLUR_DIMENSION_KHR;
VGPfTypeKHR const flagInC = VG_PF_INNER_FLAG_KHR;
VGUErrorCodeKHR const errorInC = VGU_IMAGE_IN_USE_ERROR;
VGPaintParamTypeNds const paintParamTypeInC = VG_PAINT_COLOR_TRANSFORM_LINEAR_NDS;
VGImageModeNds const imageModeInC = VG_DRAW_IMAGE_COLOR_MATRIX_NDS;

PFNVGCREATEEGLIMAGETARGETKHRPROC const createTargetInC = vgCreateEGLImageTargetKHR;
PFNVGPROJECTIVEMATRIXNDSPROC const projectiveMatrixInC = vgProjectiveMatrixNDS;
PFNVGUTRANSFORMCLIPLINENDSPROC const transformClipLineInC = vguTransformClipLineNDS;

VGParamTypeNds const paramTypeNdsInC = VG_MAX_CLIP_LINES_NDS;
VGClipModeNds const clipModeInC = VG_CLIPMODE_CULL_NDS;
VGPathSegmentNds const segmentInC = VG_RCUBIC_TO_NDS;
VGPathCommandNds const commandInC = VG_RCUBIC_TO_REL_NDS;
