/// \file
/// Numbers of OpenType's tables.
#pragma once

#include <hb.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace vtm::text {

inline std::span<const std::uint8_t> bytesOf(hb_blob_t* blob) {
    unsigned size = 0;
    const char* const bytes = hb_blob_get_data(blob, &size);
    return {reinterpret_cast<const std::uint8_t*>(bytes), size};
}

/// Big-endian numbers one after another; 0 beyond the end.
class TableCursor {
public:
    TableCursor(std::span<const std::uint8_t> table, std::size_t at) : table_(table), at_(at) {}

    std::uint32_t unsignedNumber(int bytes) {
        std::uint32_t value = 0;
        for (int i = 0; i < bytes; ++i, ++at_)
            value = value << 8 | (at_ < table_.size() ? table_[at_] : 0u);
        return value;
    }
    int word() { return static_cast<std::int16_t>(unsignedNumber(2)); }
    double fixed() { return static_cast<std::int32_t>(unsignedNumber(4)) / 65536.0; }
    /// F2DOT14, in [-2, 2).
    double fraction() { return word() / 16384.0; }

private:
    std::span<const std::uint8_t> table_;
    std::size_t at_;
};

}  // namespace vtm::text
