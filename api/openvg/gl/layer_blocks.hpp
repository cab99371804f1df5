/// \file
/// Sources and surfaces as the shaders' parameters.
#pragma once

#include <optional>

#include "api/openvg/draw/source_description.hpp"
#include "api/openvg/gl/batch.hpp"
#include "api/openvg/state/context.hpp"

namespace vtm::openvg::gl {

/// How pixels of a format are kept in a texture: as bytes red, green, blue, alpha of the colours that
/// PixelFormat::decode gives, in its space. Every format comes back as it was.
PixelFormat texelFormat(const PixelFormat& format);

/// The largest number of each channel of such a texture.
glm::vec4 levelsOf(const PixelFormat& format);

/// What of a block the target decides.
void setSurface(LayerBlock& block, const PixelFormat& format, int width, int height);
/// From where pixels are counted: near to all that is drawn, so that floats hold places.
void setOrigin(LayerBlock& block, glm::ivec2 origin);
/// Texels of an image.
TexelBlock texelBlock(const TexelField& field, glm::ivec2 origin);

/// Copying: of the format that texels have, and where they are: `shift` from pixels to texels.
void setCopied(LayerBlock& block, const PixelFormat& format, glm::ivec2 shift);

/// What a gradient's ramp is; nothing if it has more pieces than a row holds.
std::optional<RampRow> rampRow(const ColorRamp& ramp);
void setGradient(LayerBlock& block, const LinearField& field, glm::ivec2 origin);
void setGradient(LayerBlock& block, const RadialField& field, glm::ivec2 origin);

void setTransform(LayerBlock& block, const ColorTransform& transform, ColorSpace from);

}  // namespace vtm::openvg::gl
