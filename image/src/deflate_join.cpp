#include "image/src/deflate_join.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include <vtm/image/codec.hpp>

namespace vtm::image {
namespace {

constexpr std::size_t maxCode = 15;  // bits

[[noreturn]] void refuse() { throw CodecError("deflate: the stream is damaged"); }

class BitReader {
public:
    explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::size_t place() const { return place_; }
    /// At least 32 bits from here on, the next one lowest; zeros beyond the end.
    std::uint64_t peek() const {
        const std::size_t first = place_ / 8;
        std::uint64_t word = 0;
        if (first + sizeof word <= bytes_.size())
            std::memcpy(&word, &bytes_[first], sizeof word);
        else if (first < bytes_.size())
            std::memcpy(&word, &bytes_[first], bytes_.size() - first);
        return word >> place_ % 8;
    }
    void skip(std::size_t bits) {
        place_ += bits;
        if (place_ > 8 * bytes_.size())
            refuse();
    }
    unsigned take(unsigned bits) {
        const auto value = unsigned(peek() & ((1u << bits) - 1));
        skip(bits);
        return value;
    }
    void toByte() { skip((8 - place_ % 8) % 8); }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t place_ = 0;
};

/// A canonical Huffman code, section 3.2.2. Short codes are looked up, others are found by their lengths.
class HuffmanCode {
public:
    explicit HuffmanCode(std::span<const std::uint8_t> lengths) {
        for (const std::uint8_t length : lengths)
            ++counts_[length];
        counts_[0] = 0;
        std::array<unsigned, maxCode + 2> next{}, places{};
        for (std::size_t length = 1; length <= maxCode; ++length) {
            next[length + 1] = (next[length] + counts_[length]) << 1;
            places[length + 1] = places[length] + counts_[length];
        }
        symbols_.resize(lengths.size());
        for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
            if (const unsigned length = lengths[symbol]; length > 0) {
                symbols_[places[length]++] = std::uint16_t(symbol);
                if (const unsigned code = next[length]++; length <= shortCode)
                    fill(reversed(code, length), length, unsigned(symbol));
            }
    }

    unsigned read(BitReader& from) const {
        const std::uint64_t bits = from.peek();
        const std::uint16_t entry = short_[bits & (shortEntries - 1)];
        if (entry == 0)
            return readLong(from, bits);
        from.skip(entry & 15);
        return entry >> 4;
    }

private:
    static constexpr unsigned shortCode = 10;
    static constexpr std::size_t shortEntries = std::size_t(1) << shortCode;

    static unsigned reversed(unsigned code, unsigned length) {
        unsigned result = 0;
        for (unsigned i = 0; i < length; ++i)
            result |= (code >> i & 1) << (length - 1 - i);
        return result;
    }
    void fill(unsigned first, unsigned length, unsigned symbol) {
        for (std::size_t i = first; i < shortEntries; i += std::size_t(1) << length)
            short_[i] = std::uint16_t(symbol << 4 | length);
    }
    unsigned readLong(BitReader& from, std::uint64_t bits) const {
        unsigned code = 0, first = 0, place = 0;
        for (unsigned length = 1; length <= maxCode; ++length, bits >>= 1) {
            code |= unsigned(bits & 1);
            const unsigned count = counts_[length];
            if (code < first + count) {
                from.skip(length);
                return symbols_[place + code - first];
            }
            place += count;
            first = (first + count) << 1;
            code <<= 1;
        }
        refuse();
    }

    std::array<std::uint16_t, maxCode + 1> counts_{};  ///< by length
    std::vector<std::uint16_t> symbols_;               ///< in the order of their codes
    std::array<std::uint16_t, shortEntries> short_{};  ///< 16 · symbol + length; 0: none
};

/// Extra bits of lengths and distances, section 3.2.5.
constexpr std::array<std::uint8_t, 29> lengthBits{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                  2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr std::array<std::uint8_t, 30> distanceBits{0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                    6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};

void skipSymbols(BitReader& from, const HuffmanCode& literals, const HuffmanCode& distances) {
    constexpr unsigned endOfBlock = 256;
    for (;;) {
        const unsigned symbol = literals.read(from);
        if (symbol < endOfBlock)
            continue;
        if (symbol == endOfBlock)
            return;
        const unsigned length = symbol - endOfBlock - 1;
        if (length >= lengthBits.size())
            refuse();
        from.skip(lengthBits[length]);
        const unsigned distance = distances.read(from);
        if (distance >= distanceBits.size())
            refuse();
        from.skip(distanceBits[distance]);
    }
}

void skipFixed(BitReader& from) {
    static const auto codes = [] {
        std::array<std::uint8_t, 288> lengths{};
        for (std::size_t i = 0; i < lengths.size(); ++i)
            lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
        std::array<std::uint8_t, 30> distances{};
        distances.fill(5);
        return std::pair(HuffmanCode(lengths), HuffmanCode(distances));
    }();
    skipSymbols(from, codes.first, codes.second);
}

/// Section 3.2.7.
void skipDynamic(BitReader& from) {
    constexpr std::array<std::uint8_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                 11, 4,  12, 3, 13, 2, 14, 1, 15};
    const std::size_t literals = 257 + from.take(5), distances = 1 + from.take(5), codes = 4 + from.take(4);
    std::array<std::uint8_t, 19> codeLengths{};
    for (std::size_t i = 0; i < codes; ++i)
        codeLengths[order[i]] = std::uint8_t(from.take(3));
    const HuffmanCode code(codeLengths);
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < literals + distances) {
        const unsigned symbol = code.read(from);
        if (symbol < 16)
            lengths.push_back(std::uint8_t(symbol));
        else if (symbol == 16 && lengths.empty())
            refuse();
        else if (symbol == 16)
            lengths.insert(lengths.end(), 3 + from.take(2), std::uint8_t(lengths.back()));
        else
            lengths.insert(lengths.end(), symbol == 17 ? 3 + from.take(3) : 11 + from.take(7), 0);
    }
    const std::span<const std::uint8_t> all(lengths);
    skipSymbols(from, HuffmanCode(all.first(literals)), HuffmanCode(all.subspan(literals, distances)));
}

}  // namespace

LastBlock findLastBlock(std::span<const std::uint8_t> stream) {
    BitReader from(stream);
    for (;;) {
        const std::size_t begin = from.place();
        const bool isLast = from.take(1) != 0;
        const unsigned type = from.take(2);
        if (type == 0) {
            from.toByte();
            const std::size_t length = from.take(16);
            from.skip(16 + 8 * length);
        } else if (type == 1) {
            skipFixed(from);
        } else if (type == 2) {
            skipDynamic(from);
        } else {
            refuse();
        }
        if (isLast)
            return {begin, from.place()};
    }
}

void openEnd(std::vector<std::uint8_t>& stream) {
    const LastBlock last = findLastBlock(stream);
    stream[last.begin / 8] &= std::uint8_t(~(1u << last.begin % 8));
    // A stored block: three bits of zero, as those that fill the last byte are, up to the next byte, its
    // length and the complement of that.
    constexpr std::size_t header = 3;
    stream.resize((last.end + header + 7) / 8);
    stream.insert(stream.end(), {0, 0, 0xff, 0xff});
}

}  // namespace vtm::image
