#include "web/src/chunks.hpp"

#include <algorithm>
#include <new>
#include <string_view>

#include <zlib.h>

namespace vtm::web {

std::vector<std::uint8_t> difference(std::span<const std::uint8_t> bytes,
                                     std::span<const std::uint8_t> base) {
    std::vector<std::uint8_t> result(bytes.begin(), bytes.end());
    for (std::size_t i = 0; i < std::min(bytes.size(), base.size()); ++i)
        result[i] ^= base[i];
    return result;
}

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes) {
    uLongf size = compressBound(uLong(bytes.size()));
    std::vector<std::uint8_t> result(size);
    if (compress2(result.data(), &size, bytes.data(), uLong(bytes.size()), Z_BEST_COMPRESSION) != Z_OK)
        throw std::bad_alloc();  // with room for the bound nothing else can fail
    result.resize(size);
    return result;
}

std::vector<std::uint8_t> fromHexadecimal(std::string_view digits) {
    const auto value = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(std::uint8_t(value(digits[i]) << 4 | value(digits[i + 1])));
    return bytes;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

}  // namespace vtm::web
