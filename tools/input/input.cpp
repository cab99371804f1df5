#include "tools/input/input.hpp"

#include <algorithm>
#include <filesystem>
#include <span>

#include <unistd.h>

#include <vtm/asset/container.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/vtmtree.hpp>

namespace vtm::tools {

namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytesOf(const std::string& path) {
    return path == standardStream ? image::readStream(STDIN_FILENO, nameOf(path)) : image::readFile(path);
}

/// Text that may be XML, in any encoding, or gzip.
bool mayBeSvg(std::span<const std::uint8_t> file) {
    const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
    const bool gzip = bytes.starts_with("\x1f\x8b");
    const bool utf16 = bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff");
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    return gzip || utf16 || (first != bytes.npos && bytes[first] == '<');
}

}  // namespace

std::string nameOf(const std::string& input) { return input == standardStream ? "<stdin>" : input; }

std::string suffixOf(const std::string& path) {
    std::string suffix = fs::path(path).extension().string();
    std::ranges::transform(suffix, suffix.begin(),
                           [](char c) { return 'A' <= c && c <= 'Z' ? char(c + 32) : c; });
    return suffix;
}

bool Input::isAsset() const {
    if (asset::isContainer(bytes))
        return true;
    return suffixOf(name) == ".vtm" && !vtm::isTree(bytes) && !mayBeSvg(bytes);
}

bool Input::isTree() const {
    if (vtm::isTree(bytes))
        return true;
    return suffixOf(name) == ".vtmtree" && !asset::isContainer(bytes) && !mayBeSvg(bytes);
}

Input readInput(const std::string& path) {
    Input input;
    input.name = nameOf(path);
    // Of "-" that is the current folder.
    std::error_code none;
    input.folder = fs::absolute(path, none).parent_path().string();
    input.bytes = timed(input.stages, "read", [&] { return bytesOf(path); });
    return input;
}

}  // namespace vtm::tools
