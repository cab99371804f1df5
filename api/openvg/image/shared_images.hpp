/// \file
/// EGLImage siblings (VG_KHR_EGL_image, EGL_KHR_image_base section 2.5).
#pragma once

#include <memory>
#include <vector>

#include <vtm/vg_image.h>

#include "api/openvg/state/objects.hpp"

namespace vtm::openvg {

/// Lives as long as its siblings can grow in number, or are more than the one that was shared: an image is a
/// sibling while its storage knows of one of these.
struct SharedPixels {
    std::shared_ptr<ImageStorage> storage;
    Rectangle area;
    VGint formatName = 0;
    VGbitfield allowedQuality = 0;
};

}  // namespace vtm::openvg

struct VtmSharedImage {
    explicit VtmSharedImage(std::shared_ptr<const vtm::openvg::SharedPixels> shared)
        : pixels(std::move(shared)), storage(pixels->storage), area(pixels->area) {}

    std::shared_ptr<const vtm::openvg::SharedPixels> pixels;  ///< null: it will have no name any more
    const std::weak_ptr<vtm::openvg::ImageStorage> storage;
    const vtm::openvg::Rectangle area;
    VGeglImageKHR name = nullptr;
    std::vector<std::uint8_t> stored, bytes;  ///< when last taken or put; empty before
};
