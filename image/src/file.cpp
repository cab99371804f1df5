#include <filesystem>
#include <fstream>

#include "image/codec.hpp"

namespace vtm::image {

std::vector<std::uint8_t> readFile(const std::string& path) {
    if (std::filesystem::is_directory(path))
        throw CodecError(path + ": is a directory");
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0)
        throw CodecError(path + ": cannot be opened");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), size))
        throw CodecError(path + ": cannot be read");
    return bytes;
}

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    std::ofstream file(path, std::ios::binary);
    if (!file)
        throw CodecError(path + ": cannot be opened for writing");
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush())
        throw CodecError(path + ": cannot be written");
}

}  // namespace vtm::image
