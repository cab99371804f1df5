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
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// The paint where exactly the layers with inside[layer] are; `items` are the picture's items that
/// may be inside, ascending.
PaintId composite(const LoweredScene& picture, std::span<const std::uint32_t> items,
                  const std::vector<std::uint8_t>& inside, Palette& palette);

/// The paint of exactly the given items (ascending), clips aside.
PaintProgram compositeItems(const LoweredScene& picture, std::span<const std::uint32_t> items);
/// The same of items that are colours.
glm::vec4 compositeColors(const LoweredScene& picture, std::span<const std::uint32_t> items);

/// What a mask leaves of what lies below it.
float maskFactor(GroupRole role, const glm::vec4& mask);

/// The asset's modes are numbered like the scene's.
asset::Blend blendOf(scene::BlendMode mode);

/// By group: whether it or one round it has a clip.
std::vector<std::uint8_t> clippedGroups(const LoweredScene& picture);

/// How far a clip lets a place through, given how far coverOf(layer) covers it.
template <class CoverOf>
Cover clipCover(const LoweredScene& picture, std::uint32_t clip, const CoverOf& coverOf) {
    // Cover is ordered Out < Edge < In: a union covers like its best term, an intersection like its worst.
    if (clip == noIndex)
        return Cover::In;
    const ClipExpression& e = picture.clips[clip];
    Cover any = Cover::Out;
    for (const ClipExpression::Term& term : e.terms) {
        const Cover cover = coverOf(term.layer);
        const Cover own = !term.inverted || cover == Cover::Edge ? cover
                          : cover == Cover::In                   ? Cover::Out
                                                                 : Cover::In;
        any = std::max(any, std::min(own, clipCover(picture, term.clip, coverOf)));
    }
    return std::min(any, clipCover(picture, e.outer, coverOf));
}

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
