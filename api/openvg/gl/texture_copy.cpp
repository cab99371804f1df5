#include "api/openvg/gl/texture_copy.hpp"

#include "api/openvg/gl/layer_blocks.hpp"
#include "api/openvg/image/pixel_rows.hpp"

namespace vtm::openvg::gl {

namespace {

/// As texels, rows without gaps.
std::vector<std::uint8_t> texelsOf(const Pixels& pixels) {
    std::vector<std::uint8_t> bytes(std::size_t(pixels.width()) * std::size_t(pixels.height()) * 4);
    convertRows({pixels.at(0, 0), pixels.stride()}, pixels.format(), {bytes.data(), 4 * pixels.width()},
                texelFormat(pixels.format()), pixels.width(), pixels.height(), convertRow);
    return bytes;
}

Rectangle wholeOf(const Texture& texture) { return {0, 0, texture.width(), texture.height()}; }

/// Leaves the pixels as they are if the context is gone.
void download(Device& device, const Texture& texture, const Rectangle& part, Pixels& to) {
    std::vector<std::uint8_t> bytes(std::size_t(to.width()) * std::size_t(to.height()) * 4);
    if (device.download(texture, part, bytes.data()))
        convertRows({bytes.data(), 4 * to.width()}, texelFormat(to.format()), {to.at(0, 0), to.stride()},
                    to.format(), to.width(), to.height(), convertRow);
}

class TextureCopy final : public PixelCopy {
public:
    TextureCopy(Device& device, TexturePointer texture) : device_(device), texture_(std::move(texture)) {}

    void take(const Pixels& from) override { device_.upload(texture_, wholeOf(*texture_), texelsOf(from)); }
    void give(Pixels& to) override { download(device_, *texture_, wholeOf(*texture_), to); }
    void finish() override { device_.finish(); }
    TexturePointer texture() const override { return texture_; }

private:
    Device& device_;
    TexturePointer texture_;
};

/// Where there is room.
void ensureCopy(Device& device, StoredPixels& pixels) {
    // Images of several share groups may have the same pixels.
    static auto& mutex = *new std::mutex;
    const std::lock_guard lock(mutex);
    if (pixels.hasCopy())
        return;
    if (TexturePointer texture = device.makeTexture(GL_RGBA8, pixels.width(), pixels.height()))
        pixels.setCopy(std::make_unique<TextureCopy>(device, std::move(texture)));
}

}  // namespace

std::unique_ptr<PixelCopy> copyIn(Device& device, GLenum format, GLuint texture, int width, int height) {
    return std::make_unique<TextureCopy>(device, device.adoptTexture(format, texture, width, height));
}

TexturePointer readTexture(Device& device, const StoredPixels& pixels) {
    ensureCopy(device, const_cast<StoredPixels&>(pixels));
    return pixels.readTexture();
}

TexturePointer writeTexture(Device& device, StoredPixels& pixels) {
    ensureCopy(device, pixels);
    return pixels.writeTexture();
}

void readPart(Device& device, const StoredPixels& pixels, const Rectangle& part, Pixels& to) {
    download(device, *readTexture(device, pixels), part, to);
}

void writePart(Device& device, StoredPixels& pixels, const Rectangle& part, const Pixels& from) {
    device.upload(writeTexture(device, pixels), part, texelsOf(from));
}

TexturePointer maskTexture(Device& device, const MaskValues& mask) {
    if (!mask.texture) {
        TexturePointer texture = device.makeTexture(GL_R8, mask.width, mask.height);
        if (!texture)
            return nullptr;
        device.upload(texture, wholeOf(*texture), mask.values());
        mask.texture = std::move(texture);
    }
    return mask.texture;
}

}  // namespace vtm::openvg::gl
