/// \file
/// Values of .vtmtree files as texts that read back as the same values.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/paint.hpp>
#include <vtm/scene/stroke.hpp>

namespace vtm::treetext {

/// In quotes, with \ before " and \.
std::string inQuotes(std::string_view text);
std::string color(const scene::Color& color);
std::string transform(const scene::Affine& map);
/// A space and what makes another shape of an outline; empty for a fill by the non-zero rule.
std::string geometry(const std::variant<scene::FillRule, scene::StrokeStyle>& geometry);
/// A gradient, from its keyword on.
std::string gradient(const scene::LinearGradient& gradient);
std::string gradient(const scene::RadialGradient& gradient);
/// ` transform FUNCTION`; empty for the identity.
std::string paintTransform(const scene::Affine& map);

}  // namespace vtm::treetext
