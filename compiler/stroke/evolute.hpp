/// \file
/// The evolute of a tight stretch: the centres of its curvature, from which on its offset runs backward.
///
/// It is a chain of parabolas: between two normals that differ by at most 45°, both end tangents of the
/// evolute are the normals themselves, and they meet between curve and offset, in the control point.
#pragma once

#include "compiler/stroke/offset.hpp"
#include "compiler/stroke/stretch.hpp"

namespace vtm::compiler::stroke {

/// Over u in [0, 1], as the stretch, which must outlive it.
class Evolute {
public:
    /// The radius is positive if the stretch bends to the left.
    Evolute(const Cubic& c, const Stretch& stretch, double signedRadius, const OffsetOptions& options);

    Point at(double u) const;
    bool isTighterAtEnd() const;
    /// Where the stretch is tightest.
    Point tip() const { return at(tightest()); }
    /// How far it comes from the offset.
    double depth() const;

    /// Goes on with it, from its start on, where the side has come to within the tolerance.
    void append(Side& side) const;

private:
    struct Parabola;

    void append(double u0, double u1, int depth, Side& side) const;
    double tightest() const;
    double error(const Parabola& arc, double u0, double u1) const;
    Point normal(double u) const;
    double centreDistance(double u) const;
    Point meeting(double u0, double u1) const;

    Curvature curvature_;
    const Stretch& stretch_;
    double radius_, tolerance_, straight_;
};

}  // namespace vtm::compiler::stroke
