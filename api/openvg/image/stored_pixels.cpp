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
    if (!copy_)
        return;
    readCopy().finish();
    if (mayChange)
        isCopyNewer_ = true;
}

PixelCopy& StoredPixels::readCopy() const {
    const std::lock_guard lock(mutex_);
    if (isMemoryNewer_) {
        copy_->take(pixels_);
        isMemoryNewer_ = false;
    }
    return *copy_;
}

PixelCopy& StoredPixels::writeCopy() {
    readCopy();
    isCopyNewer_ = true;
    return *copy_;
}

}  // namespace vtm::openvg
