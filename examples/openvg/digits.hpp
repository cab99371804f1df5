/// \file
/// Numbers of seven segments, as paths.
#pragma once

#include <array>
#include <string>

#include <VG/openvg.h>

namespace digits {

/// Needs a current context, for its whole life.
class Digits {
public:
    Digits();
    ~Digits();
    Digits(const Digits&) = delete;
    Digits& operator=(const Digits&) = delete;

    /// Fills `number` (digits and spaces) with the current paint, its middle at (x, y), `height` high,
    /// leaning a little. Multiplies the path matrix while it draws.
    void draw(const std::string& number, VGfloat x, VGfloat y, VGfloat height) const;

private:
    std::array<VGPath, 10> paths_;
};

}  // namespace digits
