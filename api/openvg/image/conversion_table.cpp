#include "api/openvg/image/conversion_table.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <numeric>
#include <ranges>

namespace vtm::openvg {

namespace {

bool canBeWords(const PixelFormat& from) { return from.bits <= 16; }

bool canBeChannels(const PixelFormat& from, const PixelFormat& to) {
    return byteOrder(from) && byteOrder(to) && from.space.luminance == to.space.luminance;
}

}  // namespace

std::shared_ptr<const ConversionTable> ConversionTable::of(const PixelFormat& from, const PixelFormat& to,
                                                           RowConversion* convert) {
    struct Entry {
        PixelFormat from, to;
        RowConversion* convert;
        std::shared_ptr<const ConversionTable> table;
    };
    constexpr std::size_t maxEntries = 16;  // of 256 KB at most
    static auto& mutex = *new std::mutex;
    static auto& entries = *new std::vector<Entry>;  // the last used one is the first
    if (!canBeWords(from) && !canBeChannels(from, to))
        return nullptr;
    const std::lock_guard lock(mutex);
    auto it = std::ranges::find_if(entries, [&](const Entry& entry) {
        return entry.from == from && entry.to == to && entry.convert == convert;
    });
    if (it == entries.end()) {
        auto table = std::make_shared<const ConversionTable>(from, to, convert);
        if (entries.size() == maxEntries)
            entries.pop_back();
        it = entries.insert(entries.end(), {from, to, convert, std::move(table)});
    }
    std::rotate(entries.begin(), it, it + 1);
    return entries.front().table;
}

ConversionTable::ConversionTable(const PixelFormat& from, const PixelFormat& to, RowConversion* convert)
    : fromBytes_(from.pixelBytes()), toBytes_(to.pixelBytes()) {
    if (canBeWords(from))
        addWords(from, to, convert);
    else
        addChannels(from, to, convert);
}

void ConversionTable::addWords(const PixelFormat& from, const PixelFormat& to, RowConversion* convert) {
    const std::size_t count = std::size_t(1) << 8 * fromBytes_;
    std::vector<std::uint8_t> all(count * fromBytes_), converted(count * toBytes_);
    for (std::size_t word = 0; word < count; ++word)
        setWordAt(&all[word * fromBytes_], fromBytes_, std::uint32_t(word));
    convert(all.data(), from, converted.data(), to, int(count));
    words_.resize(count);
    for (std::size_t word = 0; word < count; ++word)
        words_[word] = wordAt(&converted[word * toBytes_], toBytes_);
}

void ConversionTable::addChannels(const PixelFormat& from, const PixelFormat& to, RowConversion* convert) {
    fromOrder_ = *byteOrder(from);
    toOrder_ = *byteOrder(to);
    const bool alphaMatters = from.alpha.bits != 0 && (from.space.premultiplied || to.space.premultiplied);
    alphaMask_ = alphaMatters ? 255 : 0;
    channels_.resize(alphaMatters ? 256 * 256 : 256);
    std::array<std::uint8_t, 4 * 256> row, converted;
    for (int alpha = 0; alpha < 256; ++alpha) {
        for (int value = 0; value < 256; ++value) {
            std::uint8_t* const pixel = &row[std::size_t(4 * value)];
            std::fill_n(pixel, 4, std::uint8_t(value));
            pixel[fromOrder_.alpha] = std::uint8_t(alpha);
        }
        convert(row.data(), from, converted.data(), to, 256);
        alphas_[std::size_t(alpha)] = converted[std::size_t(toOrder_.alpha)];
        if (alpha > alphaMask_)
            continue;
        for (int value = 0; value < 256; ++value)
            channels_[std::size_t(256 * alpha + value)] = converted[std::size_t(4 * value + toOrder_.red)];
    }
    placeOpaque();
    widen();
}

void ConversionTable::apply(const std::uint8_t* from, std::uint8_t* to, int count) const {
    if (words_.empty())
        convertChannels(from, to, count);
    else if (fromBytes_ == 1)
        convertWords<std::uint8_t>(from, to, count);
    else
        convertWords<std::uint16_t>(from, to, count);
}

template <class Word>
void ConversionTable::convertWords(const std::uint8_t* from, std::uint8_t* to, int count) const {
    const auto each = [&]<class Result>(Result) {
        for (int i = 0; i < count; ++i) {
            Word word;
            std::memcpy(&word, from + std::size_t(i) * sizeof(Word), sizeof(Word));
            const auto result = Result(words_[word]);
            std::memcpy(to + std::size_t(i) * sizeof(Result), &result, sizeof(Result));
        }
    };
    if (toBytes_ == 4)
        each(std::uint32_t());
    else if (toBytes_ == 2)
        each(std::uint16_t());
    else
        each(std::uint8_t());
}

void ConversionTable::placeOpaque() {
    const auto place = [&](int from, int to, const std::uint8_t* bytes) {
        for (std::size_t value = 0; value < 256; ++value) {
            std::array<std::uint8_t, 4> pixel{};
            pixel[std::size_t(to)] = bytes[value];
            std::memcpy(&placed_[std::size_t(from)][value], pixel.data(), 4);
        }
    };
    const std::uint8_t* const row = &channels_[std::size_t(alphaMask_) * 256];
    place(fromOrder_.red, toOrder_.red, row);
    place(fromOrder_.green, toOrder_.green, row);
    place(fromOrder_.blue, toOrder_.blue, row);
    place(fromOrder_.alpha, toOrder_.alpha, alphas_.data());
    const auto isZero = [](std::uint8_t byte) { return byte == 0; };
    isClearZero_ =
        alphaMask_ != 0 && alphas_[0] == 0 && std::ranges::all_of(channels_ | std::views::take(256), isZero);
}

void ConversionTable::widen() {
    std::array<std::uint8_t, 256> same;
    std::iota(same.begin(), same.end(), std::uint8_t(0));
    const bool isKept = alphas_ == same,
               isConstant = std::ranges::count(alphas_, alphas_[0]) == std::ptrdiff_t(alphas_.size());
    if (!isKept && !isConstant)
        return;
    places_[toOrder_.red] = fromOrder_.red;
    places_[toOrder_.green] = fromOrder_.green;
    places_[toOrder_.blue] = fromOrder_.blue;
    places_[toOrder_.alpha] = isKept ? fromOrder_.alpha : -1;
    added_ = isKept ? 0 : placed_[std::size_t(fromOrder_.alpha)][0];
    colors_.emplace(&channels_[std::size_t(alphaMask_) * 256], fromOrder_.alpha);
}

void ConversionTable::convertChannels(const std::uint8_t* from, std::uint8_t* to, int count) const {
    while (count > 0) {
        const int done =
            colors_ ? wide::lookUpBytes(from, to, count, *colors_, places_, added_, alphaMask_ != 0) : 0;
        from += 4 * std::ptrdiff_t(done);
        to += 4 * std::ptrdiff_t(done);
        count -= done;
        // Those that are not all opaque, or too few.
        const int single = std::min(count, 64);
        convertSingle(from, to, single);
        from += 4 * std::ptrdiff_t(single);
        to += 4 * std::ptrdiff_t(single);
        count -= single;
    }
}

void ConversionTable::convertSingle(const std::uint8_t* from, std::uint8_t* to, int count) const {
    for (int i = 0; i < count; ++i, from += 4, to += 4) {
        const std::uint8_t alpha = from[fromOrder_.alpha];
        if ((alpha & alphaMask_) == alphaMask_) {
            const std::uint32_t pixel =
                placed_[0][from[0]] | placed_[1][from[1]] | placed_[2][from[2]] | placed_[3][from[3]];
            std::memcpy(to, &pixel, 4);
            continue;
        }
        if (alpha == 0 && isClearZero_) {
            std::memset(to, 0, 4);
            continue;
        }
        const std::uint8_t* const row = &channels_[std::size_t(alpha) * 256];
        to[toOrder_.red] = row[from[fromOrder_.red]];
        to[toOrder_.green] = row[from[fromOrder_.green]];
        to[toOrder_.blue] = row[from[fromOrder_.blue]];
        to[toOrder_.alpha] = alphas_[alpha];
    }
}

}  // namespace vtm::openvg
