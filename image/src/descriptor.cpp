#include "image/src/descriptor.hpp"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

namespace vtm::image {

Descriptor::Descriptor(const std::string& path, int flags, unsigned mode)
    : number_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}

Descriptor::~Descriptor() { close(); }

int Descriptor::close() {
    const int number = std::exchange(number_, -1);
    return number >= 0 && ::close(number) != 0 ? errno : 0;
}

}  // namespace vtm::image
