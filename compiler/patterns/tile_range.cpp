#include "compiler/patterns/tile_range.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

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

/// As the ends of its segments tell.
bool reachesAcross(const scene::Item& item, const geometry::Box& tile) {
    geometry::Box ends;
    for (const scene::Command& command : *item.path)
        std::visit(
            [&]<class C>(const C& c) {
                if constexpr (!std::is_same_v<C, scene::Close>)
                    ends.add(scene::apply(item.transform, c.to));
            },
            command);
    const auto reaches = [&](int axis) {
        return ends.min[axis] <= tile.min[axis] && ends.max[axis] >= tile.max[axis];
    };
    return reaches(0) || reaches(1);
}

TileContent& operator+=(TileContent& a, const TileContent& b) {
    a.tiles += b.tiles;
    a.segments += b.segments;
    a.isOfColors = a.isOfColors && b.isOfColors;
    a.reachesAcross = a.reachesAcross || b.reachesAcross;
    return a;
}

}  // namespace

double longerSideOf(const scene::Pattern& pattern, const scene::Affine& toOutside) {
    const glm::dvec2 period = pattern.max - pattern.min;
    return std::max(glm::length(toOutside[0]) * period.x, glm::length(toOutside[1]) * period.y);
}

bool isFarLargerThan(const geometry::Box& outside, const scene::Pattern& pattern,
                     const scene::Affine& toOutside) {
    constexpr double most = 2;
    return !(longerSideOf(pattern, toOutside) <= most * std::max(outside.width(), outside.height()));
}

TileSpans::TileSpans(const TileRange& range, const scene::Pattern& pattern)
    : corner_(pattern.min + range.first * (pattern.max - pattern.min)),
      period_(pattern.max - pattern.min),
      count_(range.last - range.first + 1.0),
      rows_(std::size_t(count_.y)) {}

void TileSpans::add(glm::dvec2 a, glm::dvec2 b, glm::dvec2 slack) {
    a = (a - corner_) / period_;
    b = (b - corner_) / period_;
    slack /= period_;
    if (a.y > b.y)
        std::swap(a, b);
    const auto within = [](double tile, double count) {
        return std::clamp(std::floor(tile), 0.0, count - 1);
    };
    const double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
    const double last = within(b.y + slack.y, count_.y);
    for (double y = within(a.y - slack.y, count_.y); y <= last; ++y) {
        // What lies in the row; the slack along a slope stays within the ends.
        const auto at = [&](double height) {
            return slope == 0 ? a.x : a.x + std::clamp(height - a.y, 0.0, b.y - a.y) * slope;
        };
        double left = std::min(at(y - slack.y), at(y + 1 + slack.y)),
               right = std::max(at(y - slack.y), at(y + 1 + slack.y));
        if (b.y == a.y)
            left = std::min(a.x, b.x), right = std::max(a.x, b.x);
        const int first = int(within(left - slack.x, count_.x)),
                  end = int(within(right + slack.x, count_.x)) + 1;
        TileSpan& row = rows_[std::size_t(y)];
        row = row.first < row.end ? TileSpan{std::min(row.first, first), std::max(row.end, end)}
                                  : TileSpan{first, end};
    }
}

std::vector<TileSpan> allOf(const TileRange& range) {
    const glm::dvec2 count = range.last - range.first + 1.0;
    return std::vector<TileSpan>(std::size_t(count.y), TileSpan{0, int(count.x)});
}

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
        content.isOfColors = content.isOfColors && !group->filter;
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
    content.reachesAcross = reachesAcross(item, tile);
    const auto* pattern = std::get_if<scene::Pattern>(&item.paint);
    if (!pattern) {
        content.isOfColors = std::holds_alternative<scene::Color>(item.paint);
        return content;
    }
    const scene::Affine toTile = scene::compose(item.transform, pattern->transform);
    const auto toPattern = scene::inverse(toTile);
    const geometry::Box box = boundsOf({scene::Node{item}}, scene::identity).intersection(tile);
    if (!toPattern || box.empty())
        return content;
    const double count = tilesIn(geometry::mapped(box, *toPattern), *pattern).count();
    const TileContent one = inOneTile(*pattern);
    if (const double tiles = count * (1 + one.tiles); tiles <= double(maxTilesInTile))
        content +=
            {tiles, count * one.segments, one.isOfColors && !isFarLargerThan(tile, *pattern, toTile), false};
    else
        content += {1, 0, false, false};
    return content;
}

}  // namespace vtm::compiler
