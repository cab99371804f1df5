#include "compiler/direct/square_lights.hpp"

#include <algorithm>
#include <utility>

#include "compiler/direct/layer_cover.hpp"

namespace vtm::compiler {

void SquareLights::begin(std::int32_t squares) {
    count_ = open_ = squares;
    Level& picture = levels_[0];
    picture.squares.assign(std::size_t(squares), {});
    for (std::int32_t i = 0; i < squares; ++i)
        picture.squares[std::size_t(i)].next = i;
    picture.lights.resize(std::size_t(squares));
    colors_.assign(std::size_t(squares), glm::vec4(0));
}

std::int32_t SquareLights::nextOpen(std::int32_t square) {
    std::vector<Square>& squares = levels_[0].squares;
    std::int32_t open = square;
    while (open < count_ && squares[std::size_t(open)].next != open)
        open = squares[std::size_t(open)].next;
    while (square < open && square < count_)
        square = std::exchange(squares[std::size_t(square)].next, open);
    return open;
}

// ---- Layers ---------------------------------------------------------------------------------------

void SquareLights::cover(std::int32_t number, const SolidLayers::Layer& layer) {
    Square& square = touch(number);
    colors_[std::size_t(number)] += levels_[depth_ - 1].weight * square.left() * layer.color;
    square.light *= 1 - layer.color.w;
    closeIfDark(number);
}

bool SquareLights::cover(std::int32_t number, const SolidLayers::Layer& layer,
                         const PlaceWindings& windings) {
    touch(number);
    return take(number, layer,
                takeLight(placesOf(depth_ - 1, number), windings, layer.isEvenOdd, layer.color.w));
}

bool SquareLights::coverBeside(std::int32_t number, const SolidLayers::Layer& layer, const PlacedEdge& edge,
                               bool isLeft) {
    touch(number);
    return take(number, layer,
                takeLightBeside(placesOf(depth_ - 1, number), edge, number, isLeft, layer.color.w));
}

/// Returns whether nothing is left where it was taken.
bool SquareLights::take(std::int32_t number, const SolidLayers::Layer& layer, const TakenLight& light) {
    Square& square = touch(number);
    const float part = square.light * light.taken / layer.color.w;
    colors_[std::size_t(number)] += levels_[depth_ - 1].weight * part * layer.color;
    square.mean -= light.taken;
    closeIfDark(number);
    return square.light * float(light.most) <= unseen * float(fullLight);
}

void SquareLights::closeIfDark(std::int32_t number) {
    Square& square = levels_[0].squares[std::size_t(number)];
    if (depth_ > 1 || square.left() > unseen || square.next != number)
        return;
    square.next = number + 1;
    --open_;
}

// ---- What is dark ---------------------------------------------------------------------------------

const SquareLights::Square& SquareLights::known(std::int32_t number) const {
    std::size_t level = depth_ - 1;
    while (levels_[level].squares[std::size_t(number)].entry != levels_[level].entry)
        --level;
    return levels_[level].squares[std::size_t(number)];
}

void SquareLights::keepDarkLeft(std::int32_t number, const RowLine& line) {
    RowLine& dark = touch(number).darkLeft;
    if (line.at(0.5f) > dark.at(0.5f))
        dark = line;
}

void SquareLights::keepDarkRight(std::int32_t number, const RowLine& line) {
    RowLine& dark = touch(number).darkRight;
    if (line.at(0.5f) < dark.at(0.5f))
        dark = line;
}

// ---- Groups ---------------------------------------------------------------------------------------

SquareLights::Square& SquareLights::touch(std::size_t at, std::int32_t number) {
    Level& level = levels_[at];
    Square& square = level.squares[std::size_t(number)];
    if (square.entry == level.entry)
        return square;
    square = touch(at - 1, number);
    square.entry = level.entry;
    if (square.hasPlaces)
        level.lights[std::size_t(number)] = levels_[at - 1].lights[std::size_t(number)];
    level.touched.push_back(number);
    return square;
}

PlaceLights& SquareLights::placesOf(std::size_t level, std::int32_t number) {
    PlaceLights& lights = levels_[level].lights[std::size_t(number)];
    if (!std::exchange(levels_[level].squares[std::size_t(number)].hasPlaces, true))
        lights.fill(fullLight);
    return lights;
}

void SquareLights::enter(std::uint32_t group) {
    const auto isAround = [&](std::uint32_t outer) {
        std::uint32_t g = group;
        while (g != noIndex && g != outer)
            g = groups_[g].outer;
        return g == outer;
    };
    while (!isAround(levels_[depth_ - 1].group))
        leaveGroup();
    if (group == levels_[depth_ - 1].group)
        return;
    enter(groups_[group].outer);
    if (depth_ == levels_.size())
        levels_.emplace_back();
    Level& level = levels_[depth_];
    level.group = group;
    level.weight = levels_[depth_ - 1].weight * groups_[group].opacity;
    level.entry = ++entries_;
    level.squares.resize(std::max(level.squares.size(), std::size_t(count_)));
    level.lights.resize(level.squares.size());
    level.touched.clear();
    ++depth_;
}

/// What the group leaves of the light is mixed with what there was before it, by its opacity.
void SquareLights::leaveGroup() {
    const Level& level = levels_[--depth_];
    const float opacity = groups_[level.group].opacity;
    for (const std::int32_t i : level.touched) {
        const Square& inner = level.squares[std::size_t(i)];
        Square& square = levels_[depth_ - 1].squares[std::size_t(i)];
        if (!inner.hasPlaces)
            square.light += opacity * (inner.light - square.light);
        else if (square.light > 0)
            square.mean = mixLights(placesOf(depth_ - 1, i), opacity, level.lights[std::size_t(i)],
                                    opacity * inner.light / square.light);
        closeIfDark(i);
    }
}

std::span<const glm::vec4> SquareLights::finish() {
    while (depth_ > 1)
        leaveGroup();
    return colors_;
}

}  // namespace vtm::compiler
