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
#include <deque>
#include <string_view>

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <vtm/image/codec.hpp>
#include <vtm/limits/limits.hpp>
#include "image/src/deflate_join.hpp"
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
constexpr int usualLevel = 6, filteredLevel = 7;

/// Rows are deflated in parts of at least so many bytes, on all processors. Parts of one picture are as many
/// on any machine, and so are its bytes.
constexpr std::size_t partBytes = std::size_t(1) << 20;

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

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, int atLevel) {
    const Compressor compressor = makeCompressor(atLevel);
    const std::size_t bound = libdeflate_deflate_compress_bound(compressor.get(), bytes.size());
    const auto result = std::make_unique_for_overwrite<std::uint8_t[]>(bound);
    const std::size_t size =
        libdeflate_deflate_compress(compressor.get(), bytes.data(), bytes.size(), result.get(), bound);
    return {result.get(), result.get() + size};
}

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

// ---- Parts ----------------------------------------------------------------------------------------

/// Rows that are deflated together, in bands of one filter.
class Part {
public:
    /// `above`: the row before the first one. `pixel`: bytes of one.
    Part(std::vector<std::uint8_t> above, std::size_t pixel, std::size_t maxRows)
        : pixel_(pixel), rowBytes_(above.size()), rows_(std::move(above)) {
        rows_.reserve(rowBytes_ * (maxRows + 1));
    }

    void add(std::span<const std::uint8_t> row) {
        rows_.insert(rows_.end(), row.begin(), row.begin() + std::ptrdiff_t(rowBytes_));
    }
    std::size_t count() const { return rows_.size() / rowBytes_ - 1; }
    std::vector<std::uint8_t> lastRow() const {
        return {rows_.end() - std::ptrdiff_t(rowBytes_), rows_.end()};
    }

    /// Forgets the rows. `isLast`: of the picture.
    void deflate(bool isLast) {
        std::vector<std::uint8_t> bytes((rowBytes_ + 1) * count());
        filterAll(bytes);
        rows_ = std::vector<std::uint8_t>();  // frees them
        adler_ = libdeflate_adler32(1, bytes.data(), bytes.size());
        size_ = bytes.size();
        stream_ = deflated(bytes, level());
        if (!isLast)
            openEnd(stream_);
    }

    int level() const {
        constexpr std::size_t muchOf = 4;  // a quarter of the rows
        return filteredRows_ * muchOf >= size_ / (rowBytes_ + 1) ? filteredLevel : usualLevel;
    }
    const std::vector<std::uint8_t>& stream() const { return stream_; }
    /// Of all bytes up to the end of this part, given that of those before it.
    std::uint32_t adlerAfter(std::uint32_t before) const {
        return std::uint32_t(adler32_combine(before, adler_, z_off_t(size_)));
    }

    static constexpr std::size_t bandRows = 128;

private:
    static constexpr std::size_t sampleRows = 8;
    /// More than deflate needs where nothing can be made smaller: 5 bytes a block of 64 KiB or less, and a
    /// header.
    static constexpr std::size_t sampleSlack = 4096;

    void filterAll(std::vector<std::uint8_t>& bytes) {
        const Compressor sampler = makeCompressor(1);
        std::uint8_t* to = bytes.data();
        for (std::size_t first = 1; first <= count(); first += bandRows) {
            limits::check();
            const std::size_t rows = std::min(bandRows, count() + 1 - first);
            const Filter filter = filterFor(first, rows, *sampler);
            filteredRows_ += filter == Filter::None ? 0 : rows;
            for (std::size_t row = first; row < first + rows; ++row, to += rowBytes_ + 1)
                filterRow(filter, row, to);
        }
    }

    void filterRow(Filter filter, std::size_t row, std::uint8_t* to) const {
        const std::uint8_t* const at = &rows_[row * rowBytes_];
        applyFilter(filter, at, at - rowBytes_, rowBytes_, pixel_, to);
    }

    Filter filterFor(std::size_t first, std::size_t rows, libdeflate_compressor& sampler) const {
        return *std::ranges::min_element(
            filters, {}, [&](Filter filter) { return sampledSize(filter, first, rows, sampler); });
    }
    /// Of rows in the middle of a band.
    std::size_t sampledSize(Filter filter, std::size_t first, std::size_t rows,
                            libdeflate_compressor& sampler) const {
        const std::size_t count = std::min(sampleRows, rows), from = first + (rows - count) / 2;
        std::vector<std::uint8_t> sample((rowBytes_ + 1) * count), result(sample.size() + sampleSlack);
        for (std::size_t i = 0; i < count; ++i)
            filterRow(filter, from + i, &sample[i * (rowBytes_ + 1)]);
        const std::size_t size =
            libdeflate_deflate_compress(&sampler, sample.data(), sample.size(), result.data(), result.size());
        return size > 0 ? size : result.size();  // 0: it did not fit
    }

    std::size_t pixel_, rowBytes_;
    std::vector<std::uint8_t> rows_;  ///< the one above, and those of the part
    std::size_t filteredRows_ = 0;
    std::size_t size_ = 0;     ///< of the filtered rows
    std::uint32_t adler_ = 1;  ///< of the filtered rows
    std::vector<std::uint8_t> stream_;
};

// ---- The encoder ----------------------------------------------------------------------------------

class PngEncoder : public Encoder {
public:
    PngEncoder(int width, int height, int depth)
        : pixel_(std::size_t(depth) / 2),
          rowBytes_(std::size_t(width) * pixel_),
          partRows_(std::min(rowsOfPart(), std::size_t(height))),
          left_(std::size_t(height)) {
        addHeader(file_, width, height, depth);
        if (depth == 16)
            file_.chunk("tEXt", straightNote());
        begin(std::vector<std::uint8_t>(rowBytes_));  // black is above the first row
    }
    ~PngEncoder() noexcept override {
        group_.cancel();
        try {
            group_.wait();
        } catch (...) {  // an exception is on its way already, or nobody wants the picture
        }
    }

    void add(std::span<const std::uint8_t> row) override {
        parts_.back().add(row);
        --left_;
        if (parts_.back().count() == partRows_ && left_ > 0) {
            std::vector<std::uint8_t> last = parts_.back().lastRow();
            deflateLast(false);
            begin(std::move(last));
        }
    }

    std::vector<std::uint8_t> finish() override {
        deflateLast(true);
        write();
        file_.chunk("IEND", {});
        return file_.take();
    }

private:
    static std::span<const std::uint8_t> straightNote() {
        static constexpr char note[] = "Alpha\0straight";
        return {reinterpret_cast<const std::uint8_t*>(note), sizeof note - 1};
    }

    std::size_t rowsOfPart() const {
        const std::size_t bandBytes = (rowBytes_ + 1) * Part::bandRows;
        return (partBytes + bandBytes - 1) / bandBytes * Part::bandRows;
    }

    void begin(std::vector<std::uint8_t> above) {
        parts_.emplace_back(std::move(above), pixel_, std::min(partRows_, left_));
    }

    /// On another thread, if there is one; holds no more parts than processors can work on.
    void deflateLast(bool isLast) {
        Part& part = parts_.back();
        group_.run([&part, isLast, holding = limits::current()] {
            const limits::Scope scope(holding);
            part.deflate(isLast);
        });
        if (++running_ >= 2 * tbb::this_task_arena::max_concurrency() || isLast) {
            group_.wait();
            running_ = 0;
        }
    }

    /// A zlib stream (RFC 1950), a part a chunk.
    void write() {
        std::uint32_t adler = 1;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Part& part = parts_[i];
            std::vector<std::uint8_t> bytes;
            if (i == 0)  // a window of 32 KiB; the second byte hints at the level
                bytes = {0x78, std::uint8_t(part.level() > usualLevel ? 0xda : 0x9c)};
            bytes.insert(bytes.end(), part.stream().begin(), part.stream().end());
            adler = part.adlerAfter(adler);
            if (i + 1 == parts_.size())
                for (int shift = 24; shift >= 0; shift -= 8)
                    bytes.push_back(std::uint8_t(adler >> shift));
            file_.chunk("IDAT", bytes);
        }
    }

    const std::size_t pixel_, rowBytes_, partRows_;
    std::size_t left_;  ///< rows that are to come
    std::deque<Part> parts_;
    PngFile file_;
    tbb::task_group group_;
    int running_ = 0;
};

}  // namespace

std::unique_ptr<Encoder> makePngEncoder(int width, int height, int depth) {
    return std::make_unique<PngEncoder>(width, height, depth);
}

std::vector<std::uint8_t> encodePng(const Bitmap& bitmap) { return encode(bitmap, FileFormat::Png); }

}  // namespace vtm::image
