/// \file
/// What paint programs contain, so that shaders are compiled with no more.
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
        LongRamps = 64  ///< gradients with many stops (backend_gl/upload/ramp_sums.hpp)
    };
    static constexpr unsigned combinations = 128;

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

}  // namespace vtm::gl
