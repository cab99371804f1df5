/// \file
/// calc(), min(), max() and clamp(). Source: CSS Values 4 section 10.
#pragma once

#include <optional>

#include "svg/css/length.hpp"

namespace vtm::svg {

/// A number, an angle, or a length with a share of something that is known only where it is used.
struct MathValue {
    double number = 0;  ///< of a number
    double length = 0;  ///< user units; of an angle degrees
    double percent = 0;
    bool isLength = false;  ///< or a percentage
    bool hasPercent = false;
    bool isAngle = false;
};

/// Whether a mathematical function comes next.
bool startsMath(const Cursor& cursor);

/// Nothing where it is not valid, divides by zero, compares lengths with percentages, or is nested too
/// deeply.
std::optional<MathValue> readMath(Cursor& cursor, const Units& units);

}  // namespace vtm::svg
