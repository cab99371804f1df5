// The first frame of a GIF, placed on its logical screen. Source: GIF89a specification; variable
// length codes in appendix F.

#include <algorithm>
#include <array>
#include <string_view>

#include <vtm/image/codec.hpp>
#include "image/src/formats.hpp"

namespace vtm::image {
namespace {

constexpr int maxCodeBits = 12;

/// Bytes in order; reading past the end is an error.
class Reader {
public:
    explicit Reader(Bytes bytes) : bytes_(bytes) {}

    int byte() { return take(1)[0]; }
    int word() {
        const Bytes pair = take(2);
        return pair[0] | pair[1] << 8;
    }
    Bytes take(std::size_t count) {
        if (count > bytes_.size())
            throw CodecError("GIF: the data ends early");
        const Bytes taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }
    /// The data of a chain of sub-blocks, up to its terminator or the end of a truncated file.
    std::vector<std::uint8_t> subBlocks() {
        std::vector<std::uint8_t> data;
        while (!bytes_.empty()) {
            const std::size_t size = static_cast<std::size_t>(byte());
            if (size == 0)
                break;
            const Bytes block = take(std::min(size, bytes_.size()));
            data.insert(data.end(), block.begin(), block.end());
        }
        return data;
    }

private:
    Bytes bytes_;
};

/// LZW codes of growing width, least significant bit first.
class CodeReader {
public:
    explicit CodeReader(Bytes data) : data_(data) {}

    /// -1 at the end.
    int next(int width) {
        while (bits_ < width) {
            if (data_.empty())
                return -1;
            buffer_ |= static_cast<unsigned>(data_[0]) << bits_;
            data_ = data_.subspan(1);
            bits_ += 8;
        }
        const int code = static_cast<int>(buffer_ & ((1u << width) - 1));
        buffer_ >>= width;
        bits_ -= width;
        return code;
    }

private:
    Bytes data_;
    unsigned buffer_ = 0;
    int bits_ = 0;
};

/// Strings as chains: each code is its prefix's string and one more byte.
class Dictionary {
public:
    explicit Dictionary(int literals) : literals_(literals) { reset(); }

    void reset() { size_ = literals_ + 2; }
    int size() const { return size_; }
    bool full() const { return size_ == 1 << maxCodeBits; }
    void add(int prefix, std::uint8_t last) {
        prefix_[static_cast<std::size_t>(size_)] = prefix;
        last_[static_cast<std::size_t>(size_)] = last;
        ++size_;
    }
    /// Appends the string of `code` and returns its first byte.
    std::uint8_t expand(int code, std::vector<std::uint8_t>& out) const {
        const std::size_t start = out.size();
        for (; code >= literals_; code = prefix_[static_cast<std::size_t>(code)])
            out.push_back(last_[static_cast<std::size_t>(code)]);
        out.push_back(static_cast<std::uint8_t>(code));
        std::reverse(out.begin() + static_cast<std::ptrdiff_t>(start), out.end());
        return out[start];
    }

private:
    int literals_, size_ = 0;
    std::array<int, 1 << maxCodeBits> prefix_{};
    std::array<std::uint8_t, 1 << maxCodeBits> last_{};
};

/// Up to `count` palette indices; fewer where the data is broken or ends.
std::vector<std::uint8_t> unpack(Bytes data, int literalBits, std::size_t count) {
    const int clear = 1 << literalBits, end = clear + 1;
    Dictionary dictionary(clear);
    CodeReader codes(data);
    std::vector<std::uint8_t> out;
    int width = literalBits + 1, previous = -1;
    while (out.size() < count) {
        const int code = codes.next(width);
        if (code < 0 || code == end || code > dictionary.size())
            break;
        if (code == clear) {
            dictionary.reset();
            width = literalBits + 1;
            previous = -1;
            continue;
        }
        if (previous < 0) {
            if (code > end)
                break;
            dictionary.expand(code, out);
        } else if (code < dictionary.size()) {
            const std::uint8_t first = dictionary.expand(code, out);
            if (!dictionary.full())
                dictionary.add(previous, first);
        } else {
            if (dictionary.full())
                break;
            const std::uint8_t first = dictionary.expand(previous, out);
            out.push_back(first);
            dictionary.add(previous, first);
        }
        previous = code;
        if (dictionary.size() == 1 << width && width < maxCodeBits)
            ++width;
    }
    out.resize(std::min(out.size(), count));
    return out;
}

struct Frame {
    int left, top, width, height;
    bool interlaced;
};

/// The screen row of a frame's n-th stored row: every 8th from 0, every 8th from 4, every 4th from
/// 2, every 2nd from 1 (GIF89a appendix E).
std::vector<int> rowOrder(const Frame& frame) {
    std::vector<int> rows;
    if (!frame.interlaced) {
        for (int y = 0; y < frame.height; ++y)
            rows.push_back(y);
        return rows;
    }
    constexpr std::array<std::array<int, 2>, 4> passes{{{0, 8}, {4, 8}, {2, 4}, {1, 2}}};
    for (const auto& [start, step] : passes)
        for (int y = start; y < frame.height; y += step)
            rows.push_back(y);
    return rows;
}

void place(const Frame& frame, const std::vector<std::uint8_t>& indices, Bytes palette, int transparent,
           Bitmap& screen) {
    const std::vector<int> rows = rowOrder(frame);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const int x = frame.left + static_cast<int>(i % static_cast<std::size_t>(frame.width));
        const int y = frame.top + rows[i / static_cast<std::size_t>(frame.width)];
        const std::size_t entry = std::size_t(indices[i]) * 3;
        if (x >= screen.width || y >= screen.height || indices[i] == transparent ||
            entry + 3 > palette.size())
            continue;
        std::uint8_t* pixel = &screen.rgba[(std::size_t(y) * std::size_t(screen.width) + std::size_t(x)) * 4];
        std::copy_n(palette.begin() + static_cast<std::ptrdiff_t>(entry), 3, pixel);
        pixel[3] = 255;
    }
}

Bytes readPalette(Reader& in, int flags) {
    return flags & 0x80 ? in.take(std::size_t(3) << ((flags & 7) + 1)) : Bytes{};
}

/// Reads an extension; a graphic control extension gives the transparent index, -1 for none.
void readExtension(Reader& in, int& transparent) {
    const int label = in.byte();
    const std::vector<std::uint8_t> data = in.subBlocks();
    if (label == 0xf9 && data.size() >= 4)
        transparent = data[0] & 1 ? data[3] : -1;
}

void readFrame(Reader& in, Bytes palette, int transparent, Bitmap& screen) {
    Frame frame{};
    frame.left = in.word();
    frame.top = in.word();
    frame.width = in.word();
    frame.height = in.word();
    const int flags = in.byte();
    frame.interlaced = flags & 0x40;
    if (const Bytes local = readPalette(in, flags); !local.empty())
        palette = local;
    const int literalBits = in.byte();
    if (literalBits < 1 || literalBits > 8)
        throw CodecError("GIF: invalid LZW code size");
    if (std::int64_t(frame.width) * frame.height > maxDecodedPixels)
        throw CodecError("GIF: the frame is too large");
    const std::vector<std::uint8_t> data = in.subBlocks();
    place(frame, unpack(data, literalBits, std::size_t(frame.width) * std::size_t(frame.height)), palette,
          transparent, screen);
}

}  // namespace

bool isGif(Bytes bytes) {
    constexpr std::string_view signature = "GIF8";
    return bytes.size() >= 6 && std::equal(signature.begin(), signature.end(), bytes.begin());
}

Bitmap decodeGif(Bytes bytes) {
    Reader in(bytes);
    in.take(6);
    const int width = in.word(), height = in.word(), flags = in.byte();
    in.take(2);
    Bitmap screen = makeBitmap(width, height);
    const Bytes palette = readPalette(in, flags);
    for (int transparent = -1;;) {
        switch (in.byte()) {
            case 0x21:
                readExtension(in, transparent);
                break;
            case 0x2c:
                readFrame(in, palette, transparent, screen);
                return screen;
            default:
                throw CodecError("GIF: the file has no frame");
        }
    }
}

}  // namespace vtm::image
