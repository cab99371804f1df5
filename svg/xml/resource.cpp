#include "svg/xml/resource.hpp"

#include <filesystem>

#include <vtm/image/codec.hpp>
#include "svg/xml/data_url.hpp"

namespace vtm::svg {

std::vector<std::uint8_t> readResource(std::string_view href, const std::string& directory) {
    if (isDataUrl(href))
        return decodeDataUrl(href);
    const std::string path = percentDecoded(href.substr(0, href.find_first_of("#?")));
    if (path.empty() || directory.empty() || path.find(':') != path.npos || path.front() == '/')
        throw image::CodecError("is not a file that may be read");
    const std::filesystem::path file = std::filesystem::path(directory) / path;
    std::error_code none;
    // Reading a pipe or a device may never end.
    if (std::filesystem::exists(file, none) && !std::filesystem::is_regular_file(file, none))
        throw image::CodecError("is not a regular file");
    return image::readFile(file.string());
}

}  // namespace vtm::svg
