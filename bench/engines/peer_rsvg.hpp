/// \file
/// librsvg, which draws with cairo in memory, as a peer.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>

namespace vtm::bench {

/// "librsvg 1.2.3 with cairo 1.2.3"; nothing where we were built without it.
std::optional<std::string> rsvgVersion();

/// What librsvg refused, or that it is missing.
class RsvgError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A parsed file.
class Rsvg {
public:
    /// RsvgError where it cannot be read. `width` and `height`: the picture's, user units.
    Rsvg(const std::filesystem::path& path, double width, double height);
    ~Rsvg();
    Rsvg(Rsvg&&) noexcept;
    Rsvg& operator=(Rsvg&&) noexcept;

    /// Into an image of the view's size, which is kept for the next call and cleared first.
    void draw(const asset::View& view);
    /// What the last call drew.
    image::Bitmap pixels() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::bench
