/// \file
/// Numbers of a scene made of a sequence of bytes: few bytes each, so that a mutation changes one thing.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>

namespace vtm::fuzz {

/// Zeros follow once the bytes have ended.
class ByteNumbers {
public:
    explicit ByteNumbers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool atEnd() const { return next_ >= bytes_.size(); }
    unsigned byte() { return atEnd() ? 0 : bytes_[next_++]; }
    /// In [0, n), n <= 256.
    unsigned below(unsigned n) { return byte() % n; }
    /// One time in `n`; never once the bytes have ended.
    bool rarely(unsigned n) { return below(n) == n - 1; }
    /// In [0, 1]; 1 often.
    float share() {
        const unsigned b = byte();
        return b >= 128 ? 1.0f : float(b) / 127;
    }
    /// One of an enumeration's values, 0 to last.
    template <class Enum>
    Enum any(Enum last) {
        return static_cast<Enum>(below(unsigned(last) + 1));
    }
    /// Between 2^-(n - 1) and 1.
    double magnitude(unsigned n) { return std::ldexp(1.0 - double(below(64)) / 128, -int(below(n))); }

    /// Of a picture `side` units wide: mostly on a coarse grid, so that edges and vertices coincide; the
    /// number before, or one that is a hair off; any; rarely far outside, which sets isFar().
    double coordinate(double side) {
        const unsigned kind = byte();
        if (kind < 176)
            last_ = side * (double(kind) - 16) / 144;
        else if (kind < 200)
            last_ += std::ldexp(side, -int(8 + below(40))) * (kind % 2 == 0 ? 1 : -1);
        else if (kind < 248)
            last_ = side * (double(byte() << 8 | byte()) / 65536 * 1.5 - 0.25);
        else if (kind < 255)
            setFar(side, below(6));
        return last_;
    }
    scene::Point point(double side) {
        const double x = coordinate(side);
        return {x, coordinate(side)};
    }
    /// Whether a coordinate was far outside since forgetFar().
    bool isFar() const { return isFar_; }
    void forgetFar() { isFar_ = false; }
    /// Whether any was so far outside that doubles do not resolve the picture there.
    bool isWild() const { return isWild_; }

    /// Mostly none; turned, leant, mirrored, shrunk or enlarged about a point.
    scene::Affine transform(double side) {
        if (!rarely(4))
            return scene::identity;
        const auto entry = [&] { return (double(byte()) - 128) / 64 * (rarely(16) ? magnitude(60) : 1); };
        const glm::dvec2 x{entry(), entry()}, y{entry(), entry()};
        const scene::Point about = point(side);
        return {x, y, about - x * about.x - y * about.y};
    }

private:
    void setFar(double side, unsigned which) {
        constexpr std::array distances{1e3, -1e3, 1e5, -1e7, 1e15, -1e30};
        last_ = side * distances[which];
        isFar_ = true;
        isWild_ |= which >= 4;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    double last_ = 0;
    bool isFar_ = false, isWild_ = false;
};

}  // namespace vtm::fuzz
