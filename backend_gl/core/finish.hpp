/// \file
/// Which conversions stand between a region's colour and a framebuffer (shaders/output.glsl).
#pragma once

#include <string>

namespace vtm::gl {

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
