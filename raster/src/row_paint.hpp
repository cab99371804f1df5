/// \file
/// Paint programs made ready for rows of a view's pixels: gradients and solid colours over each other. Away
/// from hard stops the mean of a gradient over a pixel is the colour in its middle; opacity and solid colours
/// are the same for all pixels. So such a gradient is a ramp of premultiplied colours, each segment of which
/// is a polynomial of u.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "raster/src/float4.hpp"
#include "raster/src/gradient.hpp"
#include "raster/src/paint.hpp"

namespace vtm::asset {

/// The middles of a view's pixels in the picture.
struct PixelMiddles {
    glm::dvec2 first, right, down;  ///< of pixel (0, 0); the steps to the next ones
    int width, height;
};

/// One gradient, with the solid colours under and over it.
class RowGradient {
public:
    struct Pixel {
        int x, row;
    };
    /// What the gradient becomes.
    struct Solids {
        Float4 below{}, above{};
        float opacity = 1;  ///< of the gradient

        Float4 color(Float4 gradient) const { return over(above, over(opacity * gradient, below)); }
        Float4 change(Float4 gradient) const { return color(gradient) - color(Float4{}); }
    };

    /// Returns whether it can do more than leave all pixels to others. Keeps the memory that it had.
    bool prepare(const GradientView& gradient, bool isRadial, const Solids& solids,
                 const PixelMiddles& pixels);

    /// Sets the mean over a pixel; false if it is not known here.
    bool at(Pixel pixel, Float4& color) {
        if (isRadial_ && radial_.isNear(pixel))
            return false;
        const float u = isRadial_ ? radial_.at(pixel) : linear_.at(pixel);
        const Segment& segment = find(u);
        if (segment.shape == Shape::Mixed)
            return false;
        color = segment.shape == Shape::Turning ? segment.turned(u, widthAt(pixel, u)) : segment.at(u);
        return true;
    }
    /// Visits no more than longestRow pixels of a row, from the left: constant(first, end, colour),
    /// some(first, colours), or others(first, end) where the mean over a pixel is not known here. Pixels are
    /// counted from 0.
    template <class Constant, class Some, class Others>
    void visit(Pixel first, std::size_t count, Constant&& constant, Some&& some, Others&& others) {
        std::array<Float4, longestRow> memory;
        const auto visit = [&](std::size_t from, std::size_t size, const Segment& segment,
                               const auto& offsets) {
            if (segment.shape == Shape::Constant)
                return constant(from, from + size, segment.color);
            if (segment.shape == Shape::Mixed)
                return others(from, from + size);
            const std::span<Float4> colors = std::span(memory).first(size);
            if (segment.shape == Shape::Turning)
                for (std::size_t i = 0; i < size; ++i)
                    colors[i] =
                        segment.turned(offsets[i], widthAt({first.x + int(from + i), first.row}, offsets[i]));
            else
                segment.fill(offsets, colors);
            some(from, std::span<const Float4>(colors));
        };
        if (isRadial_)
            visitRadial(first, count, visit, others);
        else if (Float4 color; !linear_.isEven(first, count))
            visitLinear(first, count, visit);
        else if (at(first, color))
            constant(0, count, color);
        else
            others(0, count);
    }

private:
    enum class Shape : std::uint8_t { Constant, Straight, Curved, Turning, Mixed };
    /// Along a row.
    struct Steps {
        float first, change;

        float operator[](std::size_t i) const { return first + float(int(i)) * change; }
    };
    using Offsets = std::span<const float>;

    /// Of the ramp, from `low` to below `high`: with x = u - start, color + x slope + x² bend. Turning: and
    /// from `stop` on, with x = u - stop, x turn + x² turnBend.
    struct Segment {
        float low, high, start, stop;
        Shape shape;
        Float4 color, slope, bend, turn, turnBend;

        Float4 at(float u) const {
            const float x = u - start;
            return color + x * (slope + x * bend);
        }
        /// The mean where u is even over `width` to both sides of that in the middle. At a distance y from
        /// where the pixel meets the stop, the mean of x is y² / (4 width), that of x² y³ / (6 width), which
        /// is y²/2 - width y/3 but for 0.064 width².
        Float4 turned(float u, float width) const {
            const float y = std::clamp(u - stop + width, 0.0f, 2 * width),
                        rest = std::max(u - stop - width, 0.0f);
            const float once = width > 0 ? y * y / (4 * width) : 0;
            return at(u) + (once + rest) * turn +
                   (y * (0.5f * y - width / 3) + rest * (2 * width + rest)) * turnBend;
        }
        bool holds(float u) const { return u >= low && u < high; }
        /// Those, from the first on, that it holds; the first in any case.
        Offsets held(Offsets offsets) const;
        /// The same of a row.
        std::size_t held(const Steps& steps, std::size_t maximum) const {
            const float held = ((steps.change > 0 ? high : low) - steps.first) / steps.change;
            return held < float(maximum) ? std::min(std::size_t(std::max(held, 0.0f)) + 1, maximum) : maximum;
        }
        void fill(const Steps& steps, std::span<Float4> colors) const;
        void fill(Offsets offsets, std::span<Float4> colors) const;
    };
    template <class Visit>
    void visitLinear(Pixel first, std::size_t count, Visit&& visit) {
        for (std::size_t i = 0; i < count;) {
            const Steps steps{linear_.at({first.x + int(i), first.row}), float(linear_.right)};
            const Segment& segment = find(steps.first);
            const std::size_t held = segment.held(steps, count - i);
            visit(i, held, segment, steps);
            i += held;
        }
    }
    template <class Visit, class Others>
    void visitRadial(Pixel first, std::size_t count, Visit&& visit, Others&& others) {
        std::array<float, longestRow> memory;
        const std::span<float> offsets = std::span(memory).first(count);
        const PixelRange near = radialOffsets(first, offsets);
        const auto visitFar = [&](std::size_t i, std::size_t end) {
            while (i < end) {
                const Segment& segment = find(offsets[i]);
                const Offsets held = segment.held(offsets.subspan(i, end - i));
                visit(i, held.size(), segment, held);
                i += held.size();
            }
        };
        visitFar(0, near.first);
        if (near.first < near.end)
            others(near.first, near.end);
        visitFar(near.end, count);
    }

    /// Returns those pixels that are so near the tip that the mean of u over them is another one.
    PixelRange radialOffsets(Pixel first, std::span<float> offsets) const;
    /// Over how much u is spread to both sides in a pixel, in whose middle it is `u`.
    float widthAt(Pixel pixel, float u) const { return isRadial_ ? radialWidth(pixel, u) : linear_.width; }
    float radialWidth(Pixel pixel, float u) const;
    const Segment& find(float u) {
        while (u < segments_[last_].low)
            --last_;
        while (u >= segments_[last_].high && last_ + 1 < segments_.size())
            ++last_;
        return segments_[last_];
    }

    struct Linear {
        double first, right, down;  ///< u of pixel (0, 0), and what steps to the next ones change it by
        float width;                ///< over so much to both sides u is spread in a pixel

        float at(Pixel pixel) const { return float(first + pixel.x * right + pixel.row * down); }
        /// Whether pixels of a row have the same u, as under a vertical gradient.
        bool isEven(Pixel from, std::size_t count) const {
            return at(from) == at({from.x + int(count) - 1, from.row});
        }
    };
    /// Circles that lie within each other: u = b + sqrt(b² + c) (gradient.cpp).
    struct Radial {
        glm::dvec2 first, right, down;  ///< of pixels, from the focus
        NestedCircles circles;
        float nearSquared, pixel;

        glm::vec2 fromFocus(Pixel at) const { return first + double(at.x) * right + double(at.row) * down; }
        bool isNear(Pixel at) const {
            const glm::vec2 d = fromFocus(at);
            return glm::dot(d, d) <= nearSquared;
        }
        float at(Pixel place) const {
            const glm::vec2 d = fromFocus(place);
            const float b = circles.b(d.x, d.y);
            return b + circles.root(b, glm::dot(d, d));
        }
    };
    /// How u is spread over a pixel; largest values.
    struct Blur {
        float reach;   ///< from the middle
        float length;  ///< of the vector of what the sides change u by
        float width;   ///< as if it were even over so much to both sides
        float variance, varianceError;
    };
    /// Where two stretches meet. Up to `margin` from the stop, means are those of `segment`.
    struct Joint {
        float margin;
        Segment segment;
    };
    static Segment mixed(float low, float high);
    /// Of u.
    struct Range {
        float low, high;
    };
    /// Of a ramp, straight.
    struct Stop {
        float offset;
        Float4 color;
    };

    static std::vector<Stop> stopsIn(const GradientView& gradient, const Range& range);
    Blur prepareLinear(const Gradient& gradient, const PixelMiddles& pixels);
    Blur prepareRadial(const Gradient& gradient, const PixelMiddles& pixels);
    Range offsetsIn(const PixelMiddles& pixels) const;
    void makeSegments(std::span<const Stop> stops, Spread spread, const Blur& blur, const Solids& solids);
    static Joint jointOf(const Segment& one, const Segment& next, const Blur& blur);
    void limitTip(float change);
    /// If it is not empty; and a Mixed one before it, if there is a gap.
    void add(Segment segment, const Solids& solids);

    std::vector<Segment> segments_;  ///< from -infinity to infinity
    std::size_t last_ = 0;           ///< that was found
    bool isRadial_ = false;
    Linear linear_{};
    Radial radial_{};
};

class RowPaint {
public:
    using Pixel = RowGradient::Pixel;

    /// Keeps the memory that it had.
    void prepare(const Paints& paints, std::uint32_t paint, const PixelMiddles& pixels);

    /// False if it would leave all pixels to others.
    bool isReady() const { return size_ > 0; }

    /// Sets the mean over a pixel; false if it is not known here.
    bool at(Pixel pixel, Float4& color) {
        if (!isReady() || !layers_[0].at(pixel, color))
            return false;
        for (std::size_t k = 1; k < size_; ++k) {
            Float4 above;
            if (!layers_[k].at(pixel, above))
                return false;
            color = over(above, color);
        }
        return true;
    }
    /// Visits pixels of a row from the left as RowGradient::visit() does; all are for others if it is not
    /// ready.
    template <class Constant, class Some, class Others>
    void visit(int row, int first, int end, Constant&& constant, Some&& some, Others&& others) {
        for (; first < end; first += int(longestRow)) {
            const auto count = std::min(longestRow, std::size_t(end - first));
            const auto at = [&](std::size_t i) { return first + int(i); };
            const auto someAt = [&](std::size_t from, std::span<const Float4> colors) {
                some(at(from), colors);
            };
            const auto othersAt = [&](std::size_t from, std::size_t to) { others(at(from), at(to)); };
            if (size_ == 1)
                layers_[0].visit(
                    {first, row}, count,
                    [&](std::size_t from, std::size_t to, Float4 color) {
                        constant(at(from), at(to), color);
                    },
                    someAt, othersAt);
            else if (size_ == 0)
                othersAt(0, count);
            else
                visitStack({first, row}, count, someAt, othersAt);
        }
    }

private:
    template <class Some, class Others>
    void visitStack(Pixel pixel, std::size_t count, Some&& some, Others&& others) {
        std::array<Float4, longestRow> colors;
        std::uint64_t left = compose(pixel, std::span(colors).first(count));  // a bit a pixel
        for (std::size_t i = 0; i < count;) {
            const bool isLeft = (left >> i & 1) != 0;
            const std::size_t first = i;
            while (i < count && (left >> i & 1) == std::uint64_t(isLeft))
                ++i;
            if (isLeft)
                others(first, i);
            else
                some(first, std::span<const Float4>(colors).subspan(first, i - first));
        }
    }
    /// Returns those that are left to others.
    std::uint64_t compose(Pixel first, std::span<Float4> colors);
    bool addLayer(const GradientView& gradient, bool isRadial, const RowGradient::Solids& solids,
                  const PixelMiddles& pixels);

    std::vector<RowGradient> layers_;  ///< the first of which are used
    std::size_t size_ = 0;
};

/// Those of one view, made for paints that have long runs of pixels: few pixels do not pay for it.
class RowPaints {
public:
    /// Takes time for those that were made alone.
    void reset(std::size_t paints) {
        for (const std::uint32_t paint : made_)
            numbers_[paint] = 0;
        made_.clear();
        numbers_.resize(std::max(numbers_.size(), paints));
    }
    RowPaint& make(const Paints& paints, std::uint32_t paint, const PixelMiddles& pixels) {
        std::uint32_t& number = numbers_[paint];
        if (number == 0) {
            made_.push_back(paint);
            number = std::uint32_t(made_.size());
            if (rows_.size() < made_.size())
                rows_.emplace_back();
            rows_[number - 1].prepare(paints, paint, pixels);
        }
        return rows_[number - 1];
    }

private:
    std::vector<RowPaint> rows_;          ///< the first of which are used
    std::vector<std::uint32_t> numbers_;  ///< by paint: in rows_ and 1
    std::vector<std::uint32_t> made_;     ///< paints
};

}  // namespace vtm::asset
