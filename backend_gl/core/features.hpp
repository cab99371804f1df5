/// \file
/// Sets of flags that shaders are compiled with: what paint programs contain, and which conversions stand
/// between a region's colour and a framebuffer (shaders/output.glsl).
#pragma once

#include <string>

#include <vtm/asset/asset.hpp>

namespace vtm::gl {

/// A set of flags; the names are the macros of paint.glsl.
class Features {
public:
    enum Flag : unsigned {
        Linear = 1,
        Radial = 2,
        Image = 4,
        Groups = 8,
        Mixing = 16,
        Material = 32,
        LongRamps = 64,   ///< gradients with many stops (backend_gl/upload/asset_texels.hpp)
        RampPoints = 128  ///< of plain paints' programs: means of several points (backend_gl/tiles/tile.hpp)
    };
    static constexpr unsigned combinations = 128;  ///< of paint programs

    Features() = default;
    explicit Features(unsigned flags) : flags_(flags) {}
    unsigned flags() const { return flags_; }
    bool has(Flag flag) const { return (flags_ & flag) != 0; }

    /// #define lines, one a flag.
    std::string defines() const;

private:
    unsigned flags_ = 0;
};

/// Of all paint programs of an asset together. Mixing is blend modes other than Normal, and masks.
Features featuresOf(const asset::AssetView& asset);

/// A set of flags; the names are the macros of output.glsl.
class Finish {
public:
    enum Flag : unsigned {
        LinearLight = 1,   ///< regions are added up in linear light
        LinearOut = 2,     ///< the framebuffer wants linear light
        StraightOut = 4,   ///< and straight colours
        EncodedStore = 8,  ///< it encodes what it stores
        Dither = 16
    };
    static constexpr unsigned combinations = 32;

    Finish() = default;
    explicit Finish(unsigned flags) : flags_(flags) {}
    unsigned flags() const { return flags_; }
    bool has(Flag flag) const { return (flags_ & flag) != 0; }

    /// #define lines, one a flag.
    std::string defines() const;

private:
    unsigned flags_ = 0;
};

}  // namespace vtm::gl
