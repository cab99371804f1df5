// Fonts of the machine, and pages as scenes.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vtm/font/font_maps.hpp>
#include <vtm/raster/view.hpp>

namespace vtm::font {

using Bytes = std::vector<std::uint8_t>;

/// Debian's fonts-dejavu-core.
inline const std::filesystem::path dejavu = "/usr/share/fonts/truetype/dejavu";

/// Its fonts-hosny-amiri and fonts-wqy-microhei.
inline const std::filesystem::path amiri = "/usr/share/fonts/opentype/fonts-hosny-amiri/Amiri-Regular.ttf",
                                   microHei = "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc";

inline Bytes fileOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The printable characters up to U+0180 that the font has: `count` of them.
inline std::u32string latin(const FontMaps& font, std::size_t count = 256) {
    std::u32string characters;
    for (char32_t c = U' '; characters.size() < count && c < 0x250; ++c)
        if (font.advanceOf(c))
            characters += c;
    return characters;
}

/// `pixels` wide over a rectangle's width, turned about its middle.
inline asset::View viewOver(double x, double y, double width, double height, int pixels, double angle = 0) {
    const double scale = pixels / width;
    asset::View view{pixels, int(std::ceil(height * scale)), {}};
    const glm::dmat2 linear(scale * std::cos(angle), scale * std::sin(angle), -scale * std::sin(angle),
                            scale * std::cos(angle));
    const glm::dvec2 offset =
        0.5 * glm::dvec2(view.width, view.height) - linear * glm::dvec2(x + 0.5 * width, y + 0.5 * height);
    view.toPixels = glm::dmat3x2(linear[0], linear[1], offset);
    return view;
}

}  // namespace vtm::font
