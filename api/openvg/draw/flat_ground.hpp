/// \file
/// Edges of one opaque colour on a ground of one colour, on sRGB surfaces: by a table.
#pragma once

#include "api/openvg/draw/edge_mixer.hpp"

namespace vtm::openvg {

/// What an OpaqueMixer makes of one pixel, a word, for 4096 shares: in the middle of each step, so the share
/// is off by 2^-13, 0.4 of a byte at most, where white is drawn on black.
class FlatGround {
public:
    /// Edges that draw() takes.
    static constexpr std::size_t atOnce = 64;

    /// The table is that of this colour on a ground of that word.
    bool isFor(const Color& color, std::uint32_t ground) const {
        return color == color_ && ground == ground_;
    }
    /// Mixes pixels of the ground. Gives the edges on others, and returns how many.
    std::size_t draw(std::uint8_t* corner, std::ptrdiff_t stride, std::span<const EdgePixel> edges,
                     EdgePixel* others) const;
    /// Counts what is mixed on a ground, and makes the table when it pays.
    void count(const Color& color, std::uint32_t ground, std::size_t pixels);

private:
    static constexpr int stepBits = 4;

    void make();

    std::array<std::uint32_t, (wholeShare >> stepBits)> words_;
    Color color_{-1}, nextColor_{-1};  ///< no colour at first
    std::uint32_t ground_ = 0, nextGround_ = 0;
    std::size_t mixed_ = 0;
};

}  // namespace vtm::openvg
