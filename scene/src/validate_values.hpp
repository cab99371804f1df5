/// \file
/// What a node's own values may be, without the nodes below it. Each function says what is wrong, or
/// nothing.
#pragma once

#include <cmath>
#include <string>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {

inline bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }
inline bool finite(const Affine& m) { return finite(m[0]) && finite(m[1]) && finite(m[2]); }

/// Whether an enum that ends with `last` has the value.
template <class Enum>
bool known(Enum value, Enum last) {
    return int(value) >= 0 && value <= last;
}

std::string fault(const Scene& scene);
std::string fault(const Path& path);
std::string fault(FillRule rule);
std::string fault(const StrokeStyle& style);
std::string fault(const Color& color);
std::string fault(const LinearGradient& gradient);
std::string fault(const RadialGradient& gradient);
std::string fault(const Pattern& pattern);
std::string fault(const ImagePaint& paint);
std::string fault(const Material& material);
std::string fault(const Item& item);
std::string fault(const Shape& shape);
std::string fault(const Group& group);
std::string fault(const ClipShape& shape);
std::string fault(const Mask& mask);
std::string fault(const Filter& filter);  ///< but for the pictures in it

}  // namespace vtm::scene
