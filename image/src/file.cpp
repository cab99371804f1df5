#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <vtm/image/codec.hpp>
#include "image/src/temporary.hpp"

namespace vtm::image {

namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

/// /proc's links lead to what is open, whatever name they show (/dev/stdout is one of them).
bool leadsToDescriptor(const fs::path& link) {
    struct statfs system {};
    return statfs(link.parent_path().c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
}

/// What symbolic links lead to, whether it exists or not.
fs::path followed(fs::path path) {
    constexpr int maxLinks = 40;  // as Linux has it
    std::error_code none;
    for (int i = 0; i < maxLinks && fs::is_symlink(path, none) && !leadsToDescriptor(path); ++i)
        path = path.parent_path() / fs::read_symlink(path);
    return path;
}

/// Nothing where there is no file; throws std::system_error where that cannot be told.
std::optional<struct stat> statusOf(const fs::path& path) {
    struct stat status {};
    if (lstat(path.c_str(), &status) == 0)
        return status;
    if (errno == ENOENT)
        return std::nullopt;
    throw std::system_error(errno, std::generic_category());
}

void writeThrough(const std::string& path, std::span<const std::uint8_t> bytes) {
    Descriptor file(path, O_WRONLY | O_TRUNC | O_NOCTTY);
    const int error = file ? writeStream(file.number(), bytes) : errno;
    if (error != 0)
        throw std::system_error(error, std::generic_category());
    if (const int late = file.close(); late != 0)
        throw std::system_error(late, std::generic_category());
}

void replace(const fs::path& target, const struct stat* old, std::span<const std::uint8_t> bytes) {
    if (old && faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0)
        throw std::system_error(errno, std::generic_category());
    // Nobody may read what replaces a private file, not even for a moment.
    Temporary file(target, old ? 0600 : 0666);
    if (old)
        file.takeOver(*old);
    file.write(bytes);
    file.takePlace();
}

}  // namespace

std::vector<std::uint8_t> readFile(const std::string& path) {
    if (fs::is_directory(path))
        throw CodecError(path + ": is a directory");
    const Descriptor file(path, O_RDONLY | O_NOCTTY);
    if (!file)
        throw CodecError(path + ": cannot be opened: " + reason(errno));
    return readStream(file.number(), path);
}

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) try {
    const fs::path target = followed(path);
    const std::optional<struct stat> old = statusOf(target);
    if (old && !S_ISREG(old->st_mode))
        writeThrough(path, bytes);
    else
        replace(target, old ? &*old : nullptr, bytes);
} catch (const std::system_error& error) {
    throw CodecError(path + ": cannot be written: " + error.what());
}

}  // namespace vtm::image
