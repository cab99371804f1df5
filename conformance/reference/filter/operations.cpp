// Each formula as the specification writes it, pixel by pixel; nothing is fast here.

#include "conformance/reference/filter/operations.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/common.hpp>

#include <vtm/limits/limits.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm::reference {
namespace {

/// What is more transparent than a 1024th has no colour (docs/filters.md).
Colour straight(const Colour& c) {
    return c.a >= 1.0 / 1024 ? Colour(c.r / c.a, c.g / c.a, c.b / c.a, c.a) : Colour(0);
}
Colour multipliedByAlpha(const Colour& c) { return {c.r * c.a, c.g * c.a, c.b * c.a, c.a}; }
Colour limited(const Colour& c) { return glm::clamp(c, 0.0, 1.0); }

/// No channel above alpha.
Colour valid(const Colour& c) {
    const Colour l = limited(c);
    return glm::min(l, Colour(l.a));
}

Colour colourOf(const scene::Color& c, const Reading& in) {
    const Colour made = multipliedByAlpha({c.r, c.g, c.b, c.a});
    return in.linear ? linearised(made) : made;
}

}  // namespace

Pixels operate(const scene::BlendFilter& f, const Reading& in, Pixels result) {
    result.fill([&](int x, int y) { return blend(f.mode, in.inputs[1].get(x, y), in.inputs[0].get(x, y)); });
    return result;
}

Pixels operate(const scene::ColorMatrixFilter& f, const Reading& in, Pixels result) {
    result.fill([&](int x, int y) {
        const Colour c = straight(in.inputs[0].get(x, y));
        Colour made;
        for (int row = 0; row < 4; ++row) {
            const float* m = &f.matrix[std::size_t(row) * 5];
            made[row] = m[0] * c.r + m[1] * c.g + m[2] * c.b + m[3] * c.a + m[4];
        }
        return multipliedByAlpha(limited(made));
    });
    return result;
}

namespace {

double transferred(const scene::TransferFunction& f, double c) {
    using Kind = scene::TransferFunction::Kind;
    const std::vector<float>& v = f.values;
    if (f.kind == Kind::Linear)
        return v[0] * c + v[1];
    if (f.kind == Kind::Gamma)
        return v[0] * std::pow(c, v[1]) + v[2];
    if (v.empty())
        return c;
    const std::size_t count = v.size();
    if (f.kind == Kind::Discrete)
        return v[std::min(std::size_t(c * double(count)), count - 1)];
    const std::size_t n = count - 1;
    if (n == 0 || c >= 1)
        return v.back();
    const auto k = std::size_t(c * double(n));
    return v[k] + (c - double(k) / double(n)) * double(n) * (v[k + 1] - v[k]);
}

}  // namespace

Pixels operate(const scene::ComponentTransferFilter& f, const Reading& in, Pixels result) {
    result.fill([&](int x, int y) {
        const Colour c = limited(straight(in.inputs[0].get(x, y)));
        Colour made;
        for (int channel = 0; channel < 4; ++channel)
            made[channel] = transferred(f.functions[std::size_t(channel)], c[channel]);
        return multipliedByAlpha(limited(made));
    });
    return result;
}

Pixels operate(const scene::CompositeFilter& f, const Reading& in, Pixels result) {
    using Operator = scene::CompositeFilter::Operator;
    result.fill([&](int x, int y) -> Colour {
        const Colour a = in.inputs[0].get(x, y), b = in.inputs[1].get(x, y);
        switch (f.op) {
            case Operator::Over:
                return a + b * (1 - a.a);
            case Operator::In:
                return a * b.a;
            case Operator::Out:
                return a * (1 - b.a);
            case Operator::Atop:
                return a * b.a + b * (1 - a.a);
            case Operator::Xor:
                return a * (1 - b.a) + b * (1 - a.a);
            case Operator::Lighter:
                return limited(a + b);
            case Operator::Arithmetic:
                break;
        }
        return valid(double(f.k[0]) * a * b + double(f.k[1]) * a + double(f.k[2]) * b + double(f.k[3]));
    });
    return result;
}

namespace {

/// An input with what its edge mode has beyond it.
Colour beyond(const Pixels& input, const Rectangle& region, scene::EdgeMode mode, int x, int y) {
    constexpr double rounding = 1e-6;
    const int left = int(std::floor(region.min.x + rounding)), top = int(std::floor(region.min.y + rounding)),
              right = int(std::ceil(region.max.x - rounding)),
              bottom = int(std::ceil(region.max.y - rounding));
    const bool inside = x >= left && x < right && y >= top && y < bottom;
    if (inside)
        return input.get(x, y);
    if (mode == scene::EdgeMode::None || right <= left || bottom <= top)
        return Colour(0);
    if (mode == scene::EdgeMode::Duplicate)
        return input.get(std::clamp(x, left, right - 1), std::clamp(y, top, bottom - 1));
    const auto wrapped = [](int v, int from, int size) { return from + (((v - from) % size) + size) % size; };
    return input.get(wrapped(x, left, right - left), wrapped(y, top, bottom - top));
}

}  // namespace

/// RESULT(x, y) = Σ SOURCE(x - targetX + j, y - targetY + i) kernel(orderX - j - 1, orderY - i - 1) / divisor
/// + bias · ALPHA(x, y).
Pixels operate(const scene::ConvolveMatrixFilter& f, const Reading& in, Pixels result) {
    const int columns = int(f.columns), rows = int(f.rows);
    result.fill([&](int x, int y) {
        limits::check();
        Colour sum(0);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) {
                Colour c = beyond(in.inputs[0], in.regions[0], f.edge, x - int(f.targetX) + j,
                                  y - int(f.targetY) + i);
                if (f.preserveAlpha)
                    c = straight(c);
                sum += c * double(f.kernel[std::size_t((rows - i - 1) * columns + columns - j - 1)]);
            }
        const double alpha = in.inputs[0].get(x, y).a;
        const Colour made = sum / double(f.divisor) + double(f.bias) * (f.preserveAlpha ? 1 : alpha);
        if (!f.preserveAlpha)
            return valid(made);
        return multipliedByAlpha(limited({made.r, made.g, made.b, alpha}));
    });
    return result;
}

Pixels operate(const scene::DisplacementMapFilter& f, const Reading& in, Pixels result) {
    result.fill([&](int x, int y) {
        const Colour c = straight(in.inputs[1].get(x, y));
        return in.inputs[0].interpolated(x + 0.5 + f.scale * in.frame.scale.x * (c[int(f.x)] - 0.5),
                                         y + 0.5 + f.scale * in.frame.scale.y * (c[int(f.y)] - 0.5));
    });
    return result;
}

Pixels operate(const scene::FloodFilter& f, const Reading& in, Pixels result) {
    const Colour colour = colourOf(f.color, in);
    result.fill([&](int, int) { return colour; });
    return result;
}

namespace {

/// Sampled and normalised, to six deviations: 2e-9.
std::vector<double> gaussian(double deviation) {
    std::vector<double> weights;
    const int reach = deviation > 0 ? int(std::ceil(6 * deviation)) : 0;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) {
        weights.push_back(deviation > 0 ? std::exp(-i * i / (2 * deviation * deviation)) : 1);
        sum += weights.back();
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

Pixels blurred(const Pixels& input, glm::dvec2 deviation) {
    const std::vector<double> across = gaussian(deviation.x), down = gaussian(deviation.y);
    const int reachX = int(across.size()) / 2, reachY = int(down.size()) / 2;
    Pixels rows = input.blank(), result = input.blank();
    rows.fill([&](int x, int y) {
        Colour sum(0);
        for (int i = -reachX; i <= reachX; ++i)
            sum += across[std::size_t(i + reachX)] * input.get(x + i, y);
        return sum;
    });
    result.fill([&](int x, int y) {
        Colour sum(0);
        for (int i = -reachY; i <= reachY; ++i)
            sum += down[std::size_t(i + reachY)] * rows.get(x, y + i);
        return sum;
    });
    return result;
}

/// With more room round it: only what is left at the end is cut to the subregion.
Pixels padded(const Pixels& input, glm::dvec2 room) {
    const int x = int(std::ceil(room.x)) + 1, y = int(std::ceil(room.y)) + 1;
    Pixels result(input.x0 - x, input.y0 - y, input.width + 2 * x, input.height + 2 * y);
    result.fill([&](int column, int row) { return input.get(column, row); });
    return result;
}

/// Moved by any distance: whole pixels as they are, the rest interpolated.
Pixels moved(const Pixels& input, glm::dvec2 by) {
    Pixels result = input.blank();
    result.fill([&](int x, int y) { return input.interpolated(x + 0.5 - by.x, y + 0.5 - by.y); });
    return result;
}

}  // namespace

Pixels operate(const scene::GaussianBlurFilter& f, const Reading& in, Pixels) {
    return blurred(in.inputs[0], glm::dvec2(f.deviationX, f.deviationY) * in.frame.scale);
}

Pixels operate(const scene::DropShadowFilter& f, const Reading& in, Pixels result) {
    const glm::dvec2 by = glm::dvec2(f.dx, f.dy) * in.frame.scale,
                     deviation = glm::dvec2(f.deviationX, f.deviationY) * in.frame.scale;
    const Pixels shadow = blurred(moved(padded(in.inputs[0], glm::abs(by) + 6.0 * deviation), by), deviation);
    const Colour colour = colourOf(f.color, in);
    result.fill([&](int x, int y) {
        const Colour own = in.inputs[0].get(x, y);
        return own + colour * shadow.get(x, y).a * (1 - own.a);
    });
    return result;
}

Pixels operate(const scene::MergeFilter&, const Reading& in, Pixels result) {
    for (const Pixels& input : in.inputs)
        result.fill([&](int x, int y) { return over(result.get(x, y), input.get(x, y)); });
    return result;
}

namespace {

/// The extreme of 2r + 1 pixels along an axis; between whole radii it is interpolated.
Pixels extremes(const Pixels& input, double radius, bool isDown, bool dilates) {
    const auto whole = [&](int r) {
        Pixels result = input.blank();
        result.fill([&](int x, int y) {
            Colour extreme(dilates ? 0 : 1);
            for (int i = -r; i <= r; ++i) {
                const Colour c = isDown ? input.get(x, y + i) : input.get(x + i, y);
                extreme = dilates ? glm::max(extreme, c) : glm::min(extreme, c);
            }
            return extreme;
        });
        return result;
    };
    const int low = int(std::floor(radius));
    const double share = radius - low;
    const Pixels below = whole(low), above = share > 0 ? whole(low + 1) : below;
    Pixels result = input.blank();
    result.fill([&](int x, int y) { return (1 - share) * below.get(x, y) + share * above.get(x, y); });
    return result;
}

}  // namespace

Pixels operate(const scene::MorphologyFilter& f, const Reading& in, Pixels) {
    const Pixels rows = extremes(in.inputs[0], f.radiusX * in.frame.scale.x, false, f.dilate);
    return extremes(rows, f.radiusY * in.frame.scale.y, true, f.dilate);
}

Pixels operate(const scene::OffsetFilter& f, const Reading& in, Pixels) {
    return moved(in.inputs[0], glm::dvec2(f.dx, f.dy) * in.frame.scale);
}

Pixels operate(const scene::TileFilter&, const Reading& in, Pixels result) {
    const Rectangle& tile = in.regions[0];
    const glm::dvec2 size = tile.max - tile.min;
    if (!(size.x > 0 && size.y > 0))
        return result;
    result.fill([&](int x, int y) {
        const glm::dvec2 from = glm::dvec2(x + 0.5, y + 0.5) - tile.min;
        const glm::dvec2 at = tile.min + from - size * glm::floor(from / size);
        return in.inputs[0].get(int(std::floor(at.x)), int(std::floor(at.y)));
    });
    return result;
}

}  // namespace vtm::reference
