/// \file
/// The pictures that filters read and make, in doubles.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "conformance/reference/paint/blend.hpp"

namespace vtm::reference {

/// Premultiplied colours of pixels [x0, x0 + width) × [y0, y0 + height); transparent beyond.
struct Pixels {
    int x0 = 0, y0 = 0, width = 0, height = 0;
    std::vector<Colour> colours;

    Pixels() = default;
    Pixels(int left, int top, int w, int h)
        : x0(left), y0(top), width(w), height(h), colours(std::size_t(w) * std::size_t(h), Colour(0)) {}
    /// Transparent, of the same place.
    Pixels blank() const { return {x0, y0, width, height}; }

    bool holds(int x, int y) const { return x >= x0 && y >= y0 && x < x0 + width && y < y0 + height; }
    Colour& at(int x, int y) {
        return colours[std::size_t(y - y0) * std::size_t(width) + std::size_t(x - x0)];
    }
    Colour get(int x, int y) const {
        return holds(x, y) ? colours[std::size_t(y - y0) * std::size_t(width) + std::size_t(x - x0)]
                           : Colour(0);
    }
    /// Between the centres of four pixels.
    Colour interpolated(double x, double y) const;

    /// Replaces each colour by make(x, y).
    template <class Make>
    void fill(Make make) {
        for (int y = y0; y < y0 + height; ++y)
            for (int x = x0; x < x0 + width; ++x)
                at(x, y) = make(x, y);
    }
};

/// What a filter works on: pixel = scale · point of the user space + origin.
struct Frame {
    glm::dvec2 scale{1}, origin{0};
    glm::dvec2 pixel(glm::dvec2 user) const { return scale * user + origin; }
};

/// A rectangle in pixels.
struct Rectangle {
    glm::dvec2 min{0}, max{0};
    /// How much of a pixel lies in it.
    double share(int x, int y) const;
};

Colour linearised(const Colour& colour);
Colour encoded(const Colour& colour);

}  // namespace vtm::reference
