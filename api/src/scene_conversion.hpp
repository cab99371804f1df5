/// \file
/// Parts of the conversion between scenes and VTMs: kinds of nodes, and groups of a scene as VTMs and back,
/// for the contents of masks and patterns.
#pragma once

#include <vtm/authoring.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm {

/// The node as one of its kinds; null for another kind and for null.
template <class Kind>
const Kind* as(const VtmNode* node) {
    return node == nullptr ? nullptr : std::get_if<Kind>(&node->value);
}

Vtm fromGroup(const scene::Group& group);

struct FramedGroup {
    scene::Group group;
    bool fillsFrame;  ///< whether there are paints over the whole plane, without which any frame gives the
                      ///< same
};

/// Paints over the whole plane fill the frame, the rectangle with these corners.
FramedGroup toGroup(const Vtm& vtm, scene::Point min, scene::Point max);

}  // namespace vtm
