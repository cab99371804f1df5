/// \file
/// Conversions of many pixels from one format to another by tables, which are made by converting every value
/// once: results are the same, byte for byte.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "api/openvg/image/byte_rows.hpp"
#include "api/openvg/image/pixel_rows.hpp"

namespace vtm::openvg {

class ConversionTable {
public:
    /// Of convertRow() or takeRow(). Kept for the next call. Null where pixels have too many values for a
    /// table.
    static std::shared_ptr<const ConversionTable> of(const PixelFormat& from, const PixelFormat& to,
                                                     RowConversion* convert);

    ConversionTable(const PixelFormat& from, const PixelFormat& to, RowConversion* convert);

    void apply(const std::uint8_t* from, std::uint8_t* to, int count) const;

private:
    void addWords(const PixelFormat& from, const PixelFormat& to, RowConversion* convert);
    void addChannels(const PixelFormat& from, const PixelFormat& to, RowConversion* convert);
    void placeOpaque();
    void widen();
    template <class Word>
    void convertWords(const std::uint8_t* from, std::uint8_t* to, int count) const;
    void convertChannels(const std::uint8_t* from, std::uint8_t* to, int count) const;
    void convertSingle(const std::uint8_t* from, std::uint8_t* to, int count) const;

    std::size_t fromBytes_, toBytes_;
    /// Pixels of up to 16 bits: what each becomes.
    std::vector<std::uint32_t> words_;
    /// Of four bytes: what a colour's byte becomes beside each byte of alpha, where that matters.
    ByteOrder fromOrder_{}, toOrder_{};
    std::uint8_t alphaMask_ = 0;
    std::vector<std::uint8_t> channels_;
    std::array<std::uint8_t, 256> alphas_{};
    /// What each of a pixel's bytes becomes, in its place, where alpha does not matter or is 255.
    std::array<std::array<std::uint32_t, 256>, 4> placed_{};
    bool isClearZero_ = false;  ///< pixels without alpha become 0
    /// The same eight pixels at a time, where alpha stays or is the same in all.
    std::optional<wide::ByteTable> colors_;
    int places_[4] = {};
    std::uint32_t added_ = 0;
};

}  // namespace vtm::openvg
