#include "api/openvg/image/stored_pixels.hpp"

namespace vtm::openvg {

void StoredPixels::bringBack() const {
    const std::lock_guard lock(mutex_);
    if (!isCopyNewer_)
        return;
    copy_->give(pixels_);
    isCopyNewer_ = false;
}

void StoredPixels::replace(Pixels pixels) {
    const std::lock_guard lock(mutex_);
    pixels_ = std::move(pixels);
    copy_ = nullptr;
    isCopyNewer_ = isMemoryNewer_ = false;
}

void StoredPixels::setCopy(std::unique_ptr<PixelCopy> copy) {
    read();
    const std::lock_guard lock(mutex_);
    copy_ = std::move(copy);
    isMemoryNewer_ = copy_ != nullptr;
}

void StoredPixels::share(std::unique_ptr<PixelCopy> copy) {
    const std::lock_guard lock(mutex_);
    copy_ = std::move(copy);
    isCopyNewer_ = true;
    isMemoryNewer_ = false;
}

void StoredPixels::handOver(bool mayChange) {
    const std::lock_guard lock(mutex_);
    if (!copy_)
        return;
    takeMemory();
    copy_->finish();
    if (mayChange)
        isCopyNewer_ = true;
}

bool StoredPixels::areInTexture() const {
    const std::lock_guard lock(mutex_);
    return copy_ && !isMemoryNewer_ && copy_->texture();
}

std::shared_ptr<const gl::Texture> StoredPixels::readTexture() const {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const gl::Texture> texture = copy_ ? copy_->texture() : nullptr;
    if (texture)
        takeMemory();
    return texture;
}

std::shared_ptr<const gl::Texture> StoredPixels::writeTexture() {
    std::shared_ptr<const gl::Texture> texture = readTexture();
    if (texture)
        isCopyNewer_ = true;
    return texture;
}

/// With the lock held.
void StoredPixels::takeMemory() const {
    if (isMemoryNewer_)
        copy_->take(pixels_);
    isMemoryNewer_ = false;
}

}  // namespace vtm::openvg
