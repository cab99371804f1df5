#include "backend_gl/core/features.hpp"

#include <bit>
#include <utility>

#include <fmt/format.h>

#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::Op;

unsigned flagsOf(const asset::Instruction& in) {
    switch (in.op) {
        case Op::Solid:
            return 0;
        case Op::Linear:
            return Features::Linear;
        case Op::Radial:
            return Features::Radial;
        case Op::Image:
            return Features::Image;
        case Op::Material:
            return Features::Material;
        case Op::Push:
            return Features::Groups;
        case Op::Pop:
            return Features::Groups | (in.blend == asset::Blend::Normal ? 0u : Features::Mixing);
        default:
            return Features::Groups | Features::Mixing;
    }
}

}  // namespace

std::string Features::defines() const {
    std::string text;
    for (const auto& [flag, name] : {std::pair{Linear, "LINEAR"},
                                     {Radial, "RADIAL"},
                                     {Image, "IMAGE"},
                                     {Groups, "GROUPS"},
                                     {Mixing, "MIXING"},
                                     {Material, "MATERIAL"},
                                     {LongRamps, "LONG_RAMPS"},
                                     {RampPoints, "RAMP_POINTS"}})
        text += fmt::format("#define {} {}\n", name, (flags_ & flag) != 0 ? 1 : 0);
    return text;
}

Features featuresOf(const asset::AssetView& asset) {
    unsigned flags = hasLongRamps(asset) ? unsigned(Features::LongRamps) : 0;
    for (const asset::Paint& paint : asset.paints) {
        if (!asset::isProgram(paint))
            continue;
        for (std::uint32_t i = 0; i < paint[1]; ++i)
            flags |= flagsOf(std::bit_cast<asset::Instruction>(asset.data[paint[0] + i]));
    }
    return Features(flags);
}

std::string Finish::defines() const {
    std::string text;
    for (const auto& [flag, name] : {std::pair{LinearLight, "LINEAR_LIGHT"},
                                     {LinearOut, "LINEAR_OUT"},
                                     {StraightOut, "STRAIGHT_OUT"},
                                     {EncodedStore, "ENCODED_STORE"},
                                     {Dither, "DITHER"}})
        text += fmt::format("#define {} {}\n", name, has(flag) ? 1 : 0);
    return text;
}

}  // namespace vtm::gl
