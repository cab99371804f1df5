#include "compiler/direct/pixel_row.hpp"

#include <bit>
#include <cmath>

namespace vtm::compiler {

template <class Function>
void PixelRow::forEachTouched(Function&& f) {
    for (std::size_t i = 0; i < touched_.size(); ++i)
        for (std::uint64_t& bits = touched_[i]; bits != 0; bits &= bits - 1)
            f(int(64 * i) + std::countr_zero(bits));
}

const std::vector<asset::CoverageRun>& PixelRow::runs() {
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

void PixelRow::open(int x, const PassingEdge& s) {
    if (!passages_.empty())
        passages_.back().end = edges_.size();
    int& first = first_[std::size_t(x)];
    if (first < 0)
        touched_[std::size_t(x) / 64] |= std::uint64_t(1) << (x & 63);
    passages_.push_back({first, s.change});
    passages_.back().edges = edges_.size();
    first = int(passages_.size()) - 1;
    column_ = x;
}

/// Goes straight to (x, y), from pixel to pixel.
void PixelRow::cross(PassingEdge& s, double x, double y) {
    const auto heightAt = [&](double border) { return std::clamp(s.y0 + (border - s.x0) * s.along, s.y, y); };
    if (x >= s.x) {
        while (x >= column_ + 1) {
            const int border = column_ + 1;
            add(s, border, heightAt(border));
            open(border, s);
            passages_.back().enters = true;
        }
    } else {
        while (x < column_) {
            const int border = column_;
            add(s, border, heightAt(border));
            passages_.back().leaves = true;
            open(border - 1, s);
        }
    }
    add(s, x, y);
}

/// Goes straight to (x, y) within a pixel.
void PixelRow::add(PassingEdge& s, double x, double y) {
    Passage& p = passages_.back();
    const double height = (y - s.y) * s.change, x0 = s.x - column_, x1 = x - column_;
    p.height += height;
    p.area += height * (1 - (x0 + x1) / 2);
    if (y > s.y || x != s.x || p.edges == edges_.size())
        edges_.push_back({x0, s.y - bottom_, x1, y - bottom_, y > s.y ? s.across : 0, s.change});
    s.x = x;
    s.y = y;
}
void PixelRow::add(int x, float share) {
    if (share > 0)
        runs_.push_back({x, x + 1, std::min(share, 1.0f)});
}

double PixelRow::share(int first) {
    const Passage& p = passages_[std::size_t(first)];
    if (p.next >= 0)
        return crowded(first);
    const double other = left_ + p.area - winding_, part = std::min(std::abs(other), 1.0);
    const bool isIn = isInside(rule_, winding_), isOtherIn = isInside(rule_, winding_ + (other > 0 ? 1 : -1));
    return (isIn ? 1 - part : 0) + (isOtherIn ? part : 0);
}

double PixelRow::crowded(int first) {
    if (rule_ == scene::FillRule::NonZero && isInsideEverywhere(first))
        return 1;
    inPixel_.clear();
    int left = winding_;
    for (int i = first; i >= 0; i = passages_[std::size_t(i)].next) {
        const Passage& p = passages_[std::size_t(i)];
        const std::size_t end = std::size_t(i) + 1 < passages_.size() ? p.end : edges_.size();
        if (p.enters) {
            left -= p.change;
            edges_[p.edges].low = 0;
        }
        if (p.leaves)
            edges_[end - 1].high = 1;
        inPixel_.insert(inPixel_.end(), edges_.begin() + std::ptrdiff_t(p.edges),
                        edges_.begin() + std::ptrdiff_t(end));
    }
    return pixel_.share(rule_, left, inPixel_);
}

/// Whether no winding number in the pixel can be 0, wherever its strands cross. A strand adds 0 or its
/// change to that of the corner, or 0 or its step if there is one.
bool PixelRow::isInsideEverywhere(int first) const {
    int lowest = winding_, highest = winding_;
    for (int i = first; i >= 0; i = passages_[std::size_t(i)].next) {
        const Passage& p = passages_[std::size_t(i)];
        const int added = p.enters ? -p.change : p.change;
        (added < 0 ? lowest : highest) += added;
    }
    return lowest > 0 || highest < 0;
}

/// Goes on to the next pixel.
void PixelRow::pass(int first) {
    for (int i = first; i >= 0; i = passages_[std::size_t(i)].next) {
        winding_ += passages_[std::size_t(i)].corner;
        left_ += passages_[std::size_t(i)].height;
    }
}

}  // namespace vtm::compiler
