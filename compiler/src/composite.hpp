/// \file
/// From the set of layers over a region to its paint: the stack of items is composited at compile
/// time as far as it is constant; what is left becomes a short paint program.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "compiler/src/picture.hpp"

namespace vtm::compiler {

/// The asset's paints, each distinct one once; paint 0 is transparent.
class Palette {
public:
    explicit Palette(asset::Asset& asset);

    using Program = std::vector<std::pair<asset::Instruction, std::array<float, 4>>>;
    std::uint16_t solid(const std::array<float, 4>& premultiplied);
    std::uint16_t program(const Program& steps);

private:
    std::uint16_t intern(const std::string& key, const asset::Paint& paint);

    asset::Asset& asset_;
    std::unordered_map<std::string, std::uint16_t> index_;
};

/// The paint where exactly the layers with inside[layer] are; `items` are the picture's items that
/// may be inside, ascending.
std::uint16_t composite(const Picture& picture, std::span<const std::uint32_t> items,
                        const std::vector<std::uint8_t>& inside, Palette& palette);

/// Whether a clip lets a point through, given what `inside(layer)` says of it.
template <class Inside>
bool insideClip(const Picture& picture, std::uint32_t clip, const Inside& inside) {
    if (clip == none)
        return true;
    const ClipExpression& e = picture.clips[clip];
    const bool any = std::any_of(e.terms.begin(), e.terms.end(), [&](const ClipExpression::Term& term) {
        return bool(inside(term.layer)) != term.inverted && insideClip(picture, term.clip, inside);
    });
    return any && insideClip(picture, e.outer, inside);
}

}  // namespace vtm::compiler
