// Operations that read the pixels around each pixel.

#include <algorithm>
#include <cmath>

#include <vtm/limits/limits.hpp>
#include "raster/filter/operations.hpp"

namespace vtm::asset {

// ---- Convolution ----------------------------------------------------------------------------------

namespace {

/// An input that goes on beyond its subregion.
class EdgedLayer {
public:
    EdgedLayer(const Layer& layer, const PixelBox& region, FilterEdge edge)
        : layer_(layer), region_(region), edge_(edge) {}

    Float4 at(int x, int y) const {
        if (region_.contains(x, y))
            return layer_.at(x, y);
        if (edge_ == FilterEdge::None || region_.empty())
            return Float4{};
        if (edge_ == FilterEdge::Wrap)
            return layer_.at(wrapped(x, region_.min.x, region_.width()),
                             wrapped(y, region_.min.y, region_.height()));
        return layer_.at(std::clamp(x, region_.min.x, region_.max.x - 1),
                         std::clamp(y, region_.min.y, region_.max.y - 1));
    }

private:
    static int wrapped(int v, int min, int size) {
        const int rest = (v - min) % size;
        return min + (rest < 0 ? rest + size : rest);
    }

    const Layer& layer_;
    const PixelBox region_;
    const FilterEdge edge_;
};

}  // namespace

Layer convolve(const FilterStep& step) {
    const FilterParameters& p = step.parameters;
    const int columns = int(p[0]), rows = int(p[1]), targetX = int(p[2]), targetY = int(p[3]);
    const float scale = 1 / p[4], bias = p[5];
    const bool preservesAlpha = p[7] != 0;
    const FilterParameters kernel = p.from(8);
    const Layer straight =
        preservesAlpha ? changed(*step.inputs[0], step.inputs[0]->box, step.linear, straightened) : Layer();
    const Layer& source = preservesAlpha ? straight : *step.inputs[0];
    const EdgedLayer edged(source, step.regions[0].pixels(), FilterEdge(int(p[6])));
    Layer result(step.box, step.linear);
    for (int y = step.box.min.y; y < step.box.max.y; ++y) {
        limits::check();
        for (int x = step.box.min.x; x < step.box.max.x; ++x) {
            Float4 sum{};
            for (int i = 0; i < rows; ++i)
                for (int j = 0; j < columns; ++j)
                    sum += kernel[std::size_t((rows - 1 - i) * columns + (columns - 1 - j))] *
                           edged.at(x - targetX + j, y - targetY + i);
            const Float4 own = source.at(x, y);
            Float4 color = sum * scale + bias * (preservesAlpha ? 1.0f : own[3]);
            if (preservesAlpha) {
                color[3] = own[3];
                color = premultiplied(unit(color));
            } else {
                color = unit(color);
                for (int c = 0; c < 3; ++c)
                    color[c] = std::min(color[c], color[3]);
            }
            result.row(y)[x - step.box.min.x] = color;
        }
    }
    return result;
}

// ---- Morphology -----------------------------------------------------------------------------------

namespace {

struct Least {
    Float4 operator()(Float4 a, Float4 b) const { return a < b ? a : b; }
};
struct Largest {
    Float4 operator()(Float4 a, Float4 b) const { return a > b ? a : b; }
};

/// van Herk's and Gil and Werman's: extremes of windows of 2r + 1 at a cost that does not depend on r.
/// Extremes from the left and from the right within blocks of that length; a window reaches over two.
template <class Extreme>
class Windows {
public:
    /// out[i]: the extreme of line[i], …, line[i + 2 r]; line has 2 r more entries than out.
    void run(const std::vector<Float4>& line, int radius, Float4* out, int count, Extreme extreme) {
        const int window = 2 * radius + 1, length = count + 2 * radius;
        fromLeft_.resize(std::size_t(length));
        fromRight_.resize(std::size_t(length));
        for (int i = 0; i < length; ++i)
            fromLeft_[std::size_t(i)] = i % window == 0
                                            ? line[std::size_t(i)]
                                            : extreme(fromLeft_[std::size_t(i - 1)], line[std::size_t(i)]);
        for (int i = length - 1; i >= 0; --i)
            fromRight_[std::size_t(i)] = i % window == window - 1 || i == length - 1
                                             ? line[std::size_t(i)]
                                             : extreme(fromRight_[std::size_t(i + 1)], line[std::size_t(i)]);
        for (int i = 0; i < count; ++i)
            out[i] = extreme(fromRight_[std::size_t(i)], fromLeft_[std::size_t(i + 2 * radius)]);
    }

private:
    std::vector<Float4> fromLeft_, fromRight_;
};

/// A line of `count` windows of a radius in pixels. Between whole pixels it interpolates, so that an edge
/// moves by just the radius.
template <class Extreme>
class Lines {
public:
    explicit Lines(double radius)
        : low_(int(std::floor(radius))), share_(float(radius - std::floor(radius))) {}

    int reach() const { return low_ + (share_ > 0 ? 1 : 0); }
    /// `line` has 2 reach() more entries.
    void run(std::vector<Float4>& line, Float4* out, int count) {
        windows_.run(line, reach(), out, count, Extreme());
        if (share_ == 0)
            return;
        line.erase(line.begin());
        line.pop_back();
        inner_.resize(std::size_t(count));
        windows_.run(line, low_, inner_.data(), count, Extreme());
        for (int i = 0; i < count; ++i)
            out[i] = share_ * out[i] + (1 - share_) * inner_[std::size_t(i)];
    }

private:
    const int low_;
    const float share_;
    Windows<Extreme> windows_;
    std::vector<Float4> inner_;
};

template <class Extreme>
Layer extremes(const Layer& input, const PixelBox& box, double radiusX, double radiusY) {
    Lines<Extreme> across(radiusX), down(radiusY);
    const PixelBox tall = box.grown({0, down.reach()});
    Layer rows = Layer::unwritten(tall, input.linear);
    std::vector<Float4> line;
    for (int y = tall.min.y; y < tall.max.y; ++y) {
        limits::check();
        line.clear();
        for (int x = tall.min.x - across.reach(); x < tall.max.x + across.reach(); ++x)
            line.push_back(input.at(x, y));
        across.run(line, rows.row(y), rows.width());
    }
    Layer result(box, input.linear);
    std::vector<Float4> column(std::size_t(result.height()));
    for (int x = box.min.x; x < box.max.x; ++x) {
        limits::check();
        line.clear();
        for (int y = tall.min.y; y < tall.max.y; ++y)
            line.push_back(rows.row(y)[x - tall.min.x]);
        down.run(line, column.data(), result.height());
        for (int y = box.min.y; y < box.max.y; ++y)
            result.row(y)[x - box.min.x] = column[std::size_t(y - box.min.y)];
    }
    return result;
}

}  // namespace

Layer morphology(const FilterStep& step) {
    const FilterParameters& p = step.parameters;
    const PixelBox& source = step.inputs[0]->box;
    // Nothing changes beyond windows that hold the whole picture.
    const double radiusX = std::min(p[0] * step.scale.x, double(source.width() + step.box.width())),
                 radiusY = std::min(p[1] * step.scale.y, double(source.height() + step.box.height()));
    if (step.box.empty() || (radiusX == 0 && radiusY == 0))
        return cropped(*step.inputs[0], step.box);
    return p[2] != 0 ? extremes<Largest>(*step.inputs[0], step.box, radiusX, radiusY)
                     : extremes<Least>(*step.inputs[0], step.box, radiusX, radiusY);
}

}  // namespace vtm::asset
