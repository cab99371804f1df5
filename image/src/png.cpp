// PNG (third edition), read by libpng and written by rows. Of vector pictures most rows repeat what is above
// them or left of them, which deflate finds without any filter; gradients and photographs want one. So every
// band of rows has the filter that makes a sample of it smallest.

#include <libdeflate.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <vtm/image/codec.hpp>
#include <vtm/limits/limits.hpp>
#include "image/src/formats.hpp"

namespace vtm::image {

// ---- Reading ------------------------------------------------------------------------------------

namespace {

/// libpng's simplified interface, freed on every way out.
struct PngImage {
    png_image image{};

    PngImage() { image.version = PNG_IMAGE_VERSION; }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
    ~PngImage() { png_image_free(&image); }

    void require(int success) const {
        if (!success)
            throw CodecError(std::string("PNG: ") + image.message);
    }
};

}  // namespace

bool isPng(Bytes bytes) {
    constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() >= signature.size() && std::equal(signature.begin(), signature.end(), bytes.begin());
}

Bitmap decodePng(Bytes bytes) {
    PngImage png;
    png.require(png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()));
    // Without a gamma in the file 16 bits mean sRGB too, as browsers have it.
    png.image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    png.image.format = PNG_FORMAT_RGBA;
    Bitmap bitmap = makeBitmap(png.image.width, png.image.height);
    png.require(png_image_finish_read(&png.image, nullptr, bitmap.rgba.data(), 0, nullptr));
    return bitmap;
}

// ---- Writing ------------------------------------------------------------------------------------

namespace {

/// Of both deflaters: the size of their slower levels to some per cent, in half the time. Filtered rows gain
/// some 15 % by libdeflate's next level.
constexpr int level = 6, filteredLevel = 7;

/// Up to so many bytes are held and deflated at once, by libdeflate, which takes half the time; beyond that
/// zlib streams. 4096 × 4096 pixels.
constexpr std::size_t maxWhole = std::size_t(65) << 20;

// ---- The file -------------------------------------------------------------------------------------

class PngFile {
public:
    PngFile() : bytes_{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'} {}

    void chunk(std::string_view type, std::span<const std::uint8_t> data) {
        number(std::uint32_t(data.size()));
        const std::size_t start = bytes_.size();
        bytes_.insert(bytes_.end(), type.begin(), type.end());
        bytes_.insert(bytes_.end(), data.begin(), data.end());
        number(libdeflate_crc32(0, &bytes_[start], bytes_.size() - start));
    }
    std::vector<std::uint8_t> take() { return std::move(bytes_); }

private:
    void number(std::uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8)
            bytes_.push_back(std::uint8_t(value >> shift));
    }

    std::vector<std::uint8_t> bytes_;
};

void addHeader(PngFile& file, int width, int height, int depth) {
    constexpr std::uint8_t rgba = 6;
    std::array<std::uint8_t, 13> header{};
    for (std::size_t i = 0; i < 4; ++i) {
        header[i] = std::uint8_t(width >> (24 - 8 * i));
        header[4 + i] = std::uint8_t(height >> (24 - 8 * i));
    }
    header[8] = std::uint8_t(depth);
    header[9] = rgba;
    file.chunk("IHDR", header);
}

// ---- Deflate --------------------------------------------------------------------------------------

/// Makes IDAT chunks of filtered rows.
class Deflater {
public:
    virtual ~Deflater() = default;
    virtual void add(std::span<const std::uint8_t> bytes) = 0;
    /// `areFiltered`: much of what was added is differences.
    virtual void finish(bool areFiltered) = 0;
};

struct FreeCompressor {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};
using Compressor = std::unique_ptr<libdeflate_compressor, FreeCompressor>;

Compressor makeCompressor(int atLevel) {
    Compressor compressor(libdeflate_alloc_compressor(atLevel));
    if (!compressor)
        throw std::bad_alloc();
    return compressor;
}

class WholeDeflater : public Deflater {
public:
    WholeDeflater(PngFile& file, std::size_t size)
        : file_(file), bytes_(std::make_unique_for_overwrite<std::uint8_t[]>(size)) {}

    void add(std::span<const std::uint8_t> bytes) override {
        std::memcpy(&bytes_[size_], bytes.data(), bytes.size());
        size_ += bytes.size();
    }
    void finish(bool areFiltered) override {
        const Compressor compressor = makeCompressor(areFiltered ? filteredLevel : level);
        const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), size_);
        const auto result = std::make_unique_for_overwrite<std::uint8_t[]>(bound);
        const std::size_t size =
            libdeflate_zlib_compress(compressor.get(), bytes_.get(), size_, result.get(), bound);
        file_.chunk("IDAT", {result.get(), size});
    }

private:
    PngFile& file_;
    std::unique_ptr<std::uint8_t[]> bytes_;
    std::size_t size_ = 0;
};

class StreamDeflater : public Deflater {
public:
    explicit StreamDeflater(PngFile& file) : file_(file), result_(std::size_t(1) << 18) {
        if (deflateInit(&stream_, level) != Z_OK)
            throw std::bad_alloc();
        rewind();
    }
    StreamDeflater(const StreamDeflater&) = delete;
    StreamDeflater& operator=(const StreamDeflater&) = delete;
    ~StreamDeflater() override { deflateEnd(&stream_); }

    void add(std::span<const std::uint8_t> bytes) override {
        stream_.next_in = const_cast<Bytef*>(bytes.data());  // zlib reads it only
        stream_.avail_in = uInt(bytes.size());
        while (stream_.avail_in > 0) {
            deflate(&stream_, Z_NO_FLUSH);
            if (stream_.avail_out == 0)
                write();
        }
    }
    void finish(bool) override {
        while (deflate(&stream_, Z_FINISH) != Z_STREAM_END)
            write();
        write();
    }

private:
    void rewind() {
        stream_.next_out = result_.data();
        stream_.avail_out = uInt(result_.size());
    }
    void write() {
        file_.chunk("IDAT", std::span(result_).first(result_.size() - stream_.avail_out));
        rewind();
    }

    PngFile& file_;
    std::vector<std::uint8_t> result_;
    z_stream stream_{};
};

// ---- Filters (PNG, chapter 9) ---------------------------------------------------------------------

enum class Filter : std::uint8_t { None = 0, Sub = 1, Paeth = 4 };
constexpr Filter filters[]{Filter::None, Filter::Sub, Filter::Paeth};

int paeth(int left, int above, int corner) {
    const int toLeft = std::abs(above - corner), toAbove = std::abs(left - corner),
              toCorner = std::abs(left + above - 2 * corner);
    return toLeft <= toAbove && toLeft <= toCorner ? left : toAbove <= toCorner ? above : corner;
}

/// Writes the filter's byte and the row. `pixel`: bytes of one.
void applyFilter(Filter filter, const std::uint8_t* row, const std::uint8_t* above, std::size_t size,
                 std::size_t pixel, std::uint8_t* to) {
    *to++ = std::uint8_t(filter);
    if (filter == Filter::None) {
        std::memcpy(to, row, size);
        return;
    }
    for (std::size_t i = 0; i < pixel; ++i)  // nothing is on the left: Paeth takes what is above
        to[i] = std::uint8_t(filter == Filter::Sub ? row[i] : row[i] - above[i]);
    if (filter == Filter::Sub)
        for (std::size_t i = pixel; i < size; ++i)
            to[i] = std::uint8_t(row[i] - row[i - pixel]);
    else
        for (std::size_t i = pixel; i < size; ++i)
            to[i] = std::uint8_t(row[i] - paeth(row[i - pixel], above[i], above[i - pixel]));
}

// ---- The encoder ----------------------------------------------------------------------------------

class PngEncoder : public Encoder {
public:
    PngEncoder(int width, int height, int depth)
        : pixel_(std::size_t(depth) / 2),
          rowBytes_(std::size_t(width) * pixel_),
          rows_(std::min(bandRows, std::size_t(height)) + 1, rowBytes_),
          filtered_(rowBytes_ + 1),
          sample_((rowBytes_ + 1) * sampleRows),
          sampleResult_(sample_.size() + sampleSlack),
          sampler_(makeCompressor(1)) {
        addHeader(file_, width, height, depth);
        if (depth == 16)
            file_.chunk("tEXt", straightNote());
        const std::size_t all = (rowBytes_ + 1) * std::size_t(height);
        if (all <= maxWhole)
            deflater_ = std::make_unique<WholeDeflater>(file_, all);
        else
            deflater_ = std::make_unique<StreamDeflater>(file_);
    }

    void add(std::span<const std::uint8_t> row) override {
        std::memcpy(rows_.at(1 + held_), row.data(), rowBytes_);
        if (++held_ + 1 == rows_.count())
            writeBand();
    }

    std::vector<std::uint8_t> finish() override {
        if (held_ > 0)
            writeBand();
        constexpr std::size_t muchOf = 4;  // a quarter
        deflater_->finish(filteredRows_ * muchOf >= allRows_);
        file_.chunk("IEND", {});
        return file_.take();
    }

private:
    static constexpr std::size_t bandRows = 128, sampleRows = 8;
    /// More than deflate needs where nothing can be made smaller: 5 bytes a block of 64 KiB or less, and a
    /// header.
    static constexpr std::size_t sampleSlack = 4096;

    /// The last row of the band before, black for the first, and the band.
    class Rows {
    public:
        Rows(std::size_t count, std::size_t rowBytes) : rowBytes_(rowBytes), bytes_(count * rowBytes) {}
        std::uint8_t* at(std::size_t row) { return &bytes_[row * rowBytes_]; }
        std::size_t count() const { return bytes_.size() / rowBytes_; }

    private:
        std::size_t rowBytes_;
        std::vector<std::uint8_t> bytes_;
    };

    static std::span<const std::uint8_t> straightNote() {
        static constexpr char note[] = "Alpha\0straight";
        return {reinterpret_cast<const std::uint8_t*>(note), sizeof note - 1};
    }

    void filterRow(Filter filter, std::size_t row, std::uint8_t* to) {
        applyFilter(filter, rows_.at(row), rows_.at(row - 1), rowBytes_, pixel_, to);
    }

    void writeBand() {
        limits::check();
        const Filter filter = chosenFilter();
        allRows_ += held_;
        filteredRows_ += filter == Filter::None ? 0 : held_;
        for (std::size_t row = 1; row <= held_; ++row) {
            filterRow(filter, row, filtered_.data());
            deflater_->add(filtered_);
        }
        std::memcpy(rows_.at(0), rows_.at(held_), rowBytes_);
        held_ = 0;
    }

    Filter chosenFilter() {
        return *std::ranges::min_element(filters, {}, [this](Filter filter) { return sampledSize(filter); });
    }
    /// Of rows in the middle of the band.
    std::size_t sampledSize(Filter filter) {
        const std::size_t count = std::min(sampleRows, held_), first = 1 + (held_ - count) / 2;
        for (std::size_t i = 0; i < count; ++i)
            filterRow(filter, first + i, &sample_[i * (rowBytes_ + 1)]);
        const std::size_t size =
            libdeflate_deflate_compress(sampler_.get(), sample_.data(), count * (rowBytes_ + 1),
                                        sampleResult_.data(), sampleResult_.size());
        return size > 0 ? size : sampleResult_.size();  // 0: it did not fit
    }

    std::size_t pixel_, rowBytes_;
    Rows rows_;
    std::size_t held_ = 0;  ///< rows of the band
    std::size_t allRows_ = 0, filteredRows_ = 0;
    std::vector<std::uint8_t> filtered_, sample_, sampleResult_;
    Compressor sampler_;
    PngFile file_;
    std::unique_ptr<Deflater> deflater_;
};

}  // namespace

std::unique_ptr<Encoder> makePngEncoder(int width, int height, int depth) {
    return std::make_unique<PngEncoder>(width, height, depth);
}

std::vector<std::uint8_t> encodePng(const Bitmap& bitmap) { return encode(bitmap, FileFormat::Png); }

}  // namespace vtm::image
