#include "compiler/planar/vertices.hpp"

#include <algorithm>

#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

/// The vertex after the end's own on its edge.
LatticePoint next(const EdgeSet& set, EdgeEnd end) {
    const Edge& e = set.edges[end / 2];
    return set.vertices[isAtA(end) ? e.first + 1 : e.last - 1];
}

/// The side a point of the border lies on.
std::size_t sideOf(const Square& square, LatticePoint p) {
    return p.y == square.y0 ? 0 : p.x == square.x1() ? 1 : p.y == square.y1() ? 2 : 3;
}

}  // namespace

void Vertices::collect(const EdgeSet& set, const Square& square) {
    findVertices(set);
    groupEnds();
    for (auto& side : onSide_)
        side.clear();
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
        const Vertex& v = vertices_[i];
        if (!v.isInner())
            onSide_[sideOf(square, v.at)].push_back(i);
        else if (v.count > 2)
            sortRound(set, v);
    }
    listBorder(set);
}

void Vertices::findVertices(const EdgeSet& set) {
    const std::size_t count = 2 * set.edges.size();
    slots_.reset(count);
    vertices_.clear();
    vertexOf_.resize(count);
    for (std::uint32_t e = 0; e < set.edges.size(); ++e) {
        vertexOf_[endAtA(e)] = numberOf(set.edges[e].a);
        vertexOf_[endAtB(e)] = numberOf(set.edges[e].b);
    }
}

/// The vertex at a point, and one end more for it.
std::uint32_t Vertices::numberOf(LatticePoint at) {
    std::uint32_t& number = slots_.find(sortKey(at), [&](std::uint32_t i) { return vertices_[i].at == at; });
    if (number == Slots::noIndex) {
        number = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back({at, 0, 0});
    }
    ++vertices_[number].count;
    return number;
}

void Vertices::groupEnds() {
    std::uint32_t first = 0;
    for (Vertex& v : vertices_) {
        v.first = first;
        first += v.count;
        v.count = 0;
    }
    ends_.resize(vertexOf_.size());
    placeOf_.resize(vertexOf_.size());
    for (EdgeEnd end = 0; end < vertexOf_.size(); ++end) {
        Vertex& v = vertices_[vertexOf_[end]];
        placeOf_[end] = v.first + v.count++;
        ends_[placeOf_[end]] = end;
    }
}

void Vertices::sortRound(const EdgeSet& set, const Vertex& v) {
    const auto first = ends_.begin() + v.first, last = first + v.count;
    const auto isRight = [&](LatticePoint p) { return p.x > v.at.x || (p.x == v.at.x && p.y < v.at.y); };
    sortFew(first, last, [&](EdgeEnd p, EdgeEnd q) {
        const LatticePoint a = next(set, p), b = next(set, q);
        if (isRight(a) != isRight(b))
            return isRight(a);
        return orient(v.at, a, b) > 0;
    });
    for (std::uint32_t i = v.first; i < v.first + v.count; ++i)
        placeOf_[ends_[i]] = i;
}

/// Clockwise where the inside is on the left, and all directions lie in half a plane.
void Vertices::sortAlong(const EdgeSet& set, const Vertex& v, std::size_t side) {
    const auto first = ends_.begin() + v.first, last = first + v.count;
    sortFew(first, last, [&](EdgeEnd p, EdgeEnd q) {
        const std::int64_t o = orient(v.at, next(set, p), next(set, q));
        return side < 2 ? o < 0 : o > 0;
    });
    for (std::uint32_t i = v.first; i < v.first + v.count; ++i)
        placeOf_[ends_[i]] = i;
}

void Vertices::listBorder(const EdgeSet& set) {
    for (std::size_t side = 0; side < 4; ++side) {
        auto& vertices = onSide_[side];
        auto& border = border_[side];
        const auto along = [&](std::uint32_t i) {
            return side % 2 == 0 ? vertices_[i].at.x : vertices_[i].at.y;
        };
        sortFew(vertices.begin(), vertices.end(),
                [&](std::uint32_t i, std::uint32_t j) { return along(i) < along(j); });
        border.clear();
        for (const std::uint32_t i : vertices) {
            const Vertex& v = vertices_[i];
            if (v.count > 1)
                sortAlong(set, v, side);
            border.insert(border.end(), ends_.begin() + v.first, ends_.begin() + v.first + v.count);
        }
    }
}

}  // namespace vtm::compiler
