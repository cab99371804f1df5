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
    /// Of two neighbours, of which one at least is covered, on the ground.
    struct Pair {
        std::array<std::uint32_t, 2> words;  ///< what comes out
        std::int32_t place;                  ///< in bytes from a corner
    };
    /// Of the same on other grounds.
    struct Shares {
        std::uint8_t x, y;                  ///< of the first, from the corner on
        std::array<std::uint16_t, 2> both;  ///< in 65536ths; 0: the pixel stays
    };
    static constexpr std::size_t pairBytes = sizeof(Pair) + sizeof(Shares);
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
    bool isMade() const { return isMade_; }
    /// `rows(row)` calls row(y, shares) for the rows: shares of the pixels from the corner on, and of one
    /// more, which is 0. `mix(corner, stride, edges)` mixes the colour.
    template <class Rows, class Mix>
    void make(Rows&& rows, Mix&& mix) {
        pairs_.clear();
        shares_.clear();
        rows([&](int y, std::span<const std::uint16_t> shares) { addRow(y, shares, mix); });
        isMade_ = true;
    }
    /// Calls visit(x) for the first of each pair of such a row.
    template <class Visit>
    static void forEachPair(std::span<const std::uint16_t> shares, Visit&& visit) {
        for (std::size_t x = 0; x + 1 < shares.size();) {
            if (shares[x] != 0)
                visit(x);
            x += shares[x] != 0 ? 2 : 1;
        }
    }
    /// Draws where the ground is, and mixes other pixels.
    template <class Mix>
    void draw(std::uint8_t* corner, Mix&& mix);

private:
    static constexpr int longRest = 256;

    template <class Mix>
    void addRow(int y, std::span<const std::uint16_t> shares, Mix&& mix);

    Key key_;
    std::vector<Pair> pairs_;
    std::vector<Shares> shares_;  ///< of pairs_
    bool isMade_ = false;
    int rest_ = 0;  ///< calls that it does not serve
};

template <class Mix>
void FlatGround::addRow(int y, std::span<const std::uint16_t> shares, Mix&& mix) {
    forEachPair(shares, [&](std::size_t x) {
        shares_.push_back({std::uint8_t(x), std::uint8_t(y), {shares[x], shares[x + 1]}});
        Pair& pair = pairs_.emplace_back(
            Pair{{key_.ground, key_.ground}, std::int32_t(y * key_.stride + 4 * std::ptrdiff_t(x))});
        for (std::size_t k = 0; k < 2; ++k) {
            const EdgePixel edge{std::uint8_t(k), 0, shares[x + k]};
            if (edge.share == whole)
                pair.words[k] = key_.word;
            else if (edge.share != 0)
                mix(reinterpret_cast<std::uint8_t*>(pair.words.data()), 0, std::span(&edge, 1));
        }
    });
}

template <class Mix>
void FlatGround::draw(std::uint8_t* corner, Mix&& mix) {
    const std::uint64_t ground = key_.ground | std::uint64_t(key_.ground) << 32;
    std::array<EdgePixel, 64> others;
    std::size_t count = 0, otherPairs = 0;
    const std::span<const Pair> pairs = pairs_;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::uint8_t* const p = corner + pairs[i].place;
        if (std::memcmp(p, &ground, sizeof ground) == 0) {
            std::memcpy(p, &pairs[i].words, sizeof ground);
            continue;
        }
        ++otherPairs;
        const Shares& shares = shares_[i];
        for (std::size_t k = 0; k < 2; ++k)
            if (shares.both[k] == whole)
                std::memcpy(p + 4 * k, &key_.word, 4);
            else if (shares.both[k] != 0)
                others[count++] = {std::uint8_t(shares.x + k), shares.y, shares.both[k]};
        if (count + 2 > others.size()) {
            mix(corner, key_.stride, std::span(others).first(count));
            count = 0;
        }
    }
    mix(corner, key_.stride, std::span(others).first(count));
    if (otherPairs > pairs.size() / 4)
        rest_ = longRest;
}

}  // namespace vtm::openvg
