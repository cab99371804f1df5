#include "font/parts.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <vtm/asset/asset.hpp>
#include "font/contact.hpp"

namespace vtm::font {
namespace {

using scene::Path;
using scene::Point;

/// Calls visit(point) for each point of a command.
template <class Command, class Visit>
void forEachPoint(Command& command, Visit&& visit) {
    if (auto* move = std::get_if<scene::MoveTo>(&command)) {
        visit(move->to);
    } else if (auto* line = std::get_if<scene::LineTo>(&command)) {
        visit(line->to);
    } else if (auto* quad = std::get_if<scene::QuadTo>(&command)) {
        visit(quad->control);
        visit(quad->to);
    } else if (auto* cubic = std::get_if<scene::CubicTo>(&command)) {
        visit(cubic->control1);
        visit(cubic->control2);
        visit(cubic->to);
    }
}

std::vector<Path> contoursOf(const Path& outline) {
    std::vector<Path> contours;
    for (const scene::Command& command : outline) {
        if (std::holds_alternative<scene::MoveTo>(command))
            contours.emplace_back();
        contours.back().push_back(command);
    }
    std::erase_if(contours, [](const Path& contour) { return contour.size() < 2; });
    return contours;
}

/// For each contour the first one of its group.
std::vector<std::size_t> groupsOf(const std::vector<Path>& contours, double em) {
    std::vector<Polygons> polygons;
    for (const Path& contour : contours)
        polygons.emplace_back(mapped(contour, 1 / em, Point(0)));
    std::vector<std::size_t> group(contours.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    for (std::size_t i = 0; i < contours.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (group[i] == group[j] || !touch(polygons[i], Point(0), polygons[j]))
                continue;
            const auto [first, other] = std::minmax(group[i], group[j]);
            std::ranges::replace(group, std::size_t(other), std::size_t(first));
        }
    return group;
}

}  // namespace

PartKey Part::key() const {
    PartKey key;
    for (const scene::Command& command : path) {
        key.push_back(double(command.index()));
        forEachPoint(command, [&](const Point& p) {
            key.push_back(p.x);
            key.push_back(p.y);
        });
    }
    return key;
}

Path mapped(const Path& path, double scale, Point by) {
    Path result = path;
    for (scene::Command& command : result)
        forEachPoint(command, [&](Point& p) { p = p * scale + by; });
    return result;
}

namespace {

Part partOf(const Path& path) {
    const Point first = std::get<scene::MoveTo>(path.front()).to;
    return {mapped(path, 1, -first), first};
}

}  // namespace

std::vector<Part> partsOf(const Path& outline, double em) {
    constexpr std::size_t maxContours = 1000;  // each is compared with each; nothing is shared by such glyphs
    const std::vector<Path> contours = contoursOf(outline);
    if (contours.size() > maxContours)
        return {partOf(outline)};
    const std::vector<std::size_t> groups = groupsOf(contours, em);
    std::map<std::size_t, Path> paths;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        Path& path = paths[groups[i]];
        path.insert(path.end(), contours[i].begin(), contours[i].end());
    }
    if (paths.size() > asset::maxGlyphParts)
        return {partOf(outline)};
    std::vector<Part> parts;
    for (const auto& [group, path] : paths)
        parts.push_back(partOf(path));
    return parts;
}

}  // namespace vtm::font
