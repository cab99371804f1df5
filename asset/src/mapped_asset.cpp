#include <vtm/asset/mapped_asset.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "asset/src/container_read.hpp"

namespace vtm::asset {

namespace {

[[noreturn]] void fail(const std::string& path) {
    throw std::system_error(errno, std::generic_category(), path);
}

/// Closed as soon as the file is mapped: the mapping stays.
class Descriptor {
public:
    explicit Descriptor(const std::string& path) : value_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
        if (value_ < 0)
            fail(path);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(value_); }
    int get() const { return value_; }

private:
    int value_;
};

class Mapping {
public:
    explicit Mapping(const std::string& path) {
        const Descriptor file(path);
        struct stat status {};
        if (fstat(file.get(), &status) != 0)
            fail(path);
        size_ = std::size_t(status.st_size);
        if (size_ == 0)  // cannot be mapped; the reader says what is wrong with it
            return;
        start_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.get(), 0);
        if (start_ == MAP_FAILED)
            fail(path);
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping() {
        if (size_ > 0)
            munmap(start_, size_);
    }
    std::span<const std::uint8_t> bytes() const { return {static_cast<const std::uint8_t*>(start_), size_}; }

private:
    void* start_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace

struct MappedAsset::State {
    explicit State(const std::string& path) : mapping(path), contents(openContents(mapping.bytes())) {}

    Mapping mapping;
    Contents contents;
};

MappedAsset::MappedAsset(const std::string& path) : state_(std::make_unique<State>(path)) {}
MappedAsset::MappedAsset(MappedAsset&&) noexcept = default;
MappedAsset& MappedAsset::operator=(MappedAsset&&) noexcept = default;
MappedAsset::~MappedAsset() = default;

const AssetView& MappedAsset::view() const { return state_->contents.view; }
std::span<const std::uint8_t> MappedAsset::bytes() const { return state_->mapping.bytes(); }

}  // namespace vtm::asset
