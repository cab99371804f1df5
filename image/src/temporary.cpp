#include "image/src/temporary.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdint>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <vtm/image/codec.hpp>

namespace vtm::image {

namespace {

namespace fs = std::filesystem;

/// Paths of the temporaries that there are, where a signal handler may read them. One more than there are
/// places is left behind by a signal.
struct Slot {
    std::atomic_flag taken;
    std::atomic<bool> filled = false;
    std::array<char, PATH_MAX> path{};
};
std::array<Slot, 16> slots;

int enlist(const std::string& path) {
    for (std::size_t i = 0; path.size() < PATH_MAX && i < slots.size(); ++i)
        if (!slots[i].taken.test_and_set()) {
            std::strcpy(slots[i].path.data(), path.c_str());
            slots[i].filled = true;
            return int(i);
        }
    return -1;
}

void strike(int slot) {
    if (slot < 0)
        return;
    slots[std::size_t(slot)].filled = false;
    slots[std::size_t(slot)].taken.clear();
}

[[noreturn]] void fail(const char* what, int error) {
    throw std::system_error(error, std::generic_category(), what);
}

void require(int error, const char* what) {
    if (error != 0)
        fail(what, error);
}

/// 0, or errno. Some file systems and devices know no fsync.
int flushed(const Descriptor& file) {
    return fsync(file.number()) == 0 || errno == EINVAL || errno == ENOSYS || errno == EROFS ? 0 : errno;
}

fs::path folderOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A name that nobody had before: by process and moment.
std::string freshName() {
    static std::atomic<std::int64_t> moment = std::chrono::system_clock::now().time_since_epoch().count();
    return ".vtm-tmp-" + std::to_string(getpid()) + "-" + std::to_string(moment++);
}

}  // namespace

Descriptor::Descriptor(const std::string& path, int flags, unsigned mode)
    : number_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}

Descriptor::~Descriptor() { close(); }

int Descriptor::close() {
    const int number = std::exchange(number_, -1);
    return number >= 0 && ::close(number) != 0 ? errno : 0;
}

Temporary::Temporary(const fs::path& target, mode_t mode)
    // Listed before it is there, or a signal in between would leave it behind.
    : target_(target),
      path_(folderOf(target) / freshName()),
      slot_(enlist(path_.string())),
      file_(path_.string(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, mode) {
    if (file_)
        return;
    const int error = errno;
    strike(slot_);
    fail("cannot create a temporary file in its directory", error);
}

Temporary::~Temporary() {
    if (!path_.empty())
        unlink(path_.c_str());
    strike(slot_);
}

void Temporary::takeOver(const struct stat& old) noexcept {
    const int file = file_.number();
    struct stat own {};
    fstat(file, &own);
    mode_t mode = old.st_mode & 0777;
    const bool sameOwner = own.st_uid == old.st_uid && own.st_gid == old.st_gid;
    if (!sameOwner && fchown(file, old.st_uid, old.st_gid) != 0 && fchown(file, uid_t(-1), old.st_gid) != 0)
        mode = (mode & ~mode_t(070)) | (mode & 07) << 3;  // another group gets no more than all others
    if ((own.st_mode & 0777) != mode)
        (void)!fchmod(file, mode);  // where that fails, the file system has no permissions of its own
}

void Temporary::write(std::span<const std::uint8_t> bytes) {
    require(writeStream(file_.number(), bytes), "writing failed");
}

void Temporary::takePlace() {
    require(flushed(file_), "writing failed");
    require(file_.close(), "writing failed");
    if (rename(path_.c_str(), target_.c_str()) != 0)
        fail("cannot replace it", errno);
    path_.clear();
    // A folder that cannot be read is not flushed; the file is whole.
    if (const Descriptor folder(folderOf(target_).string(), O_RDONLY | O_DIRECTORY); folder)
        require(flushed(folder), "cannot flush its directory");
}

void removeTemporaries() noexcept {
    for (const Slot& slot : slots)
        if (slot.filled)
            unlink(slot.path.data());
}

}  // namespace vtm::image
