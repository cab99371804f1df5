/// \file
/// Files damaged at random.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace vtm::generate {

/// The bytes with eight places overwritten, deleted or doubled; one time in eight with the rest cut off, too.
/// Half of what is written is a digit, so that numbers become other numbers. The same for a state of `random`
/// on every machine.
std::vector<std::uint8_t> damaged(std::vector<std::uint8_t> bytes, std::mt19937_64& random);

}  // namespace vtm::generate
