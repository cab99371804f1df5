/// \file
/// Reading and writing picture files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vtm/error.hpp>
#include <vtm/image/bitmap.hpp>

#pragma GCC visibility push(default)

namespace vtm::image {

/// The encoded data or the file is invalid or inaccessible; the message says why.
class CodecError : public Error {
    using Error::Error;
};

/// Limit on decoded pixels: width * height beyond it is an error before anything is allocated.
inline constexpr std::int64_t maxDecodedPixels = 1 << 26;

/// PNG, JPEG, WebP, GIF (first frame) or AVIF (where libavif is installed), told apart by their signatures.
Bitmap decode(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> encodePng(const Bitmap& bitmap);

/// Reads a file, or a pipe or device to its end; more than maxStreamBytes from these is an error. Throws
/// CodecError, which names the path.
std::vector<std::uint8_t> readFile(const std::string& path);
/// The same from an open descriptor; errors call it `name`.
std::vector<std::uint8_t> readStream(int descriptor, const std::string& name);
inline constexpr std::size_t maxStreamBytes = 256u << 20;  ///< as long as an SVG file may be

/// Writes a regular file whole or not at all: into a new file beside it (".vtm-tmp-PID-N"), which is flushed
/// to the disk and then takes its place. After an error, or however the process ends, the file is what it was
/// or what it should become. Permissions are kept, owner and group where that is allowed; a new file has 0666
/// less the umask. Symbolic links are followed and stay. Other hard links keep the old content. What is no
/// regular file (devices, pipes) is written through. The folder must be writable: a file that could only be
/// overwritten in place is an error. Errors name the path. Where files may be too large for the process,
/// ignore SIGXFSZ to get an error.
void writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// Writes all bytes to an open descriptor. Returns 0, or errno.
[[nodiscard]] int writeStream(int descriptor, std::span<const std::uint8_t> bytes) noexcept;

/// Removes the temporary files of writeFile calls in progress, which then fail. Async-signal-safe, for
/// handlers of signals that end the process.
void removeTemporaries() noexcept;

}  // namespace vtm::image

#pragma GCC visibility pop
