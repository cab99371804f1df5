// A book of a hundred pages, open and tilted: book FONT TEXT... OUT.png
//
// The font's glyphs are compiled once; a page is a table of eight bytes a character, and one shader draws all
// of them, at any angle and zoom. The texts are set one after the other, from the start again until the book
// is full.

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

constexpr std::size_t pageCount = 100;
constexpr double width = 420, height = 600, margin = 48;

constexpr const char* paper = R"(
uniform Vtm page;
uniform float gutter;  // s at which the pages meet
void main() {
    vec4 c = vtm_sample(page, st);
    float shade = 0.72 + 0.28 * smoothstep(0.0, 0.18, abs(st.x - gutter));
    color = vec4(c.rgb * shade, 1.0);
}
)";

/// Lines of a paragraph as one: those of Markdown are broken where its author liked.
std::u32string paragraphsOf(const std::u32string& lines) {
    std::u32string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const char32_t next = i + 1 < lines.size() ? lines[i + 1] : U'\n';
        const bool isJoined = lines[i] == U'\n' &&
                              std::u32string_view(U"\n#-|*").find(next) == std::u32string::npos &&
                              !text.empty() && text.back() != U'\n';
        text += isJoined ? U' ' : lines[i];
    }
    return text;
}

struct Book {
    std::vector<asset::TextPage> pages;
    std::size_t characters = 0;
};

Book setBook(font::FontMaps& font, const std::u32string& text) {
    Book book;
    std::size_t at = 0;
    while (book.pages.size() < pageCount) {
        font::Typesetter setter(font, width, height, {0.98f, 0.965f, 0.93f, 1});
        const std::u32string number = font::fromUtf8(std::to_string(book.pages.size() + 1));
        setter.add(number, {margin, height - 36, width - 2 * margin, 20},
                   {.size = 10, .color = {0.45f, 0.4f, 0.35f, 1}, .align = font::Align::Center});
        const std::size_t set =
            setter.add(std::u32string_view(text).substr(at),
                       {margin, margin, width - 2 * margin, height - 2 * margin}, {.size = 9});
        book.characters += set;
        at = at + set >= text.size() ? 0 : at + set;
        book.pages.push_back(setter.page());
    }
    return book;
}

void drawBook(const std::string& fontFile, const std::u32string& text, const std::string& out) {
    const gl::Context context;
    font::FontMaps font(image::readFile(fontFile));
    const Book book = setBook(font, text);
    gl::TextTexture texture(font.asset(), book.pages);

    std::size_t bytes = 0;
    for (std::size_t i = 0; i < texture.pages(); ++i)
        bytes += texture.bytes(i);
    std::printf("%zu pages, %zu characters: %.2f bytes each, and a font of %zu bytes\n", texture.pages(),
                book.characters, double(bytes) / double(book.characters), texture.fontBytes());

    const GLuint program = stage::program(gl::textInclude(), paper);
    stage::Canvas picture(960, 640, {0.36f, 0.29f, 0.24f});
    const glm::mat4 camera = glm::perspective(glm::radians(34.0f), picture.aspect(), 0.05f, 50.0f) *
                             glm::lookAt(vec3(0.35f, 1.75f, 2.1f), vec3(0, 0, 0.08f), vec3(0, 1, 0));
    // One page after the other, the later ones turned less: the left half lies flat, the right one fans out.
    const auto drawPage = [&](std::size_t page, float angle, bool isLeft) {
        const vec3 along(std::cos(angle), std::sin(angle), 0);
        glUseProgram(program);
        glUniform1f(glGetUniformLocation(program, "gutter"), isLeft ? 1.0f : 0.0f);
        texture.bind(program, "page", 0, page, {asset::Wrap::Clamp, asset::Wrap::Clamp});
        const vec3 spine(0, 0, -0.7f), down(0, 0, 1.4f);
        stage::draw(program, camera,
                    isLeft ? stage::Quad{spine - along, along, down} : stage::Quad{spine, along, down});
    };
    drawPage(40, 0, true);
    for (const auto& [page, angle] : {std::pair<std::size_t, float>(99, 0.0f), {67, 0.22f}, {43, 0.5f}})
        drawPage(page, angle, false);
    picture.save(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: book FONT TEXT... OUT.png\n");
        return 2;
    }
    try {
        std::u32string text;
        for (int i = 2; i < argc - 1; ++i) {
            const auto bytes = image::readFile(argv[i]);
            text += font::fromUtf8({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        }
        if (text.empty())
            throw std::runtime_error("the texts are empty");
        drawBook(argv[1], paragraphsOf(text), argv[argc - 1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "book: %s\n", error.what());
        return 1;
    }
    return 0;
}
