#include "text/utf8.hpp"

#include <array>
#include <cstddef>

namespace vtm::text {
namespace {

constexpr char32_t replacement = 0xfffd;
/// The smallest character that needs so many bytes: what is longer than it must be is malformed.
constexpr std::array<char32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};

bool isCharacter(char32_t code) { return code <= 0x10ffff && (code < 0xd800 || code > 0xdfff); }

}  // namespace

char32_t readCharacter(std::string_view& utf8) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(utf8[i]); };
    const unsigned char lead = byte(0);
    const std::size_t size = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    char32_t code = size == 1 ? lead : lead & (0xff >> (size + 1));
    bool valid = lead < 0x80 || (lead >= 0xc2 && lead <= 0xf4);
    for (std::size_t i = 1; valid && i < size; ++i) {
        valid = i < utf8.size() && (byte(i) & 0xc0) == 0x80;
        code = valid ? code << 6 | (byte(i) & 0x3f) : code;
    }
    valid = valid && code >= smallest[size] && isCharacter(code);
    utf8.remove_prefix(valid ? size : 1);
    return valid ? code : replacement;
}

}  // namespace vtm::text
