#include "compiler/patterns/tile_range.hpp"

#include <algorithm>

#include "compiler/filters/bounds.hpp"
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

namespace {

double segmentsOf(const scene::Item& item) {
    double segments = 0;
    for (const scene::Command& command : *item.path) {
        const bool isLine =
            std::holds_alternative<scene::LineTo>(command) || std::holds_alternative<scene::Close>(command);
        segments += std::holds_alternative<scene::MoveTo>(command) ? 0 : isLine ? 1 : 4;
    }
    return std::holds_alternative<scene::StrokeStyle>(item.geometry) ? 2 * segments : segments;
}

TileContent& operator+=(TileContent& a, const TileContent& b) {
    a.tiles += b.tiles;
    a.segments += b.segments;
    return a;
}

}  // namespace

TileContent TileCounter::inOneTile(const scene::Pattern& pattern) {
    const auto [known, isNew] = known_.try_emplace(pattern.content.get());
    if (!isNew)
        return known->second;
    const TileContent content = in(pattern.content->children, {pattern.min, pattern.max});
    return known_[pattern.content.get()] = content;
}

TileContent TileCounter::in(const scene::NodeList& nodes, const geometry::Box& tile) {
    TileContent content;
    for (const scene::Node& node : nodes)
        content += in(node, tile);
    return content;
}

TileContent TileCounter::in(const scene::Node& node, const geometry::Box& tile) {
    TileContent content;
    if (const auto* group = std::get_if<scene::Group>(&node.value)) {
        content = in(group->children, tile);
        if (group->mask)
            content += in(group->mask->content->children, tile);
    } else if (const auto* select = std::get_if<scene::Select>(&node.value)) {
        for (const scene::Link<scene::Group>& side : {select->inside, select->outside})
            if (side)
                content += in(side->children, tile);
    } else {
        content = in(std::get<scene::Item>(node.value), tile);
    }
    return content;
}

TileContent TileCounter::in(const scene::Item& item, const geometry::Box& tile) {
    TileContent content{0, segmentsOf(item)};
    const auto* pattern = std::get_if<scene::Pattern>(&item.paint);
    if (!pattern)
        return content;
    const auto toPattern = scene::inverse(scene::compose(item.transform, pattern->transform));
    const geometry::Box box = boundsOf({scene::Node{item}}, scene::identity).intersection(tile);
    if (!toPattern || box.empty())
        return content;
    const double count = tilesIn(geometry::mapped(box, *toPattern), *pattern).count();
    const TileContent one = inOneTile(*pattern);
    if (const double tiles = count * (1 + one.tiles); tiles <= double(maxTilesInTile))
        content += {tiles, count * one.segments};
    else
        content.tiles += 1;
    return content;
}

}  // namespace vtm::compiler
