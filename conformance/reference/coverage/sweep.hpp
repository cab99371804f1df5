/// \file
/// Cuts a row of pixels into trapezoids inside which every shape's winding is constant. The trapezoids
/// are disjoint and fill the row, so areas and area-weighted means are exact, whatever overlaps.
///
/// Columns without edges are handed over as runs. In a pixel with edges, the edges are cut at its
/// sides, and the pixel into strips at all their end points and crossings; in a strip they are ordered.
/// The windings at a pixel's left side come from its top left corner, plus the edges that cross that
/// side above the strip. A point on a pixel's border lies right of and below the border throughout.
#pragma once

#include <span>
#include <vector>

#include "conformance/reference/outline/edges.hpp"

namespace vtm::reference {

/// An edge between its upper and lower end in a row of pixels.
struct EdgePart {
    double xa, ya, xb, yb;
    int shape;
    int winding;
};

/// The parts of the edges that lie in the row [y, y + 1). What only touches its top from above is no
/// part of it.
void cutToRow(std::span<const Edge> edges, int y, std::vector<EdgePart>& parts);

/// Straight sides from (left0, y0) to (left1, y1) and from (right0, y0) to (right1, y1).
struct Trapezoid {
    double y0, y1, left0, left1, right0, right1;

    double area() const { return (right0 - left0 + right1 - left1) / 2 * (y1 - y0); }
};

/// Hears what the sweep finds, from left to right. The windings of all shapes are zero at first.
class Regions {
public:
    virtual ~Regions() = default;
    /// What follows lies on the other side of an edge of the shape.
    virtual void cross(int shape, int winding) = 0;
    /// Whole pixels [begin, end).
    virtual void run(int begin, int end) = 0;
    /// A part of the pixel at `column`; absolute coordinates.
    virtual void part(int column, const Trapezoid& trapezoid) = 0;
};

/// Sweeps rows of `width` pixels. Holds scratch memory only.
class RowSweep {
public:
    explicit RowSweep(int width) : width_(width) {}
    /// `parts`: of the row at `y`. Afterwards all windings are back to zero.
    void sweep(std::span<const EdgePart> parts, int y, Regions& regions);

private:
    /// A part inside one pixel.
    struct Side {
        double xt, yt, xb, yb;
        int shape, winding;

        double xAt(double y) const;
    };
    /// An edge that crosses the pixel's left side at y.
    struct Entry {
        double y;
        int shape, winding;
    };
    /// A side between the top and the bottom of a strip.
    struct Crosser {
        double x0, x1;
        const Side* side;
    };

    void sortIntoColumns(std::span<const EdgePart> parts);
    void startRow(std::span<const EdgePart> parts, int y, Regions& regions);
    void finishRow(Regions& regions);
    void cross(int shape, int winding, Regions& regions);
    void pixel(std::span<const EdgePart> parts, std::span<const int> members, int column, int y,
               Regions& regions);
    void cutToPixel(const EdgePart& part, int column);
    void collectStrips(int y);
    void enterThrough(double y, std::size_t& next, Regions& regions);
    void strip(double y0, double y1, int column, Regions& regions);
    bool findCrossings(double y0, double y1);
    void orderedStrip(double y0, double y1, int column, Regions& regions);
    void emitStrip(double y0, double y1, int column, Regions& regions);

    int width_;
    int first_ = 0, last_ = -1;                  ///< columns that parts meet
    std::vector<int> begins_, members_;          ///< parts by column: members_[begins_[c - first_]…]
    std::vector<std::pair<int, int>> windings_;  ///< changes to take back at the row's end
    std::vector<Side> sides_;
    std::vector<Entry> entries_;
    std::vector<double> levels_;
    std::vector<const Side*> active_;
    std::vector<Crosser> crossers_;
    std::vector<double> crossings_;
};

}  // namespace vtm::reference
