/// \file
/// An open file descriptor that is closed when it goes.
#pragma once

#include <string>
#include <utility>

namespace vtm::image {

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

}  // namespace vtm::image
