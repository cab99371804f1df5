#include "compiler/src/lattice.hpp"

#include <algorithm>

namespace vtm::compiler {
namespace {

/// How far beyond the root square geometry may reach, in steps: any small even number will do.
constexpr double margin = 16;

double clampLimit(double extent, double longer, double scale) {
    return extent == longer ? static_cast<double>(latticeSide) + margin : extent * scale - 2;
}

}  // namespace

Lattice::Lattice(double width, double height) {
    const double longer = std::max(width, height);
    scale_ = static_cast<double>(latticeSide + 2) / longer;
    clampMax_ = {clampLimit(width, longer, scale_), clampLimit(height, longer, scale_)};
}

}  // namespace vtm::compiler
