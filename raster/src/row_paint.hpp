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
#include "raster/src/row_colors.hpp"

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

    bool isRadial() const { return isRadial_; }
    /// Four pixels at once.
    using Pixels = std::array<Pixel, 4>;
    using Colors = std::array<Float4, 4>;
    /// Lays the means over pixels over others. Returns those of which they are known here, a bit each.
    unsigned layOver(const Pixels& pixels, Colors& colors);
    /// Of four pixels the parts that are to be drawn.
    struct Parts {
        Pixels pixels;
        Float4 right, down;  ///< their centroids, from the pixels' middles
    };
    /// What layers change by over a pixel.
    struct Changes {
        Float4 sum{};
        Float4 joint{};  ///< of two layers each the product, added
    };
    /// The same of means over parts, as if these were whole pixels about their centroids. A ramp that turns
    /// in the pixel by k, in what it changes by over one, is off by k / 32 at most.
    unsigned layOver(const Parts& parts, Colors& colors, Changes& changes);

    /// Of pixels of a row, those from the first on of which a linear gradient knows the same.
    struct Stretch {
        std::size_t count;
        bool isEven;       ///< in which `colors` are the means
        bool isKnown;      ///< or a stop turns the ramp there
        RowColors colors;  ///< from the first pixel on
    };
    Stretch stretchAt(Pixel first, std::size_t maximum) {
        const float u = linear_.at(first), change = float(linear_.right);
        const Segment& segment = find(u);
        const bool isOne = linear_.isEven(first, maximum);
        const std::size_t count = isOne ? maximum : segment.held(u, change, maximum);
        const auto one = [&](Float4 color) {
            return Stretch{count, true, true, {color, Float4{}, Float4{}, 0}};
        };
        if (segment.shape == Shape::Mixed)
            return {count, false, false, {}};
        if (segment.shape == Shape::Turning)
            return isOne ? one(segment.turned(u, linear_.width)) : Stretch{count, false, true, {}};
        if (segment.shape == Shape::Constant || isOne)
            return one(segment.at(u));
        const float x = u - segment.start;
        if (segment.shape == Shape::Straight)
            return {count, true, true, {segment.at(u), change * segment.slope, Float4{}, 1}};
        return {count,
                true,
                true,
                {segment.at(u), change * (segment.slope + 2 * x * segment.bend),
                 change * change * segment.bend, 2}};
    }
    /// The colours of pixels of a row at five places: the first and the last pixel, and evenly between them.
    static constexpr std::size_t samples = 5;
    using Samples = std::array<Float4, samples>;
    /// Returns how many of the pixels samples may tell, since the ramp does not turn between them; lays this
    /// gradient over the colours, unless they are null, if it is all of them.
    int layOver(Pixel first, int count, Samples* colors);

    /// Visits no more than longestRow pixels of a row, from the left: constant(first, end, colour),
    /// some(first, colours), or others(first, end) where the mean over a pixel is not known here. Pixels are
    /// counted from 0.
    template <class Constant, class Some, class Others>
    void visit(Pixel first, std::size_t count, Constant&& constant, Some&& some, Others&& others) {
        if (isRadial_)
            visitRadial(first, count, constant, some, others);
        else
            visitLinear(first, count, constant, some, others);
    }
    /// The same of a radial gradient.
    template <class Constant, class Some, class Others>
    void visitRadial(Pixel first, std::size_t count, Constant&& constant, Some&& some, Others&& others) {
        std::array<Float4, longestRow> memory;
        visitSegments(
            first, count,
            [&](std::size_t from, std::size_t size, const Segment& segment, const Offsets& offsets) {
                if (segment.shape == Shape::Constant)
                    return constant(from, from + size, segment.color);
                if (segment.shape == Shape::Mixed)
                    return others(from, from + size);
                const std::span<Float4> colors = std::span(memory).first(size);
                if (segment.shape == Shape::Turning)
                    for (std::size_t i = 0; i < size; ++i)
                        colors[i] = segment.turned(
                            offsets[i], radialWidth({first.x + int(from + i), first.row}, offsets[i]));
                else
                    segment.fill(offsets, colors);
                some(from, std::span<const Float4>(colors));
            },
            others);
    }

private:
    enum class Shape : std::uint8_t { Constant, Straight, Curved, Turning, Mixed };
    using Offsets = std::span<const float>;

    /// Of the ramp, from `low` to below `high`: with x = u - start, color + x slope + x² bend. Turning: and
    /// from `stop` on, with x = u - stop, x turn + x² turnBend.
    struct Segment {
        float low, high, start, stop;
        Shape shape;
        Float4 color, slope, bend, turn, turnBend;
        bool isClear = false;  ///< all of it is transparent
        float perPixel = 0;    ///< what it changes by over a pixel, at most

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
        bool hold(Float4 u) const {
            const auto in = (u >= low) & (u < high);
            return (in[0] & in[1] & in[2] & in[3]) != 0;
        }
        /// Those, from the first on, that it holds; the first in any case.
        Offsets held(Offsets offsets) const;
        /// The same of a row.
        std::size_t held(float first, float change, std::size_t maximum) const {
            const float held = ((change > 0 ? high : low) - first) / change;
            return held < float(maximum) ? std::min(std::size_t(std::max(held, 0.0f)) + 1, maximum) : maximum;
        }
        void fill(Offsets offsets, std::span<Float4> colors) const;
    };
    template <class Constant, class Some, class Others>
    void visitLinear(Pixel first, std::size_t count, Constant&& constant, Some&& some, Others&& others) {
        std::array<Float4, longestRow> memory;
        for (std::size_t i = 0; i < count;) {
            const Pixel pixel{first.x + int(i), first.row};
            const Stretch stretch = stretchAt(pixel, count - i);
            const std::span<Float4> colors = std::span(memory).first(stretch.count);
            const std::size_t end = i + stretch.count;
            if (stretch.isEven && stretch.colors.degree == 0) {
                constant(i, end, stretch.colors.color);
            } else if (stretch.isEven) {
                for (std::size_t k = 0; k < colors.size(); ++k)
                    colors[k] = stretch.colors.at(float(int(k)));
                some(i, std::span<const Float4>(colors));
            } else if (stretch.isKnown) {
                const Segment& segment = find(linear_.at(pixel));
                for (std::size_t k = 0; k < colors.size(); ++k)
                    colors[k] = segment.turned(linear_.at({pixel.x + int(k), pixel.row}), linear_.width);
                some(i, std::span<const Float4>(colors));
            } else {
                others(i, end);
            }
            i = end;
        }
    }
    template <class Visit, class Others>
    void visitSegments(Pixel first, std::size_t count, Visit&& visit, Others&& others) {
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
    /// Of places so many pixels from the middle of one. Clears the bits of those so near the tip that the
    /// mean of u over them is another one.
    Float4 offsetsAt(Pixel first, Float4 right, Float4 down, unsigned& known) const;
    /// Over how much u is spread to both sides in a pixel, in whose middle it is `u`.
    float widthAt(Pixel pixel, float u) const { return isRadial_ ? radialWidth(pixel, u) : linear_.width; }
    float radialWidth(Pixel pixel, float u) const;
    const Segment& find(float u) { return segments_[last_].holds(u) ? segments_[last_] : findOther(u); }
    [[gnu::noinline]] const Segment& findOther(float u) {
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
        float near, pixel;

        glm::vec2 fromFocus(Pixel at) const { return first + double(at.x) * right + double(at.row) * down; }
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
    [[gnu::noinline]] static float stepsIn(const Segment& segment, std::span<const float> offsets);
    static float dipOf(const std::array<float, samples>& u);
    /// If it is not empty; and a Mixed one before it, if there is a gap.
    void add(Segment segment, const Solids& solids);

    std::vector<Segment> segments_;  ///< from -infinity to infinity
    std::size_t last_ = 0;           ///< that was found
    bool isRadial_ = false;
    Blur blur_{};
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
        RowGradient::Colors colors;
        const bool isKnown = (at({pixel, pixel, pixel, pixel}, colors) & 1) != 0;
        color = colors[0];
        return isKnown;
    }
    /// Sets the means over four pixels. Returns those of which they are known here, a bit each.
    unsigned at(const RowGradient::Pixels& pixels, RowGradient::Colors& colors) {
        unsigned known = isReady() ? 15 : 0;
        colors = {};
        for (std::size_t k = 0; k < size_ && known != 0; ++k)
            known &= layers_[k].layOver(pixels, colors);
        return known;
    }
    /// The same of means over parts of four pixels.
    unsigned at(const RowGradient::Parts& parts, RowGradient::Colors& colors);
    /// Visits pixels of a row from the left: even(first, end, colours), some(first, colours) of no more than
    /// longestRow, or others(first, end) where the mean over a pixel is not known here.
    template <class Even, class Some, class Others>
    void visit(int row, int first, int end, Even&& even, Some&& some, Others&& others) {
        if (size_ == 0)
            return others(first, end);
        if (!isLinear_)
            return visitSampled(row, first, end, even, some, others);
        while (first < end) {
            const Stretch stretch = stretchAt({first, row}, std::size_t(end - first));
            const int next = first + int(stretch.count);
            if (stretch.isEven)
                even(first, next, stretch.colors);
            else if (stretch.isKnown)
                visitSampled(row, first, next, even, some, others);
            else
                others(first, next);
            first = next;
        }
    }

private:
    using Stretch = RowGradient::Stretch;

    /// Of layers that are all linear.
    Stretch stretchAt(Pixel first, std::size_t maximum) {
        Stretch all = layers_[0].stretchAt(first, maximum);
        for (std::size_t k = 1; k < size_; ++k) {
            const Stretch above = layers_[k].stretchAt(first, all.count);
            all.count = above.count;
            all.isKnown &= above.isKnown;
            all.isEven = all.isEven && above.isEven && layOver(above.colors, all.colors);
        }
        return all;
    }
    /// Lays colours over others; false if that is no polynomial of degree 2.
    static bool layOver(const RowColors& above, RowColors& colors) {
        const auto alpha = [](Float4 v) { return Float4{v[3], v[3], v[3], v[3]}; };
        const Float4 rest = 1 - alpha(above.color), slope = alpha(above.slope), bend = alpha(above.bend);
        const int degree = above.bend[3] != 0 ? 2 : above.slope[3] != 0 ? 1 : 0;
        if (degree + colors.degree > 2)
            return false;
        colors = {above.color + rest * colors.color, above.slope + rest * colors.slope - slope * colors.color,
                  above.bend + rest * colors.bend - slope * colors.slope - bend * colors.color,
                  std::max(above.degree, degree + colors.degree)};
        return true;
    }

    /// Stretches that samples tell, and the other pixels one by one.
    template <class Even, class Some, class Others>
    void visitSampled(int row, int first, int end, Even&& even, Some&& some, Others&& others) {
        if (size_ == 1 && end - first < fewForOne)
            return visitSome(row, first, end, even, some, others);
        int maximum = mostSampled, toPass = fewSampled;  // where samples tell nothing, soon only now and then
        while (first < end) {
            RowColors colors;
            const int count = sample({first, row}, std::min(end - first, maximum), colors);
            const int next = first + std::min(count > 0 ? count : toPass, end - first);
            if (count > 0)
                even(first, next, colors);
            else
                visitSome(row, first, next, even, some, others);
            toPass = count > 0 ? fewSampled : std::min(2 * toPass, mostSampled);
            maximum = std::clamp(2 * count, 2 * fewSampled, mostSampled);
            first = next;
        }
    }
    /// Fewer pixels are not worth five samples, nor fewer than `fewForOne` of a single gradient; more than
    /// `mostSampled` are mostly no polynomial.
    static constexpr int fewSampled = 8, mostSampled = 64, fewForOne = 24;
    /// The colours of some pixels, no more than a number; returns how many, or 0 if they are too few.
    int sample(Pixel first, int maximum, RowColors& colors);
    /// Those of so many, or of how many samples may tell them.
    int sampleOnce(Pixel first, int count, RowColors& colors);

    template <class Even, class Some, class Others>
    void visitSome(int row, int first, int end, Even&& even, Some&& some, Others&& others) {
        for (; first < end; first += int(longestRow)) {
            const auto count = std::min(longestRow, std::size_t(end - first));
            const auto at = [&](std::size_t i) { return first + int(i); };
            const auto someAt = [&](std::size_t from, std::span<const Float4> colors) {
                some(at(from), colors);
            };
            const auto othersAt = [&](std::size_t from, std::size_t to) { others(at(from), at(to)); };
            if (size_ == 1 && layers_[0].isRadial())
                layers_[0].visitRadial(
                    {first, row}, count,
                    [&](std::size_t from, std::size_t to, Float4 color) {
                        even(at(from), at(to), RowColors{color, Float4{}, Float4{}, 0});
                    },
                    someAt, othersAt);
            else
                visitStack({first, row}, count, someAt, othersAt);
        }
    }
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
    bool isLinear_ = true;  ///< all layers are
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
    /// It stays until the next one is made.
    RowPaint& make(const Paints& paints, std::uint32_t paint, const PixelMiddles& pixels) {
        std::uint32_t& number = numbers_[paint];
        if (number == 0) {
            if (made_.size() == most)
                reset(0);
            made_.push_back(paint);
            number = std::uint32_t(made_.size());
            if (rows_.size() < made_.size())
                rows_.emplace_back();
            rows_[number - 1].prepare(paints, paint, pixels);
        }
        return rows_[number - 1];
    }

private:
    /// Crowded pictures have ten thousands of paints, each of some kB here, and few of them in a band.
    static constexpr std::size_t most = 512;

    std::vector<RowPaint> rows_;          ///< the first of which are used
    std::vector<std::uint32_t> numbers_;  ///< by paint: in rows_ and 1
    std::vector<std::uint32_t> made_;     ///< paints
};

}  // namespace vtm::asset
