/// \file
/// A glyph of one opaque colour on a ground of one colour, on sRGB surfaces of four bytes a pixel: what comes
/// out is kept.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "api/openvg/draw/edge_mixer.hpp"

namespace vtm::openvg {

class FlatGround {
public:
    struct Key {
        Color color{-1};           ///< none at first
        std::uint32_t word = 0;    ///< the colour's where it covers all of a pixel
        std::uint32_t ground = 0;  ///< an opaque pixel
        std::ptrdiff_t stride = 0;

        friend bool operator==(const Key&, const Key&) = default;
    };
    static constexpr std::size_t groupPixels = 8;
    /// Neighbours in a row, the first of which is covered.
    struct Group {
        std::array<std::uint32_t, groupPixels> words;   ///< what comes out on the ground
        std::array<std::uint8_t, groupPixels> covered;  ///< 255: the pixel is covered, 0: it is not
        std::int32_t place;                             ///< of the first, in bytes from the corner
    };
    /// Of the same on other grounds.
    struct Shares {
        std::uint8_t x, y;                          ///< of the first, from the corner on
        std::array<std::uint16_t, groupPixels> of;  ///< in 65536ths; 0: the pixel stays
    };
    static constexpr std::size_t groupBytes = sizeof(Group) + sizeof(Shares);
    /// The most groups that a glyph has.
    static constexpr std::size_t maxGroups = 512;
    /// The share that means all of a pixel.
    static constexpr std::uint16_t whole = wholeShare - 1;

    /// Whether it is to draw that: from the second time in a row on, but for a while where grounds were not
    /// flat.
    bool serves(const Key& key) {
        if (rest_ > 0) {
            --rest_;
            return false;
        }
        if (key == key_)
            return true;
        key_ = key;
        isMade_ = false;
        return false;
    }
    /// Whether it serves where so many of all are on other grounds.
    static bool isWorth(std::size_t others, std::size_t all) { return others <= all / 4; }
    bool isMade() const { return isMade_; }
    /// `rows(row)` calls row(y, shares) for the rows: shares of the pixels from the corner on, and of another
    /// group's, which are 0. `mix(corner, stride, edges)` mixes the colour.
    template <class Rows, class Mix>
    void make(Rows&& rows, Mix&& mix) {
        groups_.clear();
        shares_.clear();
        rows([&](int y, std::span<const std::uint16_t> shares) { addRow(y, shares, mix); });
        isMade_ = true;
    }
    /// Calls visit(x) for the first of each group of such a row.
    template <class Visit>
    static void forEachGroup(std::span<const std::uint16_t> shares, Visit&& visit) {
        for (std::size_t x = 0; x + groupPixels < shares.size();) {
            if (shares[x] != 0)
                visit(x);
            x += shares[x] != 0 ? groupPixels : 1;
        }
    }
    /// Draws groups whose covered pixels are the ground, and mixes the others' pixels. Other pixels of a
    /// group are written as they are: false, and nothing is drawn, if these go beyond `end`, the end of the
    /// memory.
    template <class Mix>
    bool draw(std::uint8_t* corner, const std::uint8_t* end, Mix&& mix);

private:
    static constexpr int longRest = 256;

    template <class Mix>
    void addRow(int y, std::span<const std::uint16_t> shares, Mix&& mix);
    /// Draws groups whose covered pixels are the ground. Returns how many are not drawn, and their numbers.
    std::size_t drawGroups(std::uint8_t* corner, std::uint16_t* others) const;

    Key key_;
    std::vector<Group> groups_;
    std::vector<Shares> shares_;  ///< of groups_
    bool isMade_ = false;
    int rest_ = 0;  ///< calls that it does not serve
};

template <class Mix>
void FlatGround::addRow(int y, std::span<const std::uint16_t> shares, Mix&& mix) {
    forEachGroup(shares, [&](std::size_t x) {
        Shares& kept = shares_.emplace_back(Shares{std::uint8_t(x), std::uint8_t(y), {}});
        Group& group = groups_.emplace_back();
        group.words.fill(key_.ground);
        group.place = std::int32_t(y * key_.stride + 4 * std::ptrdiff_t(x));
        for (std::size_t k = 0; k < groupPixels; ++k) {
            kept.of[k] = shares[x + k];
            const EdgePixel edge{std::uint8_t(k), 0, shares[x + k]};
            group.covered[k] = edge.share != 0 ? 255 : 0;
            if (edge.share == whole)
                group.words[k] = key_.word;
            else if (edge.share != 0)
                mix(reinterpret_cast<std::uint8_t*>(group.words.data()), 0, std::span(&edge, 1));
        }
    });
}

template <class Mix>
bool FlatGround::draw(std::uint8_t* corner, const std::uint8_t* end, Mix&& mix) {
    if (groups_.empty() || end - corner < groups_.back().place + std::ptrdiff_t(4 * groupPixels))
        return false;
    std::array<std::uint16_t, maxGroups> others;
    const std::size_t otherGroups = drawGroups(corner, others.data());
    std::array<EdgePixel, 64> edges;
    std::size_t count = 0;
    for (std::size_t i = 0; i < otherGroups; ++i) {
        const Shares& shares = shares_[others[i]];
        std::uint8_t* const p = corner + groups_[others[i]].place;
        for (std::size_t k = 0; k < groupPixels; ++k)
            if (shares.of[k] == whole)
                std::memcpy(p + 4 * k, &key_.word, 4);
            else if (shares.of[k] != 0)
                edges[count++] = {std::uint8_t(shares.x + k), shares.y, shares.of[k]};
        if (count + groupPixels > edges.size()) {
            mix(corner, key_.stride, std::span(edges).first(count));
            count = 0;
        }
    }
    mix(corner, key_.stride, std::span(edges).first(count));
    if (!isWorth(otherGroups, groups_.size()))
        rest_ = longRest;
    return true;
}

}  // namespace vtm::openvg
