/// \file
/// What passes through the pixels of a row of a single outline in, their coverage out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "compiler/direct/crowded_pixel.hpp"
#include "raster/coverage.hpp"

namespace vtm::compiler {

/// Where a part of an outline is on its way through the rows, and the edge that it is on. Right of it the
/// winding number is greater by `change`.
struct PassingEdge {
    double x, y;
    double x0, y0, x1, y1;
    double across, along;  ///< dx / dy and dy / dx
    int change;

    void setEnd(glm::dvec2 end) {
        x0 = x1, y0 = y1;
        x1 = end.x, y1 = end.y;
        across = (x1 - x0) / (y1 - y0);
        along = (y1 - y0) / (x1 - x0);
    }
};

/// A part of an outline on which y nowhere falls; its vertices are pixels of PlaceOf.
template <class Vertex, glm::dvec2 (*placeOf)(const Vertex&)>
struct Strand : PassingEdge {
    const Vertex* next;  ///< the end of its edge
    const Vertex* last;
    std::ptrdiff_t way;  ///< to the vertex after, 1 or -1

    /// At the vertex `from`, on the edge that begins there.
    Strand(const Vertex* from, const Vertex* to, std::ptrdiff_t step, int c)
        : next(from + step), last(to), way(step) {
        const glm::dvec2 at = placeOf(*from);
        change = c;
        x = x1 = at.x;
        y = y1 = at.y;
        setEnd(placeOf(*next));
    }
    bool isAtLast() const { return next == last; }
    void goOn() { setEnd(placeOf(*(next += way))); }
};

/// The integral of the winding number over a pixel is the sum of the heights of what passes on its left and
/// of the areas right of what passes through it. A single strand divides a pixel into two parts, whose
/// winding numbers differ by 1: that at the corner and the integral give both shares, and the one that is
/// inside is the coverage. Where several strands meet, CrowdedPixel tells what lies between.
class PixelRow {
public:
    /// Columns left of the view and right of it stand for all that lies there.
    static constexpr int outerColumns = 1;

    PixelRow(scene::FillRule rule, int width)
        : rule_(rule),
          width_(width),
          first_(std::size_t(outerColumns + width + 2), -1),
          touched_(first_.size() / 64 + 1) {}

    void begin(int y) {
        bottom_ = y;
        passages_.clear();
        edges_.clear();
    }

    /// Takes a strand, whose columns are counted from the outer ones on, up to the row's upper border. False
    /// if it ends before.
    template <class Strand>
    bool follow(Strand& s) {
        const double top = bottom_ + 1.0;
        // What is level there leads on along the lower border.
        while (s.y1 == s.y0 && s.y1 == bottom_ && !s.isAtLast()) {
            s.goOn();
            s.x = s.x0;
        }
        if (s.y1 == bottom_)
            return false;
        open(int(s.x), s);
        if (s.y == bottom_)
            passages_.back().corner = s.change;
        while (true) {
            const bool ends = s.y1 <= top;
            const double y = ends ? s.y1 : top;
            double x = s.x1;
            if (!ends)
                x = std::clamp(s.x0 + (top - s.y0) * s.across, std::min(s.x, s.x1), std::max(s.x, s.x1));
            cross(s, x, y);
            if (!ends)
                return true;
            if (s.isAtLast())
                return false;
            s.goOn();
            if (s.y >= top)
                return true;
        }
    }

    /// From left to right; those that are not covered are left out.
    const std::vector<asset::CoverageRun>& runs();

private:
    /// The part of a strand in a pixel.
    struct Passage {
        int next;  ///< in the same pixel, another strand's; -1: none
        int change;
        int corner = 0;       ///< how it changes the winding number on the row's lower border
        bool enters = false;  ///< through the pixel's left side
        bool leaves = false;
        double area = 0;    ///< of the pixel, right of it, times its change
        double height = 0;  ///< times its change
        std::size_t edges = 0, end = 0;
    };

    template <class Function>
    void forEachTouched(Function&& f);
    void open(int x, const PassingEdge& s);
    void cross(PassingEdge& s, double x, double y);
    void add(PassingEdge& s, double x, double y);
    void add(int x, float share);
    double share(int first);
    double crowded(int first);
    bool isInsideEverywhere(int first) const;
    void pass(int first);

    const scene::FillRule rule_;
    const int width_;
    int bottom_ = 0, column_ = 0;
    std::vector<int> first_;  ///< a passage of each column; the last one is right of the view
    std::vector<std::uint64_t> touched_;
    std::vector<Passage> passages_;
    std::vector<PixelEdge> edges_;
    int winding_ = 0;  ///< just above the pixel's lower left corner
    double left_ = 0;  ///< its integral along the left side
    std::vector<asset::CoverageRun> runs_;
    CrowdedPixel pixel_;
    std::vector<PixelEdge> inPixel_;
};

}  // namespace vtm::compiler
