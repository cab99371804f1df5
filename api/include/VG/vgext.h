/*
 * OpenVG and VGU extensions of libOpenVG.so.1, with the names and values of the Khronos registry;
 * vgGetString(VG_EXTENSIONS) lists them. Plain C89. All functions are exported; eglGetProcAddress and
 * vtmGetProcAddress find them too. docs/openvg_extensions.md says how we resolve what the registered texts
 * leave open.
 */
#ifndef VTM_VG_VGEXT_H
#define VTM_VG_VGEXT_H

#include <VG/openvg.h>
#include <VG/vgu.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef VG_API_ENTRYP
#define VG_API_ENTRYP VG_API_ENTRY *
#endif
#ifndef VGU_API_ENTRYP
#define VGU_API_ENTRYP VGU_API_ENTRY *
#endif

/* ---- VG_KHR_iterative_average_blur ---- */

/* Read-only context parameters. */
typedef enum {
    VG_MAX_AVERAGE_BLUR_DIMENSION_KHR = 0x116B,
    VG_AVERAGE_BLUR_DIMENSION_RESOLUTION_KHR = 0x116C, /* fractional bits; -1: float precision */
    VG_MAX_AVERAGE_BLUR_ITERATIONS_KHR = 0x116D,
    VG_PARAM_TYPE_KHR_FORCE_SIZE = VG_MAX_ENUM
} VGParamTypeKHR;

#ifndef VG_KHR_iterative_average_blur
#define VG_KHR_iterative_average_blur 1

/* Averages `src` over dimX by dimY pixels, `iterative` times, and stores the result in `dst`. */
#ifdef VG_VGEXT_PROTOTYPES
VG_API_CALL void VG_API_ENTRY vgIterativeAverageBlurKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY,
                                                        VGuint iterative,
                                                        VGTilingMode tilingMode) VG_API_EXIT;
#endif
typedef void(VG_API_ENTRYP PFNVGITERATIVEAVERAGEBLURKHRPROC)(VGImage dst, VGImage src, VGfloat dimX,
                                                             VGfloat dimY, VGuint iterative,
                                                             VGTilingMode tilingMode);

#endif

/* ---- VG_KHR_EGL_image ---- */

#ifndef VG_KHR_EGL_image
#define VG_KHR_EGL_image 1

/* An EGLImage that eglCreateImage made of an OpenVG image (EGL_VG_PARENT_IMAGE_KHR). */
typedef void *VGeglImageKHR;

/* Creates an image that shares the pixels of the EGLImage. Returns VG_INVALID_HANDLE on failure. */
#ifdef VG_VGEXT_PROTOTYPES
VG_API_CALL VGImage VG_API_ENTRY vgCreateEGLImageTargetKHR(VGeglImageKHR image) VG_API_EXIT;
#endif
typedef VGImage(VG_API_ENTRYP PFNVGCREATEEGLIMAGETARGETKHRPROC)(VGeglImageKHR image);

#endif

/* ---- VG_KHR_advanced_blending: values of VG_BLEND_MODE ---- */

#ifndef VG_KHR_advanced_blending
#define VG_KHR_advanced_blending 1

typedef enum {
    VG_BLEND_OVERLAY_KHR = 0x2010,
    VG_BLEND_HARDLIGHT_KHR = 0x2011,
    VG_BLEND_SOFTLIGHT_SVG_KHR = 0x2012,
    VG_BLEND_SOFTLIGHT_KHR = 0x2013,
    VG_BLEND_COLORDODGE_KHR = 0x2014,
    VG_BLEND_COLORBURN_KHR = 0x2015,
    VG_BLEND_DIFFERENCE_KHR = 0x2016,
    VG_BLEND_SUBTRACT_KHR = 0x2017,
    VG_BLEND_INVERT_KHR = 0x2018,
    VG_BLEND_EXCLUSION_KHR = 0x2019,
    VG_BLEND_LINEARDODGE_KHR = 0x201A,
    VG_BLEND_LINEARBURN_KHR = 0x201B,
    VG_BLEND_VIVIDLIGHT_KHR = 0x201C,
    VG_BLEND_LINEARLIGHT_KHR = 0x201D,
    VG_BLEND_PINLIGHT_KHR = 0x201E,
    VG_BLEND_HARDMIX_KHR = 0x201F,
    VG_BLEND_CLEAR_KHR = 0x2020,
    VG_BLEND_DST_KHR = 0x2021,
    VG_BLEND_SRC_OUT_KHR = 0x2022,
    VG_BLEND_DST_OUT_KHR = 0x2023,
    VG_BLEND_SRC_ATOP_KHR = 0x2024,
    VG_BLEND_DST_ATOP_KHR = 0x2025,
    VG_BLEND_XOR_KHR = 0x2026,
    VG_BLEND_MODE_KHR_FORCE_SIZE = VG_MAX_ENUM
} VGBlendModeKHR;

#endif

/* ---- VG_KHR_parametric_filter ---- */

#ifndef VG_KHR_parametric_filter
#define VG_KHR_parametric_filter 1

typedef enum {
    VG_PF_OBJECT_VISIBLE_FLAG_KHR = (1 << 0),
    VG_PF_KNOCKOUT_FLAG_KHR = (1 << 1),
    VG_PF_OUTER_FLAG_KHR = (1 << 2),
    VG_PF_INNER_FLAG_KHR = (1 << 3),
    VG_PF_TYPE_KHR_FORCE_SIZE = VG_MAX_ENUM
} VGPfTypeKHR;

typedef enum { VGU_IMAGE_IN_USE_ERROR = 0xF010, VGU_ERROR_CODE_KHR_FORCE_SIZE = VG_MAX_ENUM } VGUErrorCodeKHR;

/* Offsets and distances are in pixels, angles in degrees. The VGU functions blur `src` with
 * vgIterativeAverageBlurKHR and leave vgGetError() at VG_NO_ERROR. */
#ifdef VG_VGEXT_PROTOTYPES
VG_API_CALL void VG_API_ENTRY vgParametricFilterKHR(VGImage dst, VGImage src, VGImage blur, VGfloat strength,
                                                    VGfloat offsetX, VGfloat offsetY, VGbitfield filterFlags,
                                                    VGPaint highlightPaint, VGPaint shadowPaint) VG_API_EXIT;
VGU_API_CALL VGUErrorCode VGU_API_ENTRY vguDropShadowKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY,
                                                         VGuint iterative, VGfloat strength, VGfloat distance,
                                                         VGfloat angle, VGbitfield filterFlags,
                                                         VGbitfield allowedQuality,
                                                         VGuint shadowColorRGBA) VGU_API_EXIT;
VGU_API_CALL VGUErrorCode VGU_API_ENTRY vguGlowKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY,
                                                   VGuint iterative, VGfloat strength, VGbitfield filterFlags,
                                                   VGbitfield allowedQuality,
                                                   VGuint glowColorRGBA) VGU_API_EXIT;
VGU_API_CALL VGUErrorCode VGU_API_ENTRY vguBevelKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY,
                                                    VGuint iterative, VGfloat strength, VGfloat distance,
                                                    VGfloat angle, VGbitfield filterFlags,
                                                    VGbitfield allowedQuality, VGuint highlightColorRGBA,
                                                    VGuint shadowColorRGBA) VGU_API_EXIT;
VGU_API_CALL VGUErrorCode VGU_API_ENTRY vguGradientGlowKHR(VGImage dst, VGImage src, VGfloat dimX,
                                                           VGfloat dimY, VGuint iterative, VGfloat strength,
                                                           VGfloat distance, VGfloat angle,
                                                           VGbitfield filterFlags, VGbitfield allowedQuality,
                                                           VGuint stopsCount,
                                                           const VGfloat *glowColorRampStops) VGU_API_EXIT;
VGU_API_CALL VGUErrorCode VGU_API_ENTRY vguGradientBevelKHR(VGImage dst, VGImage src, VGfloat dimX,
                                                            VGfloat dimY, VGuint iterative, VGfloat strength,
                                                            VGfloat distance, VGfloat angle,
                                                            VGbitfield filterFlags, VGbitfield allowedQuality,
                                                            VGuint stopsCount,
                                                            const VGfloat *bevelColorRampStops) VGU_API_EXIT;
#endif
typedef void(VG_API_ENTRYP PFNVGPARAMETRICFILTERKHRPROC)(VGImage dst, VGImage src, VGImage blur,
                                                         VGfloat strength, VGfloat offsetX, VGfloat offsetY,
                                                         VGbitfield filterFlags, VGPaint highlightPaint,
                                                         VGPaint shadowPaint);
typedef VGUErrorCode(VGU_API_ENTRYP PFNVGUDROPSHADOWKHRPROC)(VGImage dst, VGImage src, VGfloat dimX,
                                                             VGfloat dimY, VGuint iterative, VGfloat strength,
                                                             VGfloat distance, VGfloat angle,
                                                             VGbitfield filterFlags,
                                                             VGbitfield allowedQuality,
                                                             VGuint shadowColorRGBA);
typedef VGUErrorCode(VGU_API_ENTRYP PFNVGUGLOWKHRPROC)(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY,
                                                       VGuint iterative, VGfloat strength,
                                                       VGbitfield filterFlags, VGbitfield allowedQuality,
                                                       VGuint glowColorRGBA);
typedef VGUErrorCode(VGU_API_ENTRYP PFNVGUBEVELKHRPROC)(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY,
                                                        VGuint iterative, VGfloat strength, VGfloat distance,
                                                        VGfloat angle, VGbitfield filterFlags,
                                                        VGbitfield allowedQuality, VGuint highlightColorRGBA,
                                                        VGuint shadowColorRGBA);
typedef VGUErrorCode(VGU_API_ENTRYP PFNVGUGRADIENTGLOWKHRPROC)(VGImage dst, VGImage src, VGfloat dimX,
                                                               VGfloat dimY, VGuint iterative,
                                                               VGfloat strength, VGfloat distance,
                                                               VGfloat angle, VGbitfield filterFlags,
                                                               VGbitfield allowedQuality, VGuint stopsCount,
                                                               const VGfloat *glowColorRampStops);
typedef VGUErrorCode(VGU_API_ENTRYP PFNVGUGRADIENTBEVELKHRPROC)(VGImage dst, VGImage src, VGfloat dimX,
                                                                VGfloat dimY, VGuint iterative,
                                                                VGfloat strength, VGfloat distance,
                                                                VGfloat angle, VGbitfield filterFlags,
                                                                VGbitfield allowedQuality, VGuint stopsCount,
                                                                const VGfloat *bevelColorRampStops);

#endif

/* ---- VG_NDS_paint_generation ---- */

#ifndef VG_NDS_paint_generation
#define VG_NDS_paint_generation 1

/* Paint parameters. */
typedef enum {
    VG_PAINT_COLOR_RAMP_LINEAR_NDS = 0x1A10,
    VG_COLOR_MATRIX_NDS = 0x1A11, /* 20 floats: the columns for red, green, blue, alpha, and the constant */
    VG_PAINT_COLOR_TRANSFORM_LINEAR_NDS = 0x1A12,
    VG_PAINT_PARAM_TYPE_NDS_FORCE_SIZE = VG_MAX_ENUM
} VGPaintParamTypeNds;

/* A value of VG_IMAGE_MODE. */
typedef enum {
    VG_DRAW_IMAGE_COLOR_MATRIX_NDS = 0x1F10,
    VG_IMAGE_MODE_NDS_FORCE_SIZE = VG_MAX_ENUM
} VGImageModeNds;

#endif

/* ---- VG_NDS_projective_geometry ---- */

#ifndef VG_NDS_projective_geometry
#define VG_NDS_projective_geometry 1

/* Context parameters. */
typedef enum {
    VG_CLIP_MODE_NDS = 0x1180,
    VG_CLIP_LINES_NDS = 0x1181, /* a, b, c of each line: points with a w x + b w y + c w >= 0 are kept */
    VG_MAX_CLIP_LINES_NDS = 0x1182,
    VG_PARAM_TYPE_NDS_FORCE_SIZE = VG_MAX_ENUM
} VGParamTypeNds;

typedef enum {
    VG_CLIPMODE_NONE_NDS = 0x3000,
    VG_CLIPMODE_CLIP_CLOSED_NDS = 0x3001,
    VG_CLIPMODE_CLIP_OPEN_NDS = 0x3002,
    VG_CLIPMODE_CULL_NDS = 0x3003,
    VG_CLIPMODE_NDS_FORCE_SIZE = VG_MAX_ENUM
} VGClipModeNds;

/* Rational curves. Coordinates: w0, x1, y1, w1, x2, y2, w2, and x3, y3, w3 for cubic ones. */
typedef enum {
    VG_RQUAD_TO_NDS = (13 << 1),
    VG_RCUBIC_TO_NDS = (14 << 1),
    VG_PATH_SEGMENT_NDS_FORCE_SIZE = VG_MAX_ENUM
} VGPathSegmentNds;

typedef enum {
    VG_RQUAD_TO_ABS_NDS = (13 << 1) | 0,
    VG_RQUAD_TO_REL_NDS = (13 << 1) | 1,
    VG_RCUBIC_TO_ABS_NDS = (14 << 1) | 0,
    VG_RCUBIC_TO_REL_NDS = (14 << 1) | 1,
    VG_PATH_COMMAND_NDS_FORCE_SIZE = VG_MAX_ENUM
} VGPathCommandNds;

/* vgProjectiveMatrixNDS applies to the matrix of the current VG_MATRIX_MODE. */
#ifdef VG_VGEXT_PROTOTYPES
VG_API_CALL void VG_API_ENTRY vgProjectiveMatrixNDS(VGboolean enable) VG_API_EXIT;
VGU_API_CALL VGUErrorCode VGU_API_ENTRY vguTransformClipLineNDS(const VGfloat Ain, const VGfloat Bin,
                                                                const VGfloat Cin, const VGfloat *matrix,
                                                                const VGboolean inverse, VGfloat *Aout,
                                                                VGfloat *Bout, VGfloat *Cout) VGU_API_EXIT;
#endif
typedef void(VG_API_ENTRYP PFNVGPROJECTIVEMATRIXNDSPROC)(VGboolean enable);
typedef VGUErrorCode(VGU_API_ENTRYP PFNVGUTRANSFORMCLIPLINENDSPROC)(const VGfloat Ain, const VGfloat Bin,
                                                                    const VGfloat Cin, const VGfloat *matrix,
                                                                    const VGboolean inverse, VGfloat *Aout,
                                                                    VGfloat *Bout, VGfloat *Cout);

#endif

#ifdef __cplusplus
}
#endif

#endif
