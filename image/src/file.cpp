// What is read and written piece by piece, pipes, devices and files of any size; and files, which are
// replaced as a whole.

#include <fcntl.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>

#include <vtm/image/codec.hpp>
#include "image/src/temporary.hpp"

namespace vtm::image {

// ---- Streams ------------------------------------------------------------------------------------

namespace {

/// Bytes that are made room for at first where the size is not known.
constexpr std::size_t portion = 1 << 16;

/// Whether the call should be made again: it was interrupted, or somebody made the descriptor non-blocking
/// and it is ready now.
bool again(int descriptor, short event) {
    if (errno == EINTR)
        return true;
    pollfd wanted{descriptor, event, 0};
    return (errno == EAGAIN || errno == EWOULDBLOCK) && poll(&wanted, 1, -1) >= 0;
}

/// Of a regular file; else 0.
std::size_t expectedSize(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) ? std::size_t(status.st_size) : 0;
}

}  // namespace

std::vector<std::uint8_t> readStream(int descriptor, const std::string& name) {
    const std::size_t expected = expectedSize(descriptor), maximum = std::max(expected, maxStreamBytes);
    // One byte more, so that the end is seen without growing.
    std::vector<std::uint8_t> bytes(expected > 0 ? expected + 1 : portion);
    std::size_t end = 0;
    for (ssize_t count = -1; count != 0;) {
        if (end == bytes.size())
            bytes.resize(end + end / 2);
        count = read(descriptor, &bytes[end], bytes.size() - end);
        if (count < 0 && !again(descriptor, POLLIN))
            throw CodecError(name + ": cannot be read: " + std::generic_category().message(errno));
        end += count > 0 ? std::size_t(count) : 0;
        if (end > maximum)
            throw CodecError(name + ": is longer than " + std::to_string(maximum >> 20) + " MiB");
    }
    bytes.resize(end);
    return bytes;
}

int writeStream(int descriptor, std::span<const std::uint8_t> bytes) noexcept {
    while (!bytes.empty()) {
        const ssize_t count = write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && !again(descriptor, POLLOUT))
            return errno;
        bytes = bytes.subspan(count > 0 ? std::size_t(count) : 0);
    }
    return 0;
}

// ---- Files --------------------------------------------------------------------------------------

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
