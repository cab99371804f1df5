#include <algorithm>
#include <new>
#include <string_view>

#include <webp/decode.h>
#include <webp/encode.h>

#include <vtm/image/codec.hpp>
#include <vtm/limits/limits.hpp>
#include "image/src/formats.hpp"

namespace vtm::image {
namespace {

/// libwebp wants the whole picture; its rows are gathered in the form that it works on.
class WebpEncoder : public Encoder {
public:
    WebpEncoder(int width, int height, std::optional<int> quality) {
        if (!WebPConfigInit(&config_) || !WebPPictureInit(&picture_))
            throw CodecError("WebP: the library's version differs from its header's");
        if (quality)
            config_.quality = float(*quality);
        else
            WebPConfigLosslessPreset(&config_, losslessEffort);
        config_.exact = 1;  // colours where alpha is 0 are kept
        limits::need(std::size_t(width) * std::size_t(height) * 4);
        picture_.use_argb = 1;
        picture_.width = width;
        picture_.height = height;
        if (!WebPPictureAlloc(&picture_))
            throw std::bad_alloc();
        WebPMemoryWriterInit(&writer_);
        picture_.writer = WebPMemoryWrite;
        picture_.custom_ptr = &writer_;
        picture_.progress_hook = proceed;
    }
    WebpEncoder(const WebpEncoder&) = delete;
    WebpEncoder& operator=(const WebpEncoder&) = delete;
    ~WebpEncoder() override {
        WebPPictureFree(&picture_);
        WebPMemoryWriterClear(&writer_);
    }

    void add(std::span<const std::uint8_t> row) override {
        std::uint32_t* to = picture_.argb + std::ptrdiff_t(row_++) * picture_.argb_stride;
        for (std::size_t i = 0; i < row.size(); i += 4)
            *to++ = std::uint32_t(row[i + 3]) << 24 | std::uint32_t(row[i]) << 16 |
                    std::uint32_t(row[i + 1]) << 8 | row[i + 2];
    }
    std::vector<std::uint8_t> finish() override {
        limits::check();
        if (!WebPEncode(&config_, &picture_)) {
            limits::check();
            throw CodecError("WebP: encoding failed with error " + std::to_string(picture_.error_code));
        }
        return {writer_.mem, writer_.mem + writer_.size};
    }

private:
    static int proceed(int, const WebPPicture*) {
        const limits::Budget* budget = limits::current().budget;
        return budget && budget->isExceeded() ? 0 : 1;
    }

    static constexpr int losslessEffort =
        3;  ///< of 0 to 9; some per cent larger than 6, in a third of the time

    WebPConfig config_{};
    WebPPicture picture_{};
    WebPMemoryWriter writer_{};
    int row_ = 0;
};

}  // namespace

bool isWebp(Bytes bytes) {
    constexpr std::string_view riff = "RIFF", webp = "WEBP";
    return bytes.size() >= 12 && std::equal(riff.begin(), riff.end(), bytes.begin()) &&
           std::equal(webp.begin(), webp.end(), bytes.begin() + 8);
}

Bitmap decodeWebp(Bytes bytes) {
    int width = 0, height = 0;
    if (!WebPGetInfo(bytes.data(), bytes.size(), &width, &height))
        throw CodecError("WebP: the header is damaged");
    Bitmap bitmap = makeBitmap(width, height);
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), bitmap.rgba.data(), bitmap.rgba.size(), width * 4))
        throw CodecError("WebP: the data is damaged");
    return bitmap;
}

std::unique_ptr<Encoder> makeWebpEncoder(int width, int height, std::optional<int> quality) {
    return std::make_unique<WebpEncoder>(width, height, quality);
}

}  // namespace vtm::image
