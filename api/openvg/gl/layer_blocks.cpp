#include "api/openvg/gl/layer_blocks.hpp"

#include <cmath>

#include "api/openvg/draw/texel_source.hpp"

namespace vtm::openvg::gl {

namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

/// surface_pixel.glsl's kinds.
constexpr int kindColor = 0, kindGrey = 1, kindAlpha = 2;

bool isAlphaOnly(const PixelFormat& format) { return format.red.bits == 0 && format.grey.bits == 0; }

float levelsOfChannel(Channel channel) { return channel.bits == 0 ? 255 : float((1 << channel.bits) - 1); }

/// A map that takes pixels' numbers, counted from the origin, to where their centres lead.
dmat3 fromOrigin(const dmat3& fromSurface, glm::ivec2 origin) {
    dmat3 m = fromSurface;
    m[2] = fromSurface * dvec3(dvec2(origin) + 0.5, 1);
    return m;
}

bool isAffineMap(const dmat3& m) { return m[0].z == 0 && m[1].z == 0; }

template <class Columns>
void setColumns(Columns& columns, const dmat3& m) {
    for (int i = 0; i < 3; ++i)
        columns[i] = glm::vec4(glm::vec3(m[i]), 0);
}

int spreadOf(const ColorRamp& ramp) { return int(ramp.spread()); }

}  // namespace

PixelFormat texelFormat(const PixelFormat& format) {
    PixelFormat texels;
    texels.bits = 32;
    texels.red = {8, 0};
    texels.green = {8, 8};
    texels.blue = {8, 16};
    texels.alpha = {8, 24};
    texels.space = format.space;
    texels.space.premultiplied = format.space.premultiplied && format.alpha.bits != 0;
    return texels;
}

glm::vec4 levelsOf(const PixelFormat& format) {
    const auto of = [&](Channel channel) {
        return levelsOfChannel(format.grey.bits != 0 ? format.grey : channel);
    };
    return {of(format.red), of(format.green), of(format.blue), levelsOfChannel(format.alpha)};
}

void setSurface(LayerBlock& block, const PixelFormat& format, int width, int height) {
    block.frame = {width, height, 0, 0};
    block.levels = levelsOf(format);
    block.surface = {format.grey.bits != 0 ? kindGrey
                     : isAlphaOnly(format) ? kindAlpha
                                           : kindColor,
                     format.space.linear, format.space.premultiplied, format.alpha.bits != 0};
    block.conversion.w = !format.space.linear && !isAlphaOnly(format);
}

void setCopied(LayerBlock& block, const PixelFormat& format, glm::ivec2 shift) {
    block.texels[0].base = {shift, 0, 0};
    block.texels[0].levels = levelsOf(format);
    block.texels[0].how.z = !format.space.premultiplied;
    block.conversion.x = format.space.linear;
    block.conversion.y = format.space.luminance;
}

void setOrigin(LayerBlock& block, glm::ivec2 origin) {
    block.frame.z = origin.x;
    block.frame.w = origin.y;
}

TexelBlock texelBlock(const TexelField& field, glm::ivec2 origin) {
    TexelBlock block;
    const Image& image = *field.image;
    const bool isProjective = !isAffineMap(field.fromSurface);
    block.area = {image.area.x0, image.area.y0, image.width(), image.height()};
    block.how = {int(field.tiling), field.isSmooth, !texelFormat(image.format()).space.premultiplied,
                 isProjective};
    block.base = {0, 0, 1, 1};
    block.fill = field.fill;
    block.levels = levelsOf(image.format());
    dmat3 m = fromOrigin(field.fromSurface, origin);
    if (!isProjective) {
        for (int i = 0; i < 3; ++i)
            m[i] = dvec3(dvec2(m[i]) / field.fromSurface[2].z, 0);
        block.base.z = samplesAlong(dvec2(m[0]));
        block.base.w = samplesAlong(dvec2(m[1]));
        // The whole part apart: floats hold the rest.
        constexpr double limit = 1e8;
        const dvec2 whole = glm::clamp(glm::floor(dvec2(m[2])), -limit, limit);
        block.base.x = int(whole.x);
        block.base.y = int(whole.y);
        m[2] = dvec3(dvec2(m[2]) - whole, 0);
    }
    setColumns(block.map, m);
    return block;
}

std::optional<RampRow> rampRow(const ColorRamp& ramp) {
    if (3 * ramp.pieces().size() > std::size_t(rampColumns))
        return std::nullopt;
    RampRow row;
    for (const ColorRamp::Piece& piece : ramp.pieces()) {
        // Where a colour goes on for ever, its piece's origin does not matter.
        row.emplace_back(std::isfinite(piece.low) ? piece.low : 0, piece.scale, 0, 0);
        row.push_back(piece.start);
        row.push_back(piece.change);
    }
    return row;
}

void setGradient(LayerBlock& block, const LinearField& field, glm::ivec2 origin) {
    const dmat3 m = fromOrigin(field.fromSurface, origin);
    dmat3 values(0);
    for (int i = 0; i < 3; ++i)
        values[i] = {glm::dot(dvec2(m[i]) - field.start * m[i].z, field.slope), 0, m[i].z};
    if (isAffineMap(m)) {
        for (int i = 0; i < 3; ++i)
            values[i] = {values[i].x / m[2].z, 0, 0};
        values[2].z = 1;
        // Spreads repeat themselves after two, if at all.
        if (field.ramp->spread() != VG_COLOR_RAMP_SPREAD_PAD)
            values[2].x -= 2 * std::floor(values[2].x / 2);
    }
    setColumns(block.field, values);
    block.ramp = {0, int(field.ramp->pieces().size()), spreadOf(*field.ramp), !field.ramp->isPremultiplied()};
}

void setGradient(LayerBlock& block, const RadialField& field, glm::ivec2 origin) {
    dmat3 m = fromOrigin(field.fromSurface, origin);
    for (int i = 0; i < 3; ++i)
        m[i] = dvec3(dvec2(m[i]) - field.focus * m[i].z, m[i].z);
    if (isAffineMap(m)) {
        const double w = m[2].z;
        for (int i = 0; i < 3; ++i)
            m[i] /= w;
    }
    setColumns(block.field, m);
    const dvec2 f = field.fromCenter;
    block.radial = {f.x, f.y, field.radius2, 1 / (field.radius2 - glm::dot(f, f))};
    block.ramp = {0, int(field.ramp->pieces().size()), spreadOf(*field.ramp), !field.ramp->isPremultiplied()};
}

void setTransform(LayerBlock& block, const ColorTransform& transform, ColorSpace from) {
    for (int i = 0; i < 4; ++i)
        block.matrix[i] = transform.matrix()[i];
    block.added = transform.added();
    block.transform = {transform.space().linear, from.linear, from.luminance, 0};
}

}  // namespace vtm::openvg::gl
