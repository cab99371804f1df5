#include "raster/src/detail.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "raster/src/boundaries.hpp"
#include "raster/src/row_sums.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;

/// Of a loop whose area is below that, in pixels, 10 000 in a pixel would not show.
constexpr double noArea = 1e-7;

/// Against the piece's direction.
PlanarPiece reversed(const PlanarPiece& p) { return {p.b, p.a, p.slopeB, p.slopeA, p.right, p.left}; }

/// The area between a piece and its chord, on its left.
double areaOf(const PlanarPiece& p) {
    const dvec2 d = p.b - p.a;
    return (p.slopeA - p.slopeB) / 12 * glm::dot(d, d);
}

// ---- Chains ---------------------------------------------------------------------------------------

constexpr std::uint32_t none = 0xFFFFFFFFu;

/// Which piece follows which: those that meet in a point where no others end, between the same two regions.
class Followers {
public:
    /// All with the lower paint on their left.
    Followers(std::span<const PlanarPiece> pieces, const DetailSquare& square)
        : next(pieces.size(), none),
          hasBefore(pieces.size()),
          pieces_(pieces),
          slots_(std::bit_ceil(2 * pieces.size() + 2)) {
        for (std::uint32_t i = 0; i < pieces.size(); ++i) {
            add(pieces[i].a, i, &Slot::begins);
            add(pieces[i].b, i, &Slot::ends);
        }
        for (const Slot& slot : slots_)
            if (slot.begins != none && slot.ends != none && !slot.hasMore && isSame(slot.begins, slot.ends) &&
                !square.isOnBorder(pieces[slot.begins].a)) {
                next[slot.ends] = slot.begins;
                hasBefore[slot.begins] = true;
            }
    }

    std::vector<std::uint32_t> next;
    std::vector<std::uint8_t> hasBefore;

private:
    /// A point: a piece that begins there, and one that ends there.
    struct Slot {
        std::uint32_t begins = none, ends = none;
        bool hasMore = false;
    };

    void add(dvec2 point, std::uint32_t piece, std::uint32_t Slot::*role) {
        const std::uint64_t x = std::bit_cast<std::uint64_t>(point.x),
                            y = std::bit_cast<std::uint64_t>(point.y);
        std::uint64_t at = ((x * 0x9E3779B97F4A7C15u ^ std::rotl(y, 29)) * 0xBF58476D1CE4E5B9u) >> 20;
        while (!isFreeOrAt(slots_[at & (slots_.size() - 1)], point))
            ++at;
        Slot& slot = slots_[at & (slots_.size() - 1)];
        if (slot.*role == none)
            slot.*role = piece;
        else
            slot.hasMore = true;
    }
    bool isFreeOrAt(const Slot& slot, dvec2 point) const {
        if (slot.begins != none)
            return pieces_[slot.begins].a == point;
        return slot.ends == none || pieces_[slot.ends].b == point;
    }
    bool isSame(std::uint32_t a, std::uint32_t b) const {
        return pieces_[a].left == pieces_[b].left && pieces_[a].right == pieces_[b].right;
    }

    std::span<const PlanarPiece> pieces_;
    std::vector<Slot> slots_;
};

// ---- Runs -----------------------------------------------------------------------------------------

/// The directions in which a straight line from a point passes all points seen so far within a distance.
class Sleeve {
public:
    explicit Sleeve(double tolerance) : tolerance_(tolerance) {}

    /// Whether the line that ends in `d`, from the first point, passes all of them.
    bool holds(dvec2 d) const {
        return isOpen_ && (isFree_ || (cross(low_, d) >= 0 && cross(d, high_) >= 0));
    }
    bool isOpen() const { return isOpen_; }
    /// `d` is that long. `slack`: what lies between this point and the last one is so far off the line
    /// between them.
    void pass(dvec2 d, double length, double slack) {
        const double tolerance = tolerance_ - slack;
        if (tolerance < 0) {
            isOpen_ = false;
            return;
        }
        if (length <= tolerance)
            return;
        // As atan is below asin, a little less than what is within the distance.
        const dvec2 across = tolerance / length * dvec2(-d.y, d.x), low = d - across, high = d + across;
        if (std::exchange(isFree_, false)) {
            low_ = low;
            high_ = high;
            return;
        }
        if (cross(low_, low) > 0)
            low_ = low;
        if (cross(high, high_) > 0)
            high_ = high;
        isOpen_ = isOpen_ && cross(low_, high_) >= 0 && glm::dot(low_, high_) > 0;
    }

private:
    double tolerance_;
    bool isFree_ = true, isOpen_ = true;
    dvec2 low_{0}, high_{0};
};

class Merger {
public:
    Merger(std::span<const PlanarPiece> pieces, const DetailSquare& square, double pixel)
        : square_(square), pixel_(pixel) {
        pieces_.reserve(pieces.size());
        for (const PlanarPiece& piece : pieces)
            pieces_.push_back(piece.left < piece.right ? piece : reversed(piece));
    }

    std::vector<PlanarPiece> run() {
        const Followers followers(pieces_, square_);
        std::vector<std::uint8_t> done(pieces_.size());
        const auto follow = [&](std::uint32_t first) {
            chain_.clear();
            bulges_.clear();
            for (std::uint32_t i = first; i != none && !done[i]; i = followers.next[i]) {
                done[i] = true;
                chain_.push_back(pieces_[i]);
                bulges_.push_back(pieces_[i].bulge());
            }
        };
        for (std::uint32_t i = 0; i < pieces_.size(); ++i)
            if (!followers.hasBefore[i]) {
                follow(i);
                addChain();
            }
        for (std::uint32_t i = 0; i < pieces_.size(); ++i)
            if (!done[i]) {
                follow(i);
                addLoop();
            }
        return std::move(merged_);
    }

private:
    /// Pieces that a straight one takes the place of, or one that stays.
    struct Run {
        std::size_t end;
        bool isStraight;
        double area = 0;     ///< between the pieces and the straight one, on their left
        double left = area;  ///< of it, what no point has made up for
    };

    /// The longest one that begins with a piece of the chain.
    Run runFrom(std::size_t first) const {
        const dvec2 origin = chain_[first].a;
        Sleeve near(chordTolerance * pixel_), wide(detailTolerance * pixel_);
        Run best{first + 1, false};
        double area = 0;
        bool isShort = true;  ///< no point is further away than a pixel
        for (std::size_t i = first; i < chain_.size(); ++i) {
            const PlanarPiece& piece = chain_[i];
            const double bulge = bulges_[i];
            const dvec2 d = piece.b - origin;
            const double length = glm::length(d);
            // To the left of the line back to the first point.
            area += areaOf(piece) - 0.5 * cross(piece.a - origin, d);
            near.pass(d, length, bulge);
            isShort = isShort && length <= pixel_;
            if (isShort)
                wide.pass(d, length, bulge);
            const double mostArea = movedArea * pixel_ * std::max(pixel_, length);
            if (std::abs(area) <= mostArea && ((isShort && wide.holds(d)) || near.holds(d)))
                best = {i + 1, i > first || bulge > 0, area, area};
            else if (!near.isOpen() && !(isShort && wide.isOpen()))
                break;
        }
        return best;
    }

    void findRuns() {
        runs_.clear();
        for (std::size_t i = 0; i < chain_.size(); i = runs_.back().end)
            runs_.push_back(runFrom(i));
    }

    /// Its ends stay.
    void addChain() {
        findRuns();
        addRuns(false);
    }

    void addLoop() {
        findRuns();
        if (runs_.size() > 2)
            return addRuns(true);
        addThinLoop();
    }

    /// As a triangle of the same area, from the first point to that which is furthest from it.
    void addThinLoop() {
        const dvec2 from = chain_[0].a;
        dvec2 to = from;
        double area = 0;
        for (const PlanarPiece& piece : chain_) {
            area += areaOf(piece) - 0.5 * cross(piece.a - from, piece.b - from);
            if (glm::distance(from, piece.b) > glm::distance(from, to))
                to = piece.b;
        }
        if (std::abs(area) < noArea * pixel_ * pixel_)
            return;
        addBent(chain_[0], from, to, area);
        addStraight(chain_[0], to, from);
    }

    void addStraight(PlanarPiece piece, dvec2 from, dvec2 to) {
        piece.a = from;
        piece.b = to;
        piece.slopeA = piece.slopeB = 0;
        if (from != to)
            merged_.push_back(piece);
    }
    /// Two straight ones with so much on their left, and on the right of the line from end to end.
    void addBent(const PlanarPiece& piece, dvec2 from, dvec2 to, double area) {
        const dvec2 d = to - from;
        const dvec2 apex = 0.5 * (from + to) + 2 * area / glm::dot(d, d) * dvec2(-d.y, d.x);
        addStraight(piece, from, apex);
        addStraight(piece, apex, to);
    }

    /// The area of a straight piece is made up for by the points at its ends, by half each, or by one where
    /// the other stays. A point that moves to the left by d adds d/2 times the distance of its neighbours.
    /// Where it would move too far, the piece is bent, or the pieces stay.
    void addRuns(bool isLoop) {
        const std::size_t count = runs_.size();
        points_.clear();
        for (std::size_t i = 0; i < count; ++i)
            points_.push_back(chain_[i == 0 ? 0 : runs_[i - 1].end].a);
        points_.push_back(chain_.back().b);
        moved_ = points_;
        for (std::size_t i = isLoop ? 0 : 1; i < count; ++i) {
            Run &before = runs_[i == 0 ? count - 1 : i - 1], &after = runs_[i];
            // Of the first and the last one of a chain all, else what the other end has left.
            const double partBefore = isLoop   ? 0.5
                                      : i == 1 ? 1
                                               : 0.5,
                         partAfter = !isLoop && i + 1 == count ? 1 : 0.5;
            const double areaBefore = partBefore * before.area, areaAfter = partAfter * after.area;
            const dvec2 way = points_[i + 1] - points_[i == 0 ? count - 1 : i - 1];
            const double length = glm::length(way), distance = 2 * (areaBefore + areaAfter) / length;
            if (!(std::abs(distance) <= detailTolerance * pixel_))
                continue;
            moved_[i] += distance / length * dvec2(-way.y, way.x);
            before.left -= areaBefore;
            after.left -= areaAfter;
        }
        if (isLoop)
            moved_.back() = moved_.front();
        for (std::size_t i = 0, first = 0; i < count; first = runs_[i++].end)
            addRun(first, runs_[i], moved_[i], moved_[i + 1]);
    }

    void addRun(std::size_t first, const Run& run, dvec2 from, dvec2 to) {
        if (run.isStraight) {
            if (std::abs(run.left) <= minShare * pixel_ * pixel_)
                return addStraight(chain_[first], from, to);
            if (2 * std::abs(run.left) <= detailTolerance * pixel_ * glm::distance(from, to))
                return addBent(chain_[first], from, to, run.left);
        }
        for (std::size_t i = first; i < run.end; ++i) {
            PlanarPiece kept = chain_[i];
            if (i == first)
                kept.a = from;
            if (i + 1 == run.end)
                kept.b = to;
            merged_.push_back(kept);
        }
    }

    const DetailSquare& square_;
    const double pixel_;
    std::vector<PlanarPiece> pieces_, chain_;
    std::vector<double> bulges_;  ///< of the chain's
    std::vector<PlanarPiece> merged_;
    std::vector<Run> runs_;
    std::vector<dvec2> points_, moved_;
};

}  // namespace

std::vector<PlanarPiece> mergeChains(std::span<const PlanarPiece> pieces, const DetailSquare& square,
                                     double pixel) {
    return Merger(pieces, square, pixel).run();
}

}  // namespace vtm::asset
