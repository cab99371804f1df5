/// \file
/// From the set of layers over a region to its paint: the stack of items is composited at compile
/// time as far as it is constant; what is left becomes a short paint program.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "compiler/lower/lowered_scene.hpp"
#include "compiler/paint/palette.hpp"

namespace vtm::compiler {

/// The paint where exactly the layers with inside[layer] are; `items` are the picture's items that
/// may be inside, ascending.
PaintId composite(const LoweredScene& picture, std::span<const std::uint32_t> items,
                  const std::vector<std::uint8_t>& inside, Palette& palette);

/// The paint of exactly the given items (ascending), clips aside.
PaintProgram compositeItems(const LoweredScene& picture, std::span<const std::uint32_t> items);
/// The same of items that are colours.
glm::vec4 compositeColors(const LoweredScene& picture, std::span<const std::uint32_t> items);

/// By group: whether it or one round it has a clip.
std::vector<std::uint8_t> clippedGroups(const LoweredScene& picture);

/// Whether a clip lets a point through, given what `inside(layer)` says of it.
template <class Inside>
bool insideClip(const LoweredScene& picture, std::uint32_t clip, const Inside& inside) {
    if (clip == noIndex)
        return true;
    const ClipExpression& e = picture.clips[clip];
    const bool any = std::any_of(e.terms.begin(), e.terms.end(), [&](const ClipExpression::Term& term) {
        return bool(inside(term.layer)) != term.inverted && insideClip(picture, term.clip, inside);
    });
    return any && insideClip(picture, e.outer, inside);
}

/// Whether all clips of a group and round it let a point through.
template <class Inside>
bool insideClips(const LoweredScene& picture, std::uint32_t group, const Inside& inside) {
    for (; group != noIndex; group = picture.groups[group].parent)
        if (!insideClip(picture, picture.groups[group].clip, inside))
            return false;
    return true;
}

}  // namespace vtm::compiler
