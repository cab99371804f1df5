#include "bench/input/text_pages.hpp"

#include <algorithm>
#include <cstdint>
#include <random>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include "text/font_set.hpp"

namespace vtm::bench {
namespace {

constexpr int lines = 50, lineCharacters = 100;
constexpr double fontSize = 16, lineHeight = 20;
constexpr double width = 1024, height = (lines + 1) * lineHeight;

struct Page {
    const char* name;
    std::vector<std::string> families;  ///< of the lines, in turns
    std::vector<std::string> letters;   ///< UTF-8, a character each
    const char* direction = "ltr";
    int longestWord = 9;
    bool placed = false;  ///< an x for every character
};

std::vector<std::string> charactersFrom(char32_t first, int count) {
    std::vector<std::string> characters;
    for (char32_t c = first; c < first + char32_t(count); ++c)
        if (c < 0x800)
            characters.push_back({char(0xc0 | c >> 6), char(0x80 | (c & 63))});
        else
            characters.push_back({char(0xe0 | c >> 12), char(0x80 | (c >> 6 & 63)), char(0x80 | (c & 63))});
    return characters;
}

/// English letters, about as often as in English.
std::vector<std::string> latin() {
    std::vector<std::string> letters;
    for (const char c : std::string("eeeeeetttttaaaaooooiiinnnsssrrrhhhlllddduuccmmffyywwggppbbvvkxqjzTAMW"))
        letters.push_back({c});
    return letters;
}

std::vector<Page> pages() {
    const std::vector<std::string> three{"DejaVu Serif", "DejaVu Sans", "DejaVu Sans Mono"};
    return {{"three fonts", three, latin()},
            {"each character placed", three, latin(), "ltr", 9, true},
            {"Arabic", {"Amiri"}, charactersFrom(0x628, 19), "rtl"},
            {"Chinese", {"WenQuanYi Micro Hei"}, charactersFrom(0x4e00, 1500), "ltr", lineCharacters}};
}

std::string svgOf(const Page& page) {
    std::mt19937 random(5000);
    const auto below = [&](std::size_t end) { return random() % end; };
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-size=\"{2}\">\n",
        width, height, fontSize);
    for (int line = 0; line < lines; ++line) {
        std::string text, places;
        std::size_t left = 0;
        for (int i = 0; i < lineCharacters; ++i) {
            if (left == 0)
                left = 2 + below(std::size_t(page.longestWord));
            text += --left == 0 && i > 0 && i + 1 < lineCharacters ? " "
                                                                   : page.letters[below(page.letters.size())];
            places += fmt::format(" {:.2f}", 8 + i * 10 + double(below(100)) / 100);
        }
        const std::string x = page.placed ? places.substr(1) : page.direction[0] == 'r' ? "1016" : "8";
        svg += fmt::format("<text x=\"{}\" y=\"{}\" direction=\"{}\" font-family=\"{}\">{}</text>\n", x,
                           (line + 1) * lineHeight, page.direction,
                           page.families[std::size_t(line) % page.families.size()], text);
    }
    return svg + "</svg>\n";
}

}  // namespace

std::vector<File> writeTextPages(const std::filesystem::path& folder, std::vector<std::string>& notes) {
    const vtm::text::FontSet fonts({});
    std::vector<File> files;
    for (const Page& page : pages()) {
        const auto absent = std::ranges::find_if_not(
            page.families, [&](const std::string& family) { return fonts.hasFamily(family); });
        if (absent != page.families.end()) {
            notes.push_back(fmt::format("missing: the font {}, for the page `{}`.", *absent, page.name));
            continue;
        }
        const std::string svg = svgOf(page);
        const auto path = folder / fmt::format("page{}.svg", files.size());
        image::writeFile(path.string(), {reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()});
        files.push_back({page.name, path});
    }
    return files;
}

}  // namespace vtm::bench
