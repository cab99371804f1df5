#include "compiler/lower/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace vtm::compiler {
namespace {

/// How far beyond the root square geometry may reach, in steps: any small even number will do.
constexpr double clampMargin = 16;

}  // namespace

Lattice::Lattice(double width, double height, int bits) : bits_(bits) {
    const double longer = std::max(width, height), side = std::ldexp(1.0, bits);
    scale_ = (side + 2) / longer;
    const auto limit = [&](double extent) {
        return extent == longer ? side + clampMargin : extent * scale_ - 2;
    };
    clampMax_ = {limit(width), limit(height)};
}

glm::dvec2 Lattice::clampMin() const { return {-clampMargin, -clampMargin}; }

}  // namespace vtm::compiler
