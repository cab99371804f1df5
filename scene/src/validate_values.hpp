/// \file
/// What a node's own values may be, without the nodes below it. Each function says what is wrong, or
/// nothing.
#pragma once

#include <string>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {

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

}  // namespace vtm::scene
