/// \file
/// EGLImages of the system's as images of OpenVG (VG_KHR_EGL_image): textures and renderbuffers of OpenGL ES,
/// and whatever else a driver makes a GL_TEXTURE_2D of. Each gets a texture in a context of ours.
#pragma once

#include <EGL/egl.h>

namespace vtm::egl {

struct Display;

/// The system has made the EGLImage: OpenVG may use it from now on.
void importImage(EGLDisplay display, EGLImage image);
/// The program has the EGLImage no longer; images stay.
void forgetImported(EGLDisplay display, EGLImage image);
/// When the display terminates: images keep the pixels.
void detachImported(Display& display);

/// Whether OpenVG has such images.
bool haveImported();
/// Gives what OpenVG has changed to OpenGL; with a context of OpenGL current in this thread, also the other
/// way.
void synchronizeImported();

}  // namespace vtm::egl
