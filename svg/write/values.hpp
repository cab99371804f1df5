/// \file
/// Values of the scene as texts of SVG that read back as the same values.
#pragma once

#include <string>
#include <string_view>

#include <vtm/scene/paint.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>

namespace vtm::svg {

/// The shortest decimal that reads back as the number. Throws WriteError where none does: beyond maxNumber.
std::string number(double value);
std::string number(float value);
/// Two numbers with a space between them.
std::string pair(scene::Point p);

/// A value of `d`.
std::string pathData(const scene::Path& path);
/// #rrggbb, rounded to 8 bits a channel; alpha is left out.
std::string hex(const scene::Color& color);

/// ` NAME="VALUE"`.
std::string attribute(std::string_view name, std::string_view value);
/// An attribute for an opacity; empty for 1.
std::string opacityAttribute(std::string_view name, float value);
/// An attribute for a map; empty for the identity.
std::string transformAttribute(std::string_view name, const scene::Affine& map);
/// Attributes for all of a stroke but its paint; those with their initial value are left out.
std::string strokeAttributes(const scene::StrokeStyle& style);

}  // namespace vtm::svg
