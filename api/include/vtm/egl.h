/*
 * What our libEGL adds to EGL: a config's attribute that says what draws on surfaces (docs/egl.md). Plain C89.
 *
 *     const EGLint attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_COMPOSITOR_VTM, EGL_COMPOSITOR_GL_VTM,
 *                                  EGL_NONE};
 *     eglChooseConfig(display, attributes, &config, 1, &count);
 */
#ifndef VTM_EGL_H
#define VTM_EGL_H

/* Of eglChooseConfig and eglGetConfigAttrib; matched exactly, EGL_COMPOSITOR_AUTOMATIC_VTM if not given. Configs of the
 * system do not have it. */
#define EGL_COMPOSITOR_VTM 0x3FE0

/* Its values: VtmCompositor of <vtm/vg.h>. */
#define EGL_COMPOSITOR_AUTOMATIC_VTM 0x3FE1
#define EGL_COMPOSITOR_CPU_VTM 0x3FE2
#define EGL_COMPOSITOR_GL_VTM 0x3FE3

#endif
