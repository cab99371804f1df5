/// \file
/// Texts of trees for tests.
#pragma once

#include <string>

#include <vtm/vtmtree.hpp>

namespace vtm {

inline std::span<const std::uint8_t> bytesOf(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

inline Tree readText(const std::string& text) { return readTree(bytesOf(text), {"t.vtmtree", ""}); }

inline Mask box(double side) { return filled(scene::rectangle({0, 0}, {side, side})); }

inline const Vtm red = Vtm::paint(scene::Color{1, 0, 0, 1}), blue = Vtm::paint(scene::Color{0, 0, 1, 1});

}  // namespace vtm
