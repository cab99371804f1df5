/// \file
/// A new file that takes another one's place, or goes.
#pragma once

#include <filesystem>
#include <span>

#include <sys/stat.h>

#include "image/src/descriptor.hpp"

namespace vtm::image {

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
