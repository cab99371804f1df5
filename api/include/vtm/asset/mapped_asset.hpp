/// \file
/// A `.vtm` file mapped into memory.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include <vtm/asset/container.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// Maps a file read-only and validates it; its records are used where they lie, none is copied. Pictures
/// (Asset::images) are the exception: they are decoded. The file must not be changed while it is mapped:
/// the system would show the change behind the validator's back, and end the process where a file
/// became shorter. Write a new file and rename it over the old one.
class MappedAsset {
public:
    /// Throws FormatError, or std::system_error if the file cannot be opened or mapped.
    explicit MappedAsset(const std::string& path);
    MappedAsset(MappedAsset&&) noexcept;
    MappedAsset& operator=(MappedAsset&&) noexcept;
    ~MappedAsset();

    /// Valid as long as this object, wherever it is moved.
    const AssetView& view() const;
    /// The whole file.
    std::span<const std::uint8_t> bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace vtm::asset

#pragma GCC visibility pop
