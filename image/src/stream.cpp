// What is read and written piece by piece: pipes, devices, files of any size.

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vtm/image/codec.hpp>

namespace vtm::image {

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

}  // namespace vtm::image
