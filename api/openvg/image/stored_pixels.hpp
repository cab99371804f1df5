/// \file
/// Pixels that are in memory, on a GPU, or both: they are moved when the other side asks for them.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "api/openvg/image/pixels.hpp"

namespace vtm::openvg {

namespace gl {
class Texture;
}

/// Pixels outside of memory.
class PixelCopy {
public:
    virtual ~PixelCopy() = default;
    /// Takes pixels from memory, or brings them there. Both have the size and the format of the copy.
    virtual void take(const Pixels& from) = 0;
    virtual void give(Pixels& to) = 0;
    /// Ends what was begun for it: other APIs may use it then.
    virtual void finish() = 0;
    /// What the compositor of GPUs draws from and into; null: it cannot.
    virtual std::shared_ptr<const gl::Texture> texture() const = 0;
};

/// One thread changes pixels at a time; any number may read them.
class StoredPixels {
public:
    explicit StoredPixels(Pixels pixels) : pixels_(std::move(pixels)) {}

    int width() const { return pixels_.width(); }
    int height() const { return pixels_.height(); }
    const PixelFormat& format() const { return pixels_.format(); }
    std::ptrdiff_t stride() const { return pixels_.stride(); }

    /// In memory, as they are now.
    const Pixels& read() const {
        if (isCopyNewer_)
            bringBack();
        return pixels_;
    }
    /// The same, to be changed.
    Pixels& write() {
        if (isCopyNewer_)
            bringBack();
        if (copy_)
            isMemoryNewer_ = true;
        return pixels_;
    }
    /// Other pixels, of any size.
    void replace(Pixels pixels);

    bool hasCopy() const { return copy_ != nullptr; }
    /// As they are now; they may be in both places.
    bool areInMemory() const { return !isCopyNewer_; }
    bool areInTexture() const;
    /// Keeps a copy from now on, which has no pixels yet.
    void setCopy(std::unique_ptr<PixelCopy> copy);
    /// Keeps a copy from now on that has the pixels, and that others change too.
    void share(std::unique_ptr<PixelCopy> copy);
    /// What was changed goes into the copy. `mayChange`: then the others have it.
    void handOver(bool mayChange);
    /// The copy's texture, up to date, to be read; null: there is none.
    std::shared_ptr<const gl::Texture> readTexture() const;
    /// The same, to be changed.
    std::shared_ptr<const gl::Texture> writeTexture();

private:
    void bringBack() const;
    void takeMemory() const;

    mutable std::mutex mutex_;
    mutable Pixels pixels_;
    std::unique_ptr<PixelCopy> copy_;
    mutable std::atomic<bool> isCopyNewer_ = false, isMemoryNewer_ = false;
};

}  // namespace vtm::openvg
