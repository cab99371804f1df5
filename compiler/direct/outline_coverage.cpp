#include "compiler/outline_coverage.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <vtm/limits/limits.hpp>
#include "compiler/direct/crowded_pixel.hpp"
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {
namespace {

using asset::CoverageRun;

/// Lattice steps a pixel: vertices are rounded to 2^-13 of one.
constexpr int pixelBits = 14;
constexpr double perStep = 1.0 / (1 << pixelBits);
constexpr int maxSide = 1 << (maxLatticeBits - pixelBits);

/// The first column stands for all that is left of the view: what lies there is moved into it.
constexpr int outerColumns = 1;

/// In pixels: curves that are one chord stray by this at most, others misplace this much of a pixel where
/// they pass through it, an eighth of a 255th. Some may pass through the same one.
constexpr double strayed = 1.0 / 1024, areaMisplaced = 1.0 / 2048;

/// Edges times the pixels that they pass through: about two seconds where these cross everywhere, four where
/// thousands pass through each pixel.
constexpr double maxPassages = 3'000'000;

/// A monotone run on its way up. Right of it the winding number is greater by `change`.
struct Strand {
    const LatticePoint* next;  ///< the end of its edge
    const LatticePoint* last;
    std::ptrdiff_t way;  ///< to the point after, 1 or -1
    int change;
    bool goesRight;
    int row;  ///< in which it begins

    double x, y;            ///< where it is
    double x0, y0, x1, y1;  ///< its edge
    double across, along;   ///< dx / dy and dy / dx of the edge

    void setEdge() {
        x0 = x1, y0 = y1;
        x1 = next->x * perStep, y1 = next->y * perStep;
        across = (x1 - x0) / (y1 - y0);
        along = (y1 - y0) / (x1 - x0);
    }
};

Strand strandOf(const Outlines& outlines, Run run) {
    const LatticePoint *first = &outlines.points[run.first], *last = &outlines.points[run.last];
    const bool goesUp = first->y < last->y;
    if (!goesUp)
        std::swap(first, last);
    Strand s{};
    s.way = goesUp ? 1 : -1;
    s.change = goesUp ? 1 : -1;
    s.goesRight = first->x <= last->x;
    s.row = first->y >> pixelBits;
    s.x = s.x1 = first->x * perStep;
    s.y = s.y1 = first->y * perStep;
    s.next = first + s.way;
    s.last = last;
    s.setEdge();
    return s;
}

/// The strands of an outline, those that begin first first.
std::vector<Strand> strandsOf(const Outlines& outlines, int rows) {
    std::vector<Strand> strands;
    strands.reserve(outlines.runs.size());
    for (const Run& run : outlines.runs)
        strands.push_back(strandOf(outlines, run));
    std::erase_if(strands, [&](const Strand& s) { return s.row >= rows; });
    std::ranges::sort(strands, {}, &Strand::row);
    return strands;
}

/// How many pixels all edges pass through, counted by edge.
double passages(const Outlines& outlines) {
    double steps = 0;
    for (const Run& run : outlines.runs)
        steps += std::abs(double(outlines.points[run.last].x) - outlines.points[run.first].x) +
                 std::abs(double(outlines.points[run.last].y) - outlines.points[run.first].y);
    return steps * perStep + double(outlines.points.size());
}

/// The part of a strand in a pixel.
struct Passage {
    int next;  ///< in the same pixel, another strand's; -1: none
    int change, strand;
    int corner = 0;        ///< how it changes the winding number on the row's lower border
    PixelStep step{0, 0};  ///< on the pixel's left side
    double area = 0;       ///< of the pixel, right of it, times its change
    double height = 0;     ///< times its change
    std::size_t edges = 0, end = 0;
};

/// What passes through the pixels of a row, and their coverage.
///
/// The integral of the winding number over a pixel is the sum of the heights of what passes on its left and
/// of the areas right of what passes through it. A single strand divides a pixel into two parts, whose
/// winding numbers differ by 1: that at the corner and the integral give both shares, and the one that is
/// inside is the coverage. Where several strands meet, CrowdedPixel tells what lies between.
class PixelRow {
public:
    PixelRow(scene::FillRule rule, int width)
        : rule_(rule),
          width_(width),
          first_(std::size_t(outerColumns + width) + 1, -1),
          touched_(first_.size() / 64 + 1) {}

    void begin(int y) {
        bottom_ = y;
        passages_.clear();
        edges_.clear();
    }

    /// Takes a strand up to the row's upper border. False if it ends before.
    bool follow(Strand& s, int index) {
        const double top = bottom_ + 1.0;
        // What is level there leads on along the lower border.
        while (s.y1 == s.y0 && s.y1 == bottom_ && s.next != s.last) {
            s.next += s.way;
            s.setEdge();
            s.x = s.x0;
        }
        if (s.y1 == bottom_)
            return false;
        open(int(s.x), s, index);
        if (s.y == bottom_)
            passages_.back().corner = s.change;
        while (true) {
            const bool ends = s.y1 <= top;
            const double y = ends ? s.y1 : top;
            double x = s.x1;
            if (!ends) {
                const double at = s.x0 + (top - s.y0) * s.across;
                x = s.goesRight ? std::clamp(at, s.x, s.x1) : std::clamp(at, s.x1, s.x);
            }
            cross(s, index, x, y);
            if (!ends)
                return true;
            if (s.next == s.last)
                return false;
            s.next += s.way;
            s.setEdge();
            if (s.y >= top)
                return true;
        }
    }

    const std::vector<CoverageRun>& runs() {
        runs_.clear();
        winding_ = 0;
        left_ = 0;
        int done = 0;
        forEachTouched([&](int column) {
            int& first = first_[std::size_t(column)];
            const int x = column - outerColumns;
            if (x > done && isInside(rule_, winding_))
                runs_.push_back({done, x, 1});
            done = x + 1;
            if (x >= 0 && x < width_)
                add(x, float(share(first)));
            pass(first);
            first = -1;
        });
        if (done < width_ && isInside(rule_, winding_))
            runs_.push_back({done, width_, 1});
        return runs_;
    }

private:
    template <class Function>
    void forEachTouched(Function&& f) {
        for (std::size_t i = 0; i < touched_.size(); ++i)
            for (std::uint64_t& bits = touched_[i]; bits != 0; bits &= bits - 1)
                f(int(64 * i) + std::countr_zero(bits));
    }

    void open(int x, const Strand& s, int index) {
        if (!passages_.empty())
            passages_.back().end = edges_.size();
        int& first = first_[std::size_t(x)];
        if (first < 0)
            touched_[std::size_t(x) / 64] |= std::uint64_t(1) << (x & 63);
        passages_.push_back({first, s.change, index});
        passages_.back().edges = edges_.size();
        first = int(passages_.size()) - 1;
        column_ = x;
    }

    /// Goes straight to (x, y), from pixel to pixel.
    void cross(Strand& s, int index, double x, double y) {
        const auto heightAt = [&](double border) {
            return std::clamp(s.y0 + (border - s.x0) * s.along, s.y, y);
        };
        if (s.goesRight) {
            while (x >= column_ + 1) {
                const int border = column_ + 1;
                add(s, border, heightAt(border));
                open(border, s, index);
                passages_.back().step = {s.y - bottom_, -s.change};
            }
        } else {
            while (x < column_) {
                const int border = column_;
                add(s, border, heightAt(border));
                passages_.back().step = {s.y - bottom_, s.change};
                open(border - 1, s, index);
            }
        }
        add(s, x, y);
    }

    /// Goes straight to (x, y) within a pixel.
    void add(Strand& s, double x, double y) {
        if (y > s.y) {
            Passage& p = passages_.back();
            const double height = (y - s.y) * s.change, x0 = s.x - column_, x1 = x - column_;
            p.height += height;
            p.area += height * (1 - (x0 + x1) / 2);
            edges_.push_back({x0, s.y - bottom_, y - bottom_, s.across, s.change, p.strand});
        }
        s.x = x;
        s.y = y;
    }
    void add(int x, float share) {
        if (share > 0)
            runs_.push_back({x, x + 1, std::min(share, 1.0f)});
    }

    double share(int first) {
        const Passage& p = passages_[std::size_t(first)];
        if (p.next >= 0)
            return crowded(first);
        const double other = left_ + p.area - winding_, part = std::min(std::abs(other), 1.0);
        const bool isIn = isInside(rule_, winding_),
                   isOtherIn = isInside(rule_, winding_ + (other > 0 ? 1 : -1));
        return (isIn ? 1 - part : 0) + (isOtherIn ? part : 0);
    }

    double crowded(int first) {
        if (rule_ == scene::FillRule::NonZero && isInsideEverywhere(first))
            return 1;
        inPixel_.clear();
        steps_.clear();
        for (int i = first; i >= 0; i = passages_[std::size_t(i)].next) {
            const Passage& p = passages_[std::size_t(i)];
            const std::size_t end = std::size_t(i) + 1 < passages_.size() ? p.end : edges_.size();
            inPixel_.insert(inPixel_.end(), edges_.begin() + std::ptrdiff_t(p.edges),
                            edges_.begin() + std::ptrdiff_t(end));
            if (p.step.change != 0)
                steps_.push_back(p.step);
        }
        return pixel_.share(rule_, winding_, inPixel_, steps_);
    }

    /// Whether no winding number in the pixel can be 0, wherever its strands cross. A strand adds 0 or its
    /// change to that of the corner, or 0 or its step if there is one.
    bool isInsideEverywhere(int first) const {
        int lowest = winding_, highest = winding_;
        for (int i = first; i >= 0; i = passages_[std::size_t(i)].next) {
            const Passage& p = passages_[std::size_t(i)];
            const int added = p.step.change != 0 ? p.step.change : p.change;
            (added < 0 ? lowest : highest) += added;
        }
        return lowest > 0 || highest < 0;
    }

    /// Goes on to the next pixel.
    void pass(int first) {
        for (int i = first; i >= 0; i = passages_[std::size_t(i)].next) {
            winding_ += passages_[std::size_t(i)].corner;
            left_ += passages_[std::size_t(i)].height;
        }
    }

    const scene::FillRule rule_;
    const int width_;
    int bottom_ = 0, column_ = 0;
    std::vector<int> first_;  ///< a passage of each column; the last one is right of the view
    std::vector<std::uint64_t> touched_;
    std::vector<Passage> passages_;
    std::vector<PixelEdge> edges_;
    int winding_ = 0;  ///< just above the pixel's lower left corner
    double left_ = 0;  ///< its integral along the left side
    std::vector<CoverageRun> runs_;
    CrowdedPixel pixel_;
    std::vector<PixelEdge> inPixel_;
    std::vector<PixelStep> steps_;
};

}  // namespace

bool coverOutline(const scene::Path& outline, scene::FillRule rule, const scene::Affine& toPixels, int width,
                  int height, const std::function<void(int y, std::span<const CoverageRun> runs)>& row) {
    if (width > maxSide || height > maxSide)
        return false;
    constexpr double steps = 1 << pixelBits;
    Outlines outlines;
    const scene::Affine toSteps = scene::compose(
        scene::scaling(steps, steps), scene::compose(scene::translation(outerColumns, 0), toPixels));
    addOutline(outlines, outline, toSteps, ChordTolerance(strayed, areaMisplaced).scaled(steps),
               glm::dvec2(0), glm::dvec2(outerColumns + width, height) * steps);
    if (passages(outlines) > maxPassages)
        return false;
    std::vector<Strand> strands = strandsOf(outlines, height);
    std::vector<int> active;
    PixelRow pixels(rule, width);
    std::size_t begun = 0;
    for (int y = 0; y < height && (begun < strands.size() || !active.empty()); ++y) {
        limits::check();
        for (; begun < strands.size() && strands[begun].row == y; ++begun)
            active.push_back(int(begun));
        if (active.empty())
            continue;
        pixels.begin(y);
        std::erase_if(active, [&](int i) { return !pixels.follow(strands[std::size_t(i)], i); });
        const std::vector<CoverageRun>& runs = pixels.runs();
        if (!runs.empty())
            row(y, runs);
    }
    return true;
}

}  // namespace vtm::compiler
