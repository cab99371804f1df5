// A terminal of 200 × 60 cells on a screen that leans back: terminal FONT TEXT OUT.png
//
// A cell takes one byte for its character and one for its colour. When the text changes, only these are sent.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <vtm/font/typesetter.hpp>
#include <vtm/gl/text_texture.hpp>
#include <vtm/image/codec.hpp>
#include "examples/stage.hpp"

using namespace vtm;
using glm::vec3;

namespace {

constexpr unsigned columns = 200, rows = 60, newspaperColumns = 2;

enum Ink : std::uint8_t { Plain, Comment, Text, Number, Mark };

const std::vector<font::Color> inks{{0.86f, 0.88f, 0.84f, 1},
                                    {0.45f, 0.55f, 0.5f, 1},
                                    {0.93f, 0.75f, 0.42f, 1},
                                    {0.55f, 0.8f, 0.95f, 1},
                                    {0.95f, 0.5f, 0.45f, 1}};

bool isOneOf(char32_t c, const char* set) {
    return c < 128 && std::string(set).find(char(c)) != std::string::npos;
}

/// Colours of one line of C++, more or less.
std::vector<std::uint8_t> inksOf(const std::u32string& line) {
    std::vector<std::uint8_t> result(line.size(), Plain);
    bool inText = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (!inText && line.compare(i, 2, U"//") == 0) {
            std::fill(result.begin() + long(i), result.end(), std::uint8_t(Comment));
            break;
        }
        const bool isQuote = line[i] == U'"';
        inText = inText != isQuote;
        if (inText || isQuote)
            result[i] = Text;
        else if (isOneOf(line[i], "0123456789"))
            result[i] = Number;
        else if (isOneOf(line[i], "{}()[]<>=+-*/&|!?:;,."))
            result[i] = Mark;
    }
    return result;
}

/// Two columns of the text's lines, from line `first` on.
font::CellText screenOf(const std::vector<std::u32string>& lines, std::size_t first) {
    font::CellText screen;
    screen.columns = columns;
    screen.rows = rows;
    screen.text.assign(std::size_t(columns) * rows, U' ');
    screen.colors.assign(std::size_t(columns) * rows, Plain);
    screen.palette = inks;
    screen.ground = {0.06f, 0.08f, 0.09f, 1};
    constexpr unsigned room = columns / newspaperColumns;
    for (unsigned i = 0; i < rows * newspaperColumns && first + i < lines.size(); ++i) {
        const std::u32string& line = lines[first + i];
        const std::vector<std::uint8_t> colors = inksOf(line);
        const std::size_t at = std::size_t(i % rows) * columns + i / rows * room + 1;
        for (std::size_t c = 0; c < std::min<std::size_t>(line.size(), room - 2); ++c) {
            screen.text[at + c] = line[c];
            screen.colors[at + c] = colors[c];
        }
    }
    return screen;
}

std::vector<std::u32string> linesOf(const std::u32string& text) {
    std::vector<std::u32string> lines(1);
    for (const char32_t c : text)
        if (c == U'\n')
            lines.emplace_back();
        else
            lines.back() += c;
    return lines;
}

void drawTerminal(const std::string& fontFile, const std::u32string& text, const std::string& out) {
    const gl::Context context;
    font::FontMaps font(image::readFile(fontFile));
    const std::vector<std::u32string> lines = linesOf(text);
    asset::TextPage page = font::Typesetter::cells(font, screenOf({}, 0));
    gl::TextTexture texture(font.asset(), {page});
    page = font::Typesetter::cells(font, screenOf(lines, 0));
    texture.update(0, page, font.asset());
    std::printf("%u x %u cells: %zu bytes, and a font of %zu bytes\n", columns, rows, texture.bytes(0),
                texture.fontBytes());

    const GLuint program = stage::program(gl::textInclude(), R"(
uniform Vtm screen;
void main() { color = vtm_sample(screen, st); })");
    stage::Canvas picture(960, 640, {0.16f, 0.17f, 0.2f});
    const glm::mat4 camera = glm::perspective(glm::radians(36.0f), picture.aspect(), 0.05f, 50.0f) *
                             glm::lookAt(vec3(-0.6f, 0.15f, 1.95f), vec3(-0.08f, -0.02f, 0), vec3(0, 1, 0));
    texture.bind(program, "screen", 0, 0);
    stage::draw(program, camera, {{-1, 0.62f, -0.25f}, {2, 0, 0}, {0, -1.24f, 0.35f}});
    picture.save(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: terminal FONT TEXT OUT.png\n");
        return 2;
    }
    try {
        const auto bytes = image::readFile(argv[2]);
        drawTerminal(argv[1], font::fromUtf8({reinterpret_cast<const char*>(bytes.data()), bytes.size()}),
                     argv[3]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "terminal: %s\n", error.what());
        return 1;
    }
    return 0;
}
