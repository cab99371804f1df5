#include "svg/xml/resource.hpp"

#include <algorithm>
#include <filesystem>

#include <vtm/image/codec.hpp>
#include "image/base64.hpp"
#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (isDigit(c))
        return c - '0' + 52;
    if (c == '+' || c == '-')
        return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

/// RFC 4648, both alphabets, white space allowed anywhere.
std::vector<std::uint8_t> decodeBase64(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    unsigned buffer = 0;
    int bits = 0;
    for (const char c : text) {
        if (isSpace(c))
            continue;
        if (c == '=')
            break;
        const int digit = base64Digit(c);
        if (digit < 0)
            throw image::CodecError("the base64 data is malformed");
        buffer = buffer << 6 | static_cast<unsigned>(digit);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::uint8_t>(buffer >> bits & 0xff));
        }
    }
    return bytes;
}

bool liesBelow(const std::filesystem::path& file, const std::filesystem::path& folder) {
    std::error_code fileError, folderError;
    const auto real = std::filesystem::weakly_canonical(file, fileError),
               top = std::filesystem::weakly_canonical(folder, folderError);
    if (fileError || folderError)
        return false;
    const auto relative = real.lexically_relative(top);
    return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

bool isDataUrl(std::string_view href) { return equalsIgnoringCase(href.substr(0, 5), "data:"); }

std::string percentDecoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape =
            text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0;
        decoded.push_back(escape ? static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]))
                                 : text[i]);
        i += escape ? 2 : 0;
    }
    return decoded;
}

std::string dataUrl(std::string_view type, std::span<const std::uint8_t> bytes) {
    return "data:" + std::string(type) + ";base64," + image::base64(bytes);
}

std::vector<std::uint8_t> decodeDataUrl(std::string_view href) {
    const std::size_t comma = href.find(',');
    if (comma == href.npos)
        throw image::CodecError("the data URL has no data");
    const std::string decoded = percentDecoded(href.substr(comma + 1));
    if (trim(href.substr(0, comma)).ends_with("base64"))
        return decodeBase64(decoded);
    return {decoded.begin(), decoded.end()};
}

std::vector<std::uint8_t> readResource(std::string_view href, const std::string& directory,
                                       const std::string& root) {
    if (isDataUrl(href))
        return decodeDataUrl(href);
    const std::string path = percentDecoded(href.substr(0, href.find_first_of("#?")));
    if (path.empty() || directory.empty() || path.find(':') != path.npos || path.front() == '/')
        throw image::CodecError("is not a file that may be read");
    const std::filesystem::path file = std::filesystem::path(directory) / path;
    if (!root.empty() && !liesBelow(file, root))
        throw image::CodecError("is outside of the folder in which files may be read");
    std::error_code none;
    // Reading a pipe or a device may never end.
    if (std::filesystem::exists(file, none) && !std::filesystem::is_regular_file(file, none))
        throw image::CodecError("is not a regular file");
    return image::readFile(file.string());
}

}  // namespace vtm::svg
