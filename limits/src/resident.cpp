// How much memory the process holds now. A peak (ru_maxrss) would fail every later picture of a batch.
#include <cstdio>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <vtm/limits/limits.hpp>

namespace vtm::limits {
namespace {

/// The second number of /proc/self/statm, in pages; 0 where there is no /proc.
std::size_t residentPages() {
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return 0;
    char text[64] = {};
    const ssize_t count = read(file, text, sizeof text - 1);
    close(file);
    unsigned long size = 0, resident = 0;
    return count > 0 && std::sscanf(text, "%lu %lu", &size, &resident) == 2 ? resident : 0;
}

std::size_t allocatedBytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

}  // namespace

std::size_t residentBytes() {
    static const auto pageBytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t pages = residentPages();
    return pages > 0 ? pages * pageBytes : allocatedBytes();
}

}  // namespace vtm::limits
