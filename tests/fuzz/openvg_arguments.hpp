/// \file
/// Bytes as arguments of OpenVG calls: legal ones mostly, and every other kind.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include <VG/vgu.h>
#include <vtm/vg_image.h>

namespace vtm::fuzz {

/// Sides of images and surfaces are at most this.
inline constexpr int maxSide = 40;

struct Area {
    VGint x, y, width, height;
};

/// Numbers made of a sequence of bytes, 0 once it has ended.
class Arguments {
public:
    explicit Arguments(std::span<const std::uint8_t> bytes)
        : bytes_(bytes), floats_(floatCount), memory_(memoryBytes) {}

    bool atEnd() const { return next_ >= bytes_.size(); }
    unsigned byte() { return atEnd() ? 0 : bytes_[next_++]; }
    std::uint32_t word() {
        std::uint32_t word = 0;
        for (int i = 0; i < 4; ++i)
            word = word << 8 | byte();
        return word;
    }
    /// One time in `n`; n is at most 256.
    bool rarely(unsigned n = 24) { return byte() % n == n - 1; }

    VGint integer() {
        constexpr std::array<VGint, 12> extremes{INT32_MIN, INT32_MIN + 1, -65536, -1,    0,     1,
                                                 255,       256,           16384,  16385, 65536, INT32_MAX};
        return rarely() ? extremes[byte() % extremes.size()] : VGint(byte() % 48) - 4;
    }
    VGint side() { return rarely() ? integer() : VGint(byte() % maxSide) + 1; }
    Area area() { return {integer(), integer(), side(), side()}; }

    VGfloat number() {
        using Limits = std::numeric_limits<float>;
        constexpr std::array<VGfloat, 16> extremes{0.0f,
                                                   -0.0f,
                                                   1.0f,
                                                   Limits::max(),
                                                   -Limits::max(),
                                                   1e30f,
                                                   -1e30f,
                                                   1e18f,
                                                   Limits::denorm_min(),
                                                   Limits::min(),
                                                   1e-20f,
                                                   1e5f,
                                                   -1e10f,
                                                   Limits::infinity(),
                                                   -Limits::infinity(),
                                                   Limits::quiet_NaN()};
        if (!rarely(48))
            return VGfloat(int(byte()) - 96) / 4;
        if (!rarely(4))
            return extremes[byte() % extremes.size()];
        const std::uint32_t bits = word();
        float value;
        std::memcpy(&value, &bits, 4);
        return value;
    }
    VGfloat unit() { return rarely() ? number() : VGfloat(byte()) / 255; }

    /// One of the values first to last, or another that the type can hold.
    template <class Enum>
    Enum one(Enum first, Enum last) {
        return rarely() ? Enum(word() & 0x7fffffff)
                        : Enum(VGint(first) + VGint(byte() % unsigned(last - first + 1)));
    }
    VGbitfield bits(unsigned count) { return rarely() ? word() : byte() & ((1u << count) - 1); }
    VGboolean boolean() { return byte() & 1 ? VG_TRUE : VG_FALSE; }
    VGImageFormat format() {
        constexpr std::array<VGint, 4> orders{0, 1 << 6, 1 << 7, (1 << 6) | (1 << 7)};
        return rarely() ? VGImageFormat(word() & 0x7fffffff)
                        : VGImageFormat(VGint(byte() % 16) | (rarely(3) ? orders[byte() % 4] : 0));
    }

    /// `count` values, or none, or where no value can lie.
    const VGfloat* floats(VGint count, bool areUnits = false) {
        for (VGint i = 0; i < count && i < floatCount; ++i)
            floats_[std::size_t(i)] = areUnits ? unit() : number();
        return pointer(floats_.data());
    }
    const VGint* integers(VGint count) {
        auto* values = reinterpret_cast<VGint*>(memory_.data());
        for (VGint i = 0; i < count && i < floatCount; ++i)
            values[i] = integer();
        return pointer(values);
    }
    /// As many bytes as any table or kernel has.
    void* table() {
        for (std::size_t i = 0; i < 64; ++i)
            memory_[i * 16 + byte() % 16] = std::uint8_t(byte());
        return pointer(memory_.data());
    }
    /// How many values a setter is told to read: at most floatCount.
    VGint count() {
        constexpr std::array<VGint, 10> usual{0, 1, 2, 4, 4, 5, 8, 10, 12, 20};
        constexpr std::array<VGint, 6> unusual{-1, INT32_MIN, 3, 7, 1300, 2000};
        return rarely() ? unusual[byte() % unusual.size()] : usual[byte() % usual.size()];
    }
    VGfloat* results() { return pointer(floats_.data()); }
    VGint* integerResults() { return reinterpret_cast<VGint*>(pointer(memory_.data())); }

    /// Pixels in memory that a call with this area may touch: those of an image or surface of at most
    /// maxSide.
    struct Memory {
        void* data;
        VGint stride;
        Area area;
    };
    Memory pixels() {
        Memory m{memory_.data() + memoryBytes / 2, VGint(byte() * 2) - 128, area()};
        if (m.area.x < -8 || m.area.y < -8)
            m.area.width = m.area.height = VGint(byte() % 8);
        else if (m.area.height == 1 && rarely(4))
            m.stride = integer();
        if (rarely())
            m.data = rarely(2) ? nullptr : static_cast<std::uint8_t*>(m.data) + 1;
        return m;
    }

private:
    static constexpr VGint floatCount = 2000;
    static constexpr std::size_t memoryBytes = 1 << 16;

    template <class T>
    T* pointer(T* p) {
        if (!rarely(64))
            return p;
        return rarely(2) ? nullptr : reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(p) + 1);
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    std::vector<VGfloat> floats_;
    std::vector<std::uint8_t> memory_;
};

}  // namespace vtm::fuzz
