/// \file
/// Drawing calls, gathered until the GPU gets them.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec4.hpp>

#include "api/openvg/gl/texture.hpp"
#include "api/openvg/gl/tiles.hpp"
#include "api/openvg/paint/color.hpp"

namespace vtm::openvg::gl {

/// What a layer's source is: the fragment shader's macros SOURCE_….
enum class SourceKind : std::uint8_t { solid, linear, radial, texels };

/// What a program is made for.
struct ProgramKey {
    enum class Task : std::uint8_t {
        layer,  ///< paints, blends and mixes
        store,  ///< writes the tiles' colour as it is
        copy,   ///< converts texels to the target's format, pixel for pixel
        filter  ///< converts, filters and converts them again
    };
    /// What filters do: the fragment shader's macros FILTER_….
    enum class Filter : std::uint8_t { matrix, tables, table, sums };
    Task task = Task::layer;
    Filter filter = Filter::matrix;
    bool readsSums = false, writesSums = false;  ///< floats of a filter, in place of an image's pixels
    SourceKind source = SourceKind::solid;
    bool transforms = false, multiplies = false, isStencil = false;
    bool isMasked = false;  ///< of a filter: some channels of the target stay
    int blendMode = 0;      ///< VGBlendMode

    bool mayReadTarget() const { return task == Task::layer || (task == Task::filter && isMasked); }

    friend auto operator<=>(const ProgramKey&, const ProgramKey&) = default;
};

/// Of shaders/layer_block.glsl, std140.
struct TexelBlock {
    glm::ivec4 area{0};  ///< x, y, width, height in the texture
    glm::ivec4 how{0};   ///< tiling, smooth, not premultiplied, projective
    glm::ivec4 base{0};  ///< whole part of the place of the origin; samples across and along
    glm::vec4 map[3]{};  ///< from pixels, counted from the origin, to texels
    glm::vec4 fill{0}, levels{0};
};
struct LayerBlock {
    glm::ivec4 frame{0};       ///< width and height of the target, x and y of the origin
    glm::vec4 levels{0};       ///< of the target's channels
    glm::ivec4 surface{0};     ///< kind, linear, premultiplied, has alpha
    glm::ivec4 conversion{0};  ///< source: linear, luminance; colour transform; mixed in linear light
    glm::vec4 scale{0}, bias{0};
    glm::vec4 field[3]{};
    glm::vec4 radial{0};
    glm::ivec4 ramp{0};  ///< row, pieces, spread, to be premultiplied
    TexelBlock texels[2];
    glm::vec4 matrix[4]{};
    glm::vec4 added{0};
    glm::ivec4 transform{0};  ///< linear; what it takes: linear, luminance; of filters: filter_fragment.glsl
};
static_assert(sizeof(TexelBlock) == 8 * 16 && sizeof(LayerBlock) == (11 + 16 + 6) * 16);

/// A tile as the vertex shader reads it.
struct Instance {
    Tile tile;
    Color color;
};
static_assert(sizeof(Instance) == 28);

/// A piece of a ramp: three texels.
using RampRow = std::vector<glm::vec4>;

/// One drawing call, or several that differ in their tiles only.
struct Draw {
    TexturePointer target;
    ProgramKey key;
    LayerBlock block;
    TexturePointer texels[2], mask;
    bool readsTarget = false;
    std::vector<Rectangle> read;  ///< parts of the target that are read: where the tiles are, if nothing else
    std::size_t first = 0, count = 0;  ///< instances
};

class Batch {
public:
    /// `canFetch`: fragments read what is below them, in order. Otherwise a draw whose tiles meet those of
    /// another one below is not joined with it.
    explicit Batch(bool canFetch) : canFetch_(canFetch) {}

    bool empty() const { return draws.empty(); }
    /// Whether this should be drawn before more comes.
    bool isFull() const;
    void add(Draw draw, Tiles tiles, Color color, const RampRow* ramp);

    std::vector<Draw> draws;
    std::vector<Instance> instances;
    std::vector<std::vector<float>> shares;  ///< one after the other, as tiles refer to them
    std::size_t shareCount = 0;
    std::vector<RampRow> ramps;

private:
    bool joins(const Draw& last, const Draw& draw) const;

    bool canFetch_;
};

/// Texels in a row of the textures that hold shares and ramps.
inline constexpr int shareColumns = 2048, rampColumns = 1024;

}  // namespace vtm::openvg::gl
