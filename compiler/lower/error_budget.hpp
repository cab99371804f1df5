/// \file
/// The error budget: how far a drawn boundary may lie from the scene's, stage by stage (docs/regions.md).
///
/// Every stage moves outlines continuously, each point by at most its bound. So a layer's winding number, and
/// whether it covers, stays what it was at every point that is farther from its true outline than the sum of
/// the bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <vtm/asset/asset.hpp>
#include "compiler/lower/area_chords.hpp"
#include "compiler/lower/lattice.hpp"

namespace vtm::compiler {

class ErrorBudget {
public:
    /// `tolerance`: share of the picture's longer side, which spans 2^latticeBits steps. Lengths are in
    /// steps. `mostChords`: beyond them lowering gives up, as it does beyond maxChords (lower.hpp).
    /// `chordArea`: that of ChordTolerance, in squares of the tolerance.
    ErrorBudget(double tolerance, int latticeBits,
                std::size_t mostChords = std::numeric_limits<std::size_t>::max(), double chordArea = 0)
        : bits_(latticeBits),
          tolerance_(std::ldexp(tolerance, latticeBits)),
          chordArea_(chordArea * tolerance_ * tolerance_),
          mostChords_(mostChords) {}

    std::size_t mostChords() const { return mostChords_; }

    /// Curves to chords, chords of stroke outlines included.
    ChordTolerance fillChords() const { return {outlineShare * tolerance_, chordArea_}; }
    /// True offsets to a stroke's outline, and that to chords.
    double strokeOutline() const { return strokeShare * tolerance_; }
    ChordTolerance strokeChords() const { return {(outlineShare - strokeShare) * tolerance_, chordArea_}; }
    /// Chords to pieces: what the other stages leave where edges are bent as usual, but half of the
    /// tolerance at most. Where the lattice is as coarse as the tolerance, nothing is left, and nothing is
    /// proven.
    double fit() const {
        return std::clamp((1 - outlineShare - quantisationShare) * tolerance_ - lattice(usualBend),
                          minFitShare * tolerance_, maxFitShare * tolerance_);
    }
    /// The coarsest level on which rounding the ends of pieces keeps to its share.
    unsigned coarsestLevel() const {
        const double levels = std::log2(quantisation(0) / (quantisationShare * tolerance_)) / 2;
        return static_cast<unsigned>(std::max(0.0, std::ceil(levels)));
    }

    /// The sum of all stages for a leaf whose edges snapping has bent by no more than `bend`; `slivers` along
    /// its border have been cut.
    double leaf(unsigned level, double bend, bool slivers) const {
        const double fitted = fit() + quantisation(level);
        return outlineShare * tolerance_ + lattice(bend) +
               (slivers ? std::max(fitted, sliver(level)) : fitted);
    }
    /// Leaves of that level whose edges are bent by more do not hold, whatever else they are.
    double maxBend(unsigned level) const {
        constexpr double rounding = 1e-6;  // of sums of steps, far below a step
        return (1 - outlineShare) * tolerance_ - lattice(0) - fit() - quantisation(level) + rounding;
    }
    /// The sum of all stages for a planar map whose edges are drawn as they are, snapped with that bend.
    double planar(double bend) const { return outlineShare * tolerance_ + lattice(bend); }
    /// Of a leaf that is filled with one colour: an outline runs through it, so all of it is within its
    /// diagonal of that.
    double mean(unsigned level) const {
        return outlineShare * tolerance_ + lattice(0) + diagonal * leafSteps(level);
    }
    bool holds(double error) const { return error <= tolerance_; }
    /// Whether leaves can be made small enough for the bound to hold.
    bool canHold() const { return holds(outlineShare * tolerance_ + lattice(0) + fit()); }
    /// Steps to a share of the picture's longer side.
    double share(double steps) const { return std::ldexp(steps, -bits_); }

private:
    static constexpr double diagonal = std::numbers::sqrt2;
    static constexpr double outlineShare = 1.0 / 4, strokeShare = 1.0 / 16, quantisationShare = 3.0 / 16;
    static constexpr double maxFitShare = 1.0 / 2, minFitShare = 1.0 / 8;
    static constexpr double usualBend = 1.5;  ///< one round; two or more are rare

    /// Rounding vertices to even coordinates and stretching the picture (compiler/lower/lattice.hpp) move a
    /// point by at most a step in each axis, clipping moves it by one along a border.
    static double lattice(double bend) { return arcSteps + 2 * diagonal + 1 + bend; }
    double leafSteps(unsigned level) const { return std::ldexp(1.0, bits_ - 2 * static_cast<int>(level)); }
    /// Ends of pieces are rounded by half of 1/65535 of the leaf's side in each axis.
    double quantisation(unsigned level) const { return leafSteps(level) / asset::leafExtent * diagonal / 2; }
    /// What is cut lies, rounded, within a step and 1/65535 of the border (Fitter::hugs); in a leaf's
    /// corner that is a diagonal.
    double sliver(unsigned level) const {
        return diagonal * (1 + 1.5 * leafSteps(level) / asset::leafExtent);
    }

    const int bits_;
    const double tolerance_, chordArea_;
    const std::size_t mostChords_;

public:
    /// Elliptical arcs to cubics.
    static constexpr double arcSteps = 1.0 / 16;
};

}  // namespace vtm::compiler
