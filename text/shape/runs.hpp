/// \file
/// A line in, runs of one font, script, direction and style out, in visual order.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "text/shape.hpp"

namespace vtm::text {

struct Run {
    std::size_t first = 0, end = 0;  ///< characters of the line
    std::size_t span = 0;            ///< of the first character
    std::shared_ptr<const Font> font;
    std::uint32_t script = 0;  ///< ISO 15924, as a tag
    std::uint8_t level = 0;
    bool upright = false;  ///< its glyphs stand below each other
};

std::vector<Run> visualRuns(const Line& line, FontSet& fonts);

}  // namespace vtm::text
