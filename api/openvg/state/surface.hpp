/// \file
/// What is drawn into: pixels and a mask (specification sections 4 and 7.2).
#pragma once

#include <memory>
#include <optional>

#include <vtm/vg.h>

#include "api/openvg/state/objects.hpp"

struct VtmSurface {
    std::shared_ptr<vtm::openvg::ImageStorage> storage;
    std::optional<vtm::openvg::MaskValues> mask;  ///< nothing: every value counts as 1
    bool isImage = false;                         ///< drawn into an image of a context
    VtmContext* user = nullptr;                   ///< the context that it is current with
    bool isDestroyed = false;                     ///< goes when it is no longer current

    vtm::openvg::Pixels& pixels() { return storage->pixels; }
    const vtm::openvg::Pixels& pixels() const { return storage->pixels; }
    int width() const { return pixels().width(); }
    int height() const { return pixels().height(); }
    vtm::openvg::Rectangle bounds() const { return {0, 0, width(), height()}; }
};

namespace vtm::openvg {

using Surface = ::VtmSurface;

inline constexpr int maxSurfaceSide = 16384;

}  // namespace vtm::openvg
