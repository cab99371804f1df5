#include <glm/common.hpp>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/coverage/rows.hpp"

namespace vtm::reference {
namespace {

/// Area (pixels) below which a trapezoid is rounding.
constexpr double negligibleArea = 1e-15;
/// Samples a side of the pixel that show whether a smooth paint needs more.
constexpr int fewSamples = 8;
/// Where the few differ by less than this in every channel, even a hard edge among them is averaged to
/// 1/16 of it: 1/1024.
constexpr double smoothRange = 1.0 / 64;

Trapezoid wholePixel(int column, int y) {
    return {double(y), y + 1.0, double(column), double(column), column + 1.0, column + 1.0};
}

Point centreOf(const Trapezoid& t) {
    return {(t.left0 + t.left1 + t.right0 + t.right1) / 4, (t.y0 + t.y1) / 2};
}

struct Mean {
    Colour colour;
    Colour range;  ///< largest minus smallest sample
};

/// The mean over a trapezoid by the midpoint rule, with n samples for each pixel's width and height.
Mean meanOver(const Trapezoid& t, int n, Sampler& sampler) {
    Colour sum(0), low(1), high(0);
    double weights = 0;
    const int rows = std::max(1, int(std::ceil((t.y1 - t.y0) * n)));
    for (int i = 0; i < rows; ++i) {
        limits::check();
        const double share = (i + 0.5) / rows, y = t.y0 + share * (t.y1 - t.y0);
        const double left = t.left0 + share * (t.left1 - t.left0);
        const double width = std::max(0.0, t.right0 + share * (t.right1 - t.right0) - left);
        const int columns = std::max(1, int(std::ceil(width * n)));
        const Vector size(width / columns, (t.y1 - t.y0) / rows);
        for (int k = 0; k < columns; ++k) {
            const Point centre(left + (k + 0.5) * size.x, y);
            const Colour colour = sampler.colourOver({centre, size});
            sum += colour * size.x;
            low = glm::min(low, colour);
            high = glm::max(high, colour);
        }
        weights += width;
    }
    return {weights > 0 ? sum / weights : low, high - low};
}

class ExactRegions final : public Regions {
public:
    ExactRegions(Sampler& sampler, int samples, int y, Colour* row)
        : sampler_(sampler), samples_(samples), y_(y), row_(row) {}

    void cross(int shape, int winding) override { sampler_.cross(shape, winding); }

    void run(int begin, int end) override {
        const Colour colour = sampler_.colourOver({{begin + 0.5, y_ + 0.5}});
        if (sampler_.variation() == Variation::Constant) {
            std::fill(row_ + begin, row_ + end, colour);
            return;
        }
        for (int column = begin; column < end; ++column)
            row_[column] = varyingColour(wholePixel(column, y_));
    }

    void part(int column, const Trapezoid& trapezoid) override {
        const double area = trapezoid.area();
        if (!(area > negligibleArea))
            return;
        Colour colour = sampler_.colourOver({centreOf(trapezoid)});
        if (sampler_.variation() != Variation::Constant)
            colour = varyingColour(trapezoid);
        row_[column] += colour * area;
    }

private:
    Colour varyingColour(const Trapezoid& trapezoid) {
        if (samples_ <= fewSamples || sampler_.variation() == Variation::Rough)
            return meanOver(trapezoid, samples_, sampler_).colour;
        const Mean few = meanOver(trapezoid, fewSamples, sampler_);
        const double range = std::max({few.range.r, few.range.g, few.range.b, few.range.a});
        return range < smoothRange ? few.colour : meanOver(trapezoid, samples_, sampler_).colour;
    }

    Sampler& sampler_;
    int samples_, y_;
    Colour* row_;
};

}  // namespace

ExactRows::ExactRows(const FlatScene& picture, int samples)
    : sampler_(picture), sweep_(picture.width), samples_(samples) {}

void ExactRows::render(std::span<const EdgePart> parts, int y, Colour* row) {
    ExactRegions regions(sampler_, samples_, y, row);
    sweep_.sweep(parts, y, regions);
}

}  // namespace vtm::reference
