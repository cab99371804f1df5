/// \file
/// Offsets of a curve as cubics within a tolerance.
#pragma once

#include "compiler/stroke/offset.hpp"
#include "compiler/stroke/stretch.hpp"

namespace vtm::compiler::stroke {

/// The offset at `distance` to the left, run through along the curve, or against it where the curve is
/// tighter than the distance.
struct OffsetCurve {
    const Stretch& stretch;
    double distance;
    bool backward;

    Samples samples(double u0, double u1) const {
        Samples s;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double f = double(i) / double(s.size() - 1);
            s[i] = stretch.offset(u0 + (u1 - u0) * f, distance);
            if (backward)
                s[i].tangent = -s[i].tangent;
        }
        return s;
    }
};

/// Goes on to where the offset begins, and with it.
void appendFit(const OffsetCurve& curve, double tolerance, Side& side);

}  // namespace vtm::compiler::stroke
