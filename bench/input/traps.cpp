#include "bench/input/traps.hpp"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <random>

#include <fmt/format.h>

namespace vtm::bench {
namespace {

using std::numbers::pi;

constexpr double side = 500;

/// The text of a file, and numbers that do not depend on the library's distributions.
class Writer {
public:
    explicit Writer(std::size_t n) : random_(n) {}

    double number(double from, double to) {
        return from + (to - from) * std::ldexp(double(random_() >> 11), -53);
    }
    std::string color() { return fmt::format("#{:06x}", random_() & 0xFFFFFFu); }

    template <class... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }
    /// A path from point to point.
    template <class PointAt>
    void line(std::size_t count, const char* attributes, const char* end, const PointAt& pointAt) {
        put("<path {} d=\"", attributes);
        for (std::size_t i = 0; i < count; ++i) {
            const auto [x, y] = pointAt(double(i));
            put("{}{:.4f},{:.4f}", i == 0 ? 'M' : 'L', x, y);
        }
        put("{}\"/>", end);
    }
    std::string svg() const {
        return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\">{1}</svg>",
                           side, text_);
    }

private:
    std::mt19937_64 random_;
    std::string text_;
};

struct At {
    double x, y;
};

At polar(double radius, double angle) {
    return {side / 2 + radius * std::sin(angle), side / 2 - radius * std::cos(angle)};
}

std::string circles(std::size_t n) {
    Writer w(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = w.number(0, side), y = w.number(0, side), r = w.number(2, 20);
        w.put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" fill-opacity=\".5\"/>", x, y, r,
              w.color());
    }
    return w.svg();
}

std::string star(std::size_t n) {
    Writer w(n);
    const std::size_t points = n | 1;
    w.line(points, "fill=\"#234\"", "Z",
           [&](double i) { return polar(240, 2 * pi * double(points / 2) * i / double(points)); });
    return w.svg();
}

std::string outlines(std::size_t n) {
    Writer w(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = w.number(249.5, 250.5), y = w.number(249.5, 250.5), r = w.number(199.5, 200.5);
        w.put("<circle cx=\"{:.4f}\" cy=\"{:.4f}\" r=\"{:.4f}\" fill=\"{}\" fill-opacity=\".5\"/>", x, y, r,
              w.color());
    }
    return w.svg();
}

std::string zigzag(std::size_t n) {
    Writer w(n);
    w.line(n + 1, "fill=\"none\" stroke=\"#a22\" stroke-width=\"2\"", "", [&](double i) {
        return At{5 + 490 * i / double(n), std::fmod(i, 2) == 0 ? 495.0 : 5.0};
    });
    return w.svg();
}

std::string miters(std::size_t n) {
    Writer w(n);
    w.line(n + 1, "fill=\"none\" stroke=\"#060\" stroke-width=\"20\" stroke-miterlimit=\"1000\"", "",
           [&](double i) {
               return At{5 + 490 * i / double(n), std::fmod(i, 2) == 0 ? 300.0 : 200.0};
           });
    return w.svg();
}

std::string grid(std::size_t n) {
    Writer w(n);
    w.put("<path fill=\"none\" stroke=\"#228\" stroke-width=\"{}\" d=\"", 0.3 * side / double(n));
    for (std::size_t i = 0; i < n; ++i)
        w.put("M{0:.4f},0V500M0,{0:.4f}H500", side * (double(i) + 0.5) / double(n));
    w.put("\"/>");
    return w.svg();
}

std::string groups(std::size_t n) {
    Writer w(n);
    for (std::size_t i = 0; i < n / 2; ++i) {
        const double x = w.number(0, 400), y = w.number(0, 400), width = w.number(5, 100),
                     height = w.number(5, 100);
        w.put(
            "<g opacity=\".9\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
            "fill=\"{}\"/>",
            x, y, width, height, w.color());
        const double cx = w.number(0, side), cy = w.number(0, side);
        w.put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"10\" fill=\"{}\"/></g>", cx, cy, w.color());
    }
    return w.svg();
}

std::string rays(std::size_t n) {
    Writer w(n);
    w.put("<path fill=\"none\" stroke=\"#000\" stroke-width=\".2\" d=\"");
    for (std::size_t i = 0; i < n; ++i) {
        const At to = polar(240, 2 * pi * double(i) / double(n));
        w.put("M250,250L{:.4f},{:.4f}", to.x, to.y);
    }
    w.put("\"/>");
    return w.svg();
}

std::string dashes(std::size_t n) {
    Writer w(n);
    const double rows = std::floor(std::sqrt(double(n))), gap = 490 * rows / double(n);
    w.line(std::size_t(2 * rows),
           fmt::format("fill=\"none\" stroke=\"#060\" stroke-width=\"1.5\" stroke-linecap=\"round\" "
                       "stroke-dasharray=\".01 {:.4f}\"",
                       gap)
               .c_str(),
           "", [&](double i) {
               const double row = std::floor(i / 2);
               return At{std::fmod(i + row, 2) == 0 ? 5.0 : 495.0, 5 + 490 * row / rows};
           });
    return w.svg();
}

std::string curve(std::size_t n) {
    Writer w(n);
    w.put("<path fill=\"#728\" fill-rule=\"evenodd\" d=\"M250,250");
    for (std::size_t i = 0; i < n; ++i) {
        const double a = w.number(0, side), b = w.number(0, side), c = w.number(0, side),
                     d = w.number(0, side);
        w.put("Q{:.2f},{:.2f} {:.2f},{:.2f}", a, b, c, d);
    }
    w.put("Z\"/>");
    return w.svg();
}

std::string polygons(std::size_t n) {
    Writer w(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = w.number(0, side), y = w.number(0, side);
        w.line(6, fmt::format("fill=\"{}\"", w.color()).c_str(), "Z", [&](double) {
            const double dx = w.number(-6, 6), dy = w.number(-6, 6);
            return At{x + dx, y + dy};
        });
    }
    return w.svg();
}

std::string gradients(std::size_t n) {
    Writer w(n);
    for (int g = 0; g < 8; ++g) {
        const std::string from = w.color(), to = w.color();
        w.put(
            "<linearGradient id=\"g{}\"><stop stop-color=\"{}\" stop-opacity=\".6\"/><stop offset=\"1\" "
            "stop-color=\"{}\"/></linearGradient>",
            g, from, to);
    }
    for (std::size_t i = 0; i < n; ++i) {
        const double x = w.number(0, 480), y = w.number(0, 480), width = w.number(2, 30),
                     height = w.number(2, 30);
        w.put("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"url(#g{})\"/>", x, y,
              width, height, i % 8);
    }
    return w.svg();
}

constexpr TrapFamily families[]{
    {"circles", "translucent circles", circles},
    {"star", "points of a star", star},
    {"outlines", "nearly coincident translucent circles", outlines},
    {"zigzag", "segments of a stroke, up and down", zigzag},
    {"miters", "segments of a wide stroke with miters", miters},
    {"grid", "lines each way, in one stroke", grid},
    {"groups", "shapes in translucent groups", groups},
    {"rays", "rays from one point, in one stroke", rays},
    {"dashes", "round dashes", dashes},
    {"curve", "segments of a random closed curve, even-odd", curve},
    {"polygons", "opaque hexagons that cross themselves", polygons},
    {"gradients", "translucent gradients", gradients},
};

}  // namespace

std::span<const TrapFamily> trapFamilies() { return families; }

}  // namespace vtm::bench
