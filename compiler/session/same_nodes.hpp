/// \file
/// Two scenes' nodes in; out comes whether they draw the same.
#pragma once

#include <vtm/scene/scene.hpp>

namespace vtm::compiler {

/// By value, but paths, bitmaps and linked parts by pointer, as sessions tell them apart: nodes that are not
/// the same may still look the same. Polygons of a few points are compared by value too.
bool isSame(const scene::Item& a, const scene::Item& b);
bool isSame(const scene::Select& a, const scene::Select& b);
/// Of groups all but their children.
bool isSameBesideChildren(const scene::Group& a, const scene::Group& b);
bool isSame(const scene::Node& a, const scene::Node& b);
bool areSame(const scene::NodeList& a, const scene::NodeList& b);

}  // namespace vtm::compiler
