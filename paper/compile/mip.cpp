#include "paper/compile/mip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vtm::paper {

namespace {

constexpr int linesATexel = 8;

/// Where a line y = constant meets a chord; the winding number grows by `step` from left to right.
struct Crossing {
    double x;
    int step;
};

using Lines = std::array<std::vector<Crossing>, linesATexel>;

/// The lines of one row of texels: line k of `count` lies at y = (k + 1/2) / count. A chord meets those with
/// min y < y <= max y, whichever chord a vertex ends.
void findCrossings(const Outline& outline, int firstLine, int count, Lines& lines) {
    for (auto& line : lines)
        line.clear();
    for (const Chord& c : outline.chords) {
        const auto firstAbove = [&](double y) {
            const double line = std::floor(y * count - 0.5) + 1 - firstLine;
            return int(std::clamp(line, 0.0, double(linesATexel)));
        };
        const int from = firstAbove(std::min(c.a.y, c.b.y)), to = firstAbove(std::max(c.a.y, c.b.y));
        for (int k = from; k < to; ++k) {
            const double t = ((firstLine + k + 0.5) / count - c.a.y) / (c.b.y - c.a.y);
            lines[std::size_t(k)].push_back({c.a.x + t * (c.b.x - c.a.x), c.b.y > c.a.y ? -1 : 1});
        }
    }
}

/// Adds `weight` times the overlap of [from, to] with each texel of a row; all in texels.
void addSpan(double from, double to, double weight, double* row, int size) {
    from = std::clamp(from, 0.0, double(size));
    to = std::clamp(to, 0.0, double(size));
    for (int x = int(from); x < size && x < to; ++x)
        row[x] += weight * (std::min(to, x + 1.0) - std::max(from, double(x)));
}

void addLine(const Outline& outline, std::vector<Crossing>& line, double* row, int size) {
    std::ranges::sort(line, {}, &Crossing::x);
    int winding = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        winding += line[i].step;
        if (outline.isInside(winding))
            addSpan(line[i].x * size, line[i + 1].x * size, 1.0 / linesATexel, row, size);
    }
}

std::vector<double> halved(const std::vector<double>& fine, int size) {
    const int half = size / 2;
    std::vector<double> coarse(std::size_t(half * half));
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            coarse[std::size_t(y / 2 * half + x / 2)] += fine[std::size_t(y * size + x)] / 4;
    return coarse;
}

void append(std::vector<std::uint8_t>& texels, const std::vector<double>& shares) {
    for (const double share : shares)
        texels.push_back(std::uint8_t(std::lround(std::clamp(share, 0.0, 1.0) * 255)));
}

}  // namespace

Mip makeMip(const Outline& outline, unsigned sizeLog2) {
    int size = 1 << sizeLog2;
    std::vector<double> shares(std::size_t(size) * std::size_t(size));
    Lines lines;
    for (int row = 0; row < size; ++row) {
        findCrossings(outline, row * linesATexel, size * linesATexel, lines);
        for (auto& line : lines)
            addLine(outline, line, &shares[std::size_t(row) * std::size_t(size)], size);
    }
    Mip mip{sizeLog2, {}};
    append(mip.texels, shares);
    for (; size > 1; size /= 2) {
        shares = halved(shares, size);
        append(mip.texels, shares);
    }
    return mip;
}

}  // namespace vtm::paper
