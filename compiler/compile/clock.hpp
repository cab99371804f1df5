/// \file
/// How long stages take.
#pragma once

#include <chrono>

namespace vtm::compiler {

using Clock = std::chrono::steady_clock;

inline double milliseconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace vtm::compiler
