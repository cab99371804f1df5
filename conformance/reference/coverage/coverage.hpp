/// \file
/// A single shape's coverage of a row of pixels.
#pragma once

#include <vtm/scene/path.hpp>
#include "conformance/reference/coverage/sweep.hpp"

namespace vtm::reference {

inline bool isInside(int winding, scene::FillRule rule) {
    return rule == scene::FillRule::NonZero ? winding != 0 : (winding & 1) != 0;
}

/// Adds the area inside, pixel by pixel, to a row of `width` zeros.
class CoverageRow final : public Regions {
public:
    CoverageRow(scene::FillRule rule, double* row) : rule_(rule), row_(row) {}
    void cross(int, int winding) override { winding_ += winding; }
    void run(int begin, int end) override {
        if (isInside(winding_, rule_))
            std::fill(row_ + begin, row_ + end, 1.0);
    }
    void part(int column, const Trapezoid& trapezoid) override {
        if (isInside(winding_, rule_))
            row_[column] += trapezoid.area();
    }

private:
    scene::FillRule rule_;
    double* row_;
    int winding_ = 0;
};

/// Throws std::length_error beyond the limits of View, std::invalid_argument if a side is not positive.
void checkView(const View& view);

}  // namespace vtm::reference
