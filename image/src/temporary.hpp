/// \file
/// A new file that takes another one's place, or goes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include <sys/stat.h>

namespace vtm::image {

/// An open file descriptor that is closed when it goes.
class Descriptor {
public:
    /// open(2), with O_CLOEXEC; invalid, with errno set, where it fails.
    Descriptor(const std::string& path, int flags, unsigned mode = 0);
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor();

    explicit operator bool() const { return number_ >= 0; }
    int number() const { return number_; }
    /// 0, or errno: some file systems report only here that the disk is full.
    int close();

private:
    int number_;
};

/// Throws std::system_error, which says what failed.
class Temporary {
public:
    /// Makes an empty one beside `target`; the umask goes off the mode.
    Temporary(const std::filesystem::path& target, mode_t mode);
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    /// Permissions, and as far as this process may, owner and group.
    void takeOver(const struct stat& old) noexcept;
    void write(std::span<const std::uint8_t> bytes);
    /// Onto the disk, then under the target's name.
    void takePlace();

private:
    std::filesystem::path target_, path_;
    int slot_;  ///< in the list that removeTemporaries() goes through, or -1
    Descriptor file_;
};

}  // namespace vtm::image
