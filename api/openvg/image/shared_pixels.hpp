/// \file
/// Pixels of EGLImage siblings (VG_KHR_EGL_image).
#pragma once

#include <memory>

#include <VG/vgext.h>

#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

/// Lives as long as its siblings can grow in number, or are more than the one that was shared: an image is a
/// sibling while its storage knows of one of these.
struct SharedPixels {
    std::shared_ptr<ImageStorage> storage;
    Rectangle area;
    VGint formatName = 0;
    VGbitfield allowedQuality = 0;
};

/// Those of another API that have this name; null if there are none. Throws
/// VG_UNSUPPORTED_IMAGE_FORMAT_ERROR.
std::shared_ptr<const SharedPixels> foreignPixels(const Context& context, VGeglImageKHR name);

/// What OpenVG has changed goes to the other APIs (vgFinish).
void handOverPixels();

}  // namespace vtm::openvg
