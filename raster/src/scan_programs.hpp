/// \file
/// What paint programs add to a band of pixels: each by its own coverage, and steep ones with the centroids
/// of their parts of pixels (docs/coverage.md).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <vtm/raster/scan.hpp>
#include "raster/blend.hpp"
#include "raster/src/gradient.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/part_sums.hpp"
#include "raster/src/program_pixels.hpp"
#include "raster/src/rough.hpp"
#include "raster/src/row_paint.hpp"
#include "raster/src/row_sums.hpp"
#include "raster/steepness.hpp"

namespace vtm::asset {

/// Those pixels of a finer picture that are asked for: all of a coarser picture's rough ones.
class FinerPixels {
public:
    FinerPixels(int width, int height) : width_(width), isWanted_(std::size_t(width) * std::size_t(height)) {}

    /// A coarser pixel.
    void add(int x, int y) { isWanted_[at(x, y)] = true; }
    /// Calls visit(first, end) for those of the finer pixels first to end - 1 of a row.
    template <class Visit>
    void forEachRun(int row, int first, int end, Visit&& visit) const {
        for (int x = first / finerSide; x * finerSide < end; ++x)
            if (isWanted_[at(x, row / finerSide)])
                visit(std::max(first, x * finerSide), std::min(end, (x + 1) * finerSide));
    }

private:
    std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }

    int width_;
    std::vector<std::uint8_t> isWanted_;
};

/// What programs are drawn for.
struct ProgramView {
    /// `roughness`: of the bounds for rough pixels, so many times.
    ProgramView(const Paints& paintsOf, Sums sumsOf, const View& of, const MaterialFunction& materialsOf,
                float roughness, bool disjoint, int levels, const FinerPixels* wantedOf)
        : paints(paintsOf),
          sums(sumsOf),
          view(of),
          inverse(glm::inverse(glm::dmat2(of.toPixels[0], of.toPixels[1]))),
          minSteep(minSteepness(inverse)),
          materials(materialsOf),
          rough(roughBounds(minSteep, roughness)),
          areDisjoint(disjoint),
          finerLevels(levels),
          wanted(wantedOf) {}

    const Paints& paints;
    Sums sums;
    const View& view;
    glm::dmat2 inverse;  ///< pixels to the picture
    float minSteep;      ///< of raster/steepness.hpp
    const MaterialFunction& materials;
    RoughBounds rough;
    bool areDisjoint;           ///< what has all of a pixel shares it with nothing
    int finerLevels;            ///< how many times over rough pixels are drawn finer
    const FinerPixels* wanted;  ///< null: all

    glm::vec2 point(glm::dvec2 pixel) const { return {inverse * (pixel - view.toPixels[2])}; }
    /// What a paint changes by in the pixels first to end - 1 of a row, anywhere in them.
    PaintChange changeNear(std::uint32_t paint, int row, int first, int end) const {
        const glm::dvec2 middle(0.5 * (first + end), row + 0.5);
        const double side = rough.pixel;
        return paints.changeNear(paint, {inverse * (middle - view.toPixels[2]),
                                         0.5 * (end - first - 1) * side, std::numbers::sqrt2 * side});
    }
    PixelMiddles middles() const {
        return {inverse * (glm::dvec2(0.5) - view.toPixels[2]), inverse[0], inverse[1], view.width,
                view.height};
    }
    /// The colours of pixels of a row, as they are summed.
    void rowColors(std::uint32_t paint, int row, int first, std::span<Float4> colors) const {
        const glm::mat2 pixel(inverse);
        paints.colors(paint, {point({first + 0.5, row + 0.5}), pixel}, pixel[0], colors, materials);
        toSums(colors);
    }
    void toSums(std::span<Float4> colors) const {
        if (sums == Sums::Light)
            for (Float4& color : colors)
                color = float4(light(toVec4(color)));
    }
    /// Calls visit(first, end) for those of the pixels first to end - 1 of a row that are to be drawn.
    template <class Visit>
    void forEachWanted(int row, int first, int end, Visit&& visit) const {
        if (wanted)
            wanted->forEachRun(row, first, end, visit);
        else
            visit(first, end);
    }
};

/// What is not made better by a part's centroid: a tenth of a step of 8 bits.
inline constexpr float minPart = 0.1f / 255;

class FinerProgram;

/// A chord and the change of coverage that it means to a program.
struct ProgramSide {
    const Chord* chord;
    float change;
};

/// Those of one band at a time.
class BandPrograms {
public:
    BandPrograms();
    ~BandPrograms();

    void resize(std::size_t paints, int width) {
        sides_.resize(paints);
        width_ = width;
        rowPaints_.reset(paints);
    }

    bool empty() const { return programs_.empty(); }
    ProgramPixels& pixels() { return pixels_; }

    /// Stores pixels of a row that a program has alone.
    template <class Store>
    [[gnu::noinline]] void drawAlone(const ProgramView& of, std::uint32_t paint, int row, int first, int end,
                                     Store& store) {
        visitRow(
            of, paint, row, first, end,
            [&](int from, int to, const RowColors& colors) {
                if (colors.degree == 0)
                    store(row, from, to, colors.color);
                else
                    store(row, from, to, colors);
            },
            [&](int from, std::span<const Float4> colors) { store(row, from, colors); });
    }

    void clear() {
        programs_.clear();
        pixels_.clear();
    }
    /// A chord at which a program has `change` more on its left. It must stay until the band is drawn.
    void addSide(const Chord& chord, std::uint32_t paint, float change) {
        std::vector<ProgramSide>& sides = sides_[paint];
        if (sides.empty())
            programs_.push_back(paint);
        sides.push_back({&chord, change});
    }

    /// Adds what programs have to the band's sums, but what they have alone, which pixels() gets.
    void draw(const ProgramView& of, int top, int rows, Accumulator<Float4>& sums) {
        if (programs_.empty())
            return;
        sums_ = &sums;
        top_ = top;
        rows_ = rows;
        for (const std::uint32_t paint : programs_) {
            if (of.paints.changes()[paint].steepness > of.minSteep)
                drawSteep(of, paint);
            else
                drawWholes(of, paint);
            sides_[paint].clear();
        }
    }

private:
    /// A pixel of which a program has a share.
    struct Part {
        BandPixel pixel;
        float share;
    };
    /// Pixels first to end - 1 of a row, of each of which a program has the same share.
    struct Run {
        int row, first, end;
        float share;
    };
    /// A row of so many pays for itself.
    static constexpr int minLong = 10;
    /// So many cut pixels of a band pay for what is prepared for them.
    static constexpr std::size_t minCuts = 12;
    /// A pixel of which a steep program has a part.
    struct Cut {
        BandPixel pixel;
        float share;
        glm::vec2 moment;

        /// From the pixel's middle.
        glm::vec2 centroid() const {
            constexpr float least = 1e-6f;  // smaller shares are rounding
            return std::abs(share) > least ? glm::clamp(moment / share, -0.5f, 0.5f) : glm::vec2(0);
        }
    };
    /// A pixel that may be rough, and what the program changes by in it.
    struct Doubtful {
        BandPixel pixel;
        PaintChange change;
    };
    /// So many neighbours that may be rough are looked at one by one; more are divided by four first.
    static constexpr int fewNeighbours = 16;

    /// Calls take(row, first column, end, what was summed) for what the program has of the band. Only the
    /// pixels in the box around its chords are looked at.
    template <class Coverage, class Take>
    void forEachRun(const ProgramView& of, std::uint32_t paint, Coverage& coverage, Take&& take) {
        coverage.resize(width_);
        glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
        for (const ProgramSide& side : sides_[paint]) {
            const Chord& chord = *side.chord;
            coverage.add(chord, float(top_), rows_, side.change);
            low = glm::min(low, glm::min(chord.a, chord.b));
            high = glm::max(high, glm::max(chord.a, chord.b));
        }
        const auto columnAt = [&](float x) { return int(std::clamp(x, 0.0f, float(of.view.width + 1))); };
        const auto rowAt = [&](float y) { return int(std::clamp(y - float(top_), 0.0f, float(rows_))); };
        const int from = columnAt(low.x), to = columnAt(high.x + 1);
        const int firstRow = rowAt(low.y), endRow = std::min(rowAt(high.y) + 1, rows_);
        for (int row = firstRow; row < endRow; ++row)
            coverage.resolve(std::size_t(row), from, to, [&](int first, int end, auto sum) {
                if (!isNothing(sum))
                    of.forEachWanted(top_ + row, first, end, [&](int a, int b) { take(row, a, b, sum); });
            });
    }

    /// Each pixel by the mean colour over it, times the program's share of it.
    void drawWholes(const ProgramView& of, std::uint32_t paint) {
        forEachRun(of, paint, coverage_, [&](int row, int first, int end, float share) {
            addWholes(of, paint, {row, first, end, share});
        });
        finishWholes(of, paint);
    }
    [[gnu::always_inline]] void addWholes(const ProgramView& of, std::uint32_t paint, const Run& run) {
        const bool isLong = run.end - run.first >= minLong;
        hasRows_ |= isLong;
        if (of.areDisjoint && isLong && isNothing(run.share - 1))
            pixels_.addAlone(run.row, run.first, run.end, paint);
        else if (isLong)
            addRow(of, paint, run);
        else if (!isNothing(run.share))
            for (int x = run.first; x < run.end; ++x)
                parts_.push_back({{run.row, x}, run.share});
    }
    void finishWholes(const ProgramView& of, std::uint32_t paint) {
        if (hasRows_ && of.sums == Sums::Encoded)
            addKnownParts(rowPaints_.make(of.paints, paint, of.middles()));
        addParts(of, paint);
        hasRows_ = false;
    }

    /// Adds those of which colorsOf(four of them, their colours) knows the colours, a bit each, and leaves
    /// the others. Whether a paint's rows are asked depends on the band alone, and so do its bytes.
    template <class Item, class ColorsOf>
    void addKnown(std::vector<Item>& items, ColorsOf&& colorsOf) {
        std::size_t left = 0;
        const std::size_t all = items.size();
        for (std::size_t first = 0; first < all; first += 4) {
            const std::size_t count = std::min(all - first, std::size_t{4});
            std::array<Item, 4> four;
            for (std::size_t i = 0; i < 4; ++i)
                four[i] = items[first + std::min(i, count - 1)];
            RowGradient::Colors colors;
            const unsigned known = colorsOf(four, colors);
            for (std::size_t i = 0; i < count; ++i)
                if ((known >> i & 1) != 0)
                    addPixel(four[i].pixel, four[i].share * colors[i]);
                else
                    items[left++] = four[i];
        }
        items.resize(left);
    }
    template <class Item>
    RowGradient::Pixels pixelsOf(const std::array<Item, 4>& four) const {
        RowGradient::Pixels pixels;
        for (std::size_t i = 0; i < 4; ++i)
            pixels[i] = {four[i].pixel.x, top_ + four[i].pixel.row};
        return pixels;
    }
    void addKnownParts(RowPaint& rows) {
        addKnown(parts_, [&](const std::array<Part, 4>& four, RowGradient::Colors& colors) {
            return rows.at(pixelsOf(four), colors);
        });
    }
    void addParts(const ProgramView& of, std::uint32_t paint) {
        points_.clear();
        for (const Part& part : parts_)
            points_.push_back(of.point({part.pixel.x + 0.5, top_ + part.pixel.row + 0.5}));
        evaluate(of, paint, points_, glm::mat2(of.inverse), colors_);
        for (std::size_t i = 0; i < parts_.size(); ++i)
            addPixel(parts_[i].pixel, parts_[i].share * colors_[i]);
        parts_.clear();
    }
    /// Calls even(first, end, colours) or some(first, colours) for pixels of a row, from the left.
    template <class Even, class Some>
    void visitRow(const ProgramView& of, std::uint32_t paint, int row, int first, int end, Even&& even,
                  Some&& some) {
        const auto others = [&](int from, int to) {
            std::array<Float4, longestRow> memory;
            for (; from < to; from += int(longestRow)) {
                const auto colors = std::span(memory).first(std::min(longestRow, std::size_t(to - from)));
                of.rowColors(paint, row, from, colors);
                some(from, std::span<const Float4>(colors));
            }
        };
        if (of.sums == Sums::Light)  // ramps are straight in encoded colours
            return others(first, end);
        rowPaints_.make(of.paints, paint, of.middles()).visit(row, first, end, even, some, others);
    }
    /// Not inlined, as drawAlone(): the loops round them would pay.
    [[gnu::noinline]] void addRow(const ProgramView& of, std::uint32_t paint, const Run& run) {
        visitRow(
            of, paint, top_ + run.row, run.first, run.end,
            [&](int from, int to, const RowColors& colors) {
                sums_->addPixels(std::size_t(run.row), from, to,
                                 [&](int x) { return run.share * colors.at(float(x - from)); });
            },
            [&](int from, std::span<const Float4> colors) {
                sums_->addPixels(std::size_t(run.row), from, from + int(colors.size()),
                                 [&](int x) { return run.share * colors[std::size_t(x - from)]; });
            });
    }
    void addPixel(const BandPixel& pixel, Float4 color) {
        sums_->addPixel(std::size_t(pixel.row), pixel.x, color);
    }
    /// The first of a vector that never shrinks.
    static std::span<Float4> firstOf(std::vector<Float4>& colors, std::size_t count) {
        if (colors.size() < count)
            colors.resize(count);
        return std::span(colors).first(count);
    }
    /// The colours of pixels, as they are summed, become the first of `colors`.
    static void evaluate(const ProgramView& of, std::uint32_t paint, std::span<const glm::vec2> points,
                         const glm::mat2& pixel, std::vector<Float4>& colors) {
        const std::span<Float4> those = firstOf(colors, points.size());
        of.paints.colors(paint, points, pixel, those, of.materials);
        of.toSums(those);
    }

    void drawSteep(const ProgramView& of, std::uint32_t paint) {
        const PaintChange& change = of.paints.changes()[paint];
        const float minMoment = minMomentOf(of, change);
        const bool mayBeRough = of.finerLevels > 0 && of.rough.mayBeRough(change);
        runs_.clear();
        cuts_.clear();
        doubtful_.clear();
        forEachRun(of, paint, partSums_, [&](int row, int first, int end, Float4 sum) {
            const PartOfPixel part(sum);
            if (part.squaredMoment() > minMoment * minMoment) {
                for (int x = first; x < end; ++x)
                    cuts_.push_back({{row, x}, part.share, part.moment});
                return;
            }
            runs_.push_back({row, first, end, part.share});
            if (mayBeRough && std::abs(part.share) > minShare)
                addUncut(of, paint, row, first, end);
        });
        if (of.sums == Sums::Encoded && cuts_.size() >= minCuts)
            addKnownCuts(rowPaints_.make(of.paints, paint, of.middles()));
        rough_.clear();
        if (!cuts_.empty())
            findPartColors(of, paint, mayBeRough);
        if (!doubtful_.empty())
            findRough(of, paint);
        std::ranges::sort(rough_);
        rough_.erase(std::ranges::unique(rough_).begin(), rough_.end());
        addOtherCuts();
        addOthers(of, paint);
        if (!rough_.empty())
            addFiner(of, paint);
    }
    /// Adds the wholes of runs_, but of rough pixels.
    void addOthers(const ProgramView& of, std::uint32_t paint) {
        auto rough = rough_.begin();
        for (Run run : runs_) {
            for (; rough != rough_.end() && *rough < BandPixel{run.row, run.end}; ++rough) {
                if (rough->row < run.row || rough->x < run.first)  // one that is cut
                    continue;
                if (run.first < rough->x)
                    addWholes(of, paint, {run.row, run.first, rough->x, run.share});
                run.first = rough->x + 1;
            }
            if (run.first < run.end)
                addWholes(of, paint, run);
        }
        finishWholes(of, paint);
    }
    /// What the program has of rough_.
    void addFiner(const ProgramView& of, std::uint32_t paint);

    /// The first moment of the program's part, times what the colour changes by over a pixel, is about what
    /// the centroid makes better.
    static float minMomentOf(const ProgramView& of, const PaintChange& change) {
        const float overPixel = of.rough.pixel * change.steepness;
        return std::max(of.rough.times * minPart / overPixel, minShare);
    }

    // ---- Cut pixels -------------------------------------------------------------------------------

    /// Those in which no ramp turns.
    void addKnownCuts(RowPaint& rows) {
        addKnown(cuts_, [&](const std::array<Cut, 4>& four, RowGradient::Colors& colors) {
            RowGradient::Parts parts{pixelsOf(four), {}, {}};
            for (std::size_t i = 0; i < 4; ++i) {
                const glm::vec2 centroid = four[i].centroid();
                parts.right[i] = centroid.x;
                parts.down[i] = centroid.y;
            }
            return rows.at(parts, colors);
        });
    }
    /// Those in which the paint turns have colours as if it changed evenly between the middles of their
    /// quarters: partColors_. Those that are rough become some of rough_, those that may be of doubtful_.
    void findPartColors(const ProgramView& of, std::uint32_t paint, bool mayBeRough) {
        points_.clear();
        for (const Cut& cut : cuts_)
            addQuarters(of, cut.pixel);
        evaluate(of, paint, points_, glm::mat2(0.5 * of.inverse), colors_);
        partColors_.clear();
        const PaintChange& anywhere = of.paints.changes()[paint];
        for (std::size_t i = 0; i < cuts_.size(); ++i) {
            const auto& [pixel, share, moment] = cuts_[i];
            const QuarterColors q(&colors_[4 * i], 4);
            const Float4 right = q[1] + q[3] - q[0] - q[2], down = q[2] + q[3] - q[0] - q[1];  // over a pixel
            partColors_.push_back(share * meanOf(q) + moment.x * right + moment.y * down);
            if (!mayBeRough && !(of.finerLevels > 0 && of.rough.isRoughCut(anywhere, q)))
                continue;
            const PaintChange near = of.changeNear(paint, top_ + pixel.row, pixel.x, pixel.x + 1);
            if (of.rough.isRoughCut(near, q))
                rough_.push_back(pixel);
            else if (of.rough.mayBeRoughNear(near))
                doubtful_.push_back({pixel, near});
        }
    }
    /// Adds partColors_, but of rough pixels.
    void addOtherCuts() {
        for (std::size_t i = 0; i < cuts_.size(); ++i)
            if (!std::ranges::binary_search(rough_, cuts_[i].pixel))
                addPixel(cuts_[i].pixel, partColors_[i]);
    }
    /// The middles of a pixel's quarters become points_.
    void addQuarters(const ProgramView& of, const BandPixel& pixel) {
        const glm::vec2 middle = middleOf(of, pixel), right = 0.25f * glm::mat2(of.inverse)[0],
                        down = 0.25f * glm::mat2(of.inverse)[1];
        for (const glm::vec2 way : {-right - down, right - down, down - right, right + down})
            points_.push_back(middle + way);
    }

    // ---- Rough pixels -----------------------------------------------------------------------------

    /// Of pixels that no edge cuts those that may be rough become some of doubtful_.
    void addUncut(const ProgramView& of, std::uint32_t paint, int row, int first, int end) {
        const PaintChange near = of.changeNear(paint, top_ + row, first, end);
        if (!of.rough.mayBeRoughNear(near))
            return;
        if (end - first == 1)
            return doubtful_.push_back({{row, first}, near});
        const int parts = end - first > fewNeighbours ? 4 : end - first;
        for (int i = 0; i < parts; ++i)
            addUncut(of, paint, row, first + i * (end - first) / parts,
                     first + (i + 1) * (end - first) / parts);
    }

    /// Those of doubtful_ that are rough become some of rough_.
    void findRough(const ProgramView& of, std::uint32_t paint) {
        points_.clear();
        for (const Doubtful& doubtful : doubtful_)
            addQuarters(of, doubtful.pixel);
        evaluate(of, paint, points_, glm::mat2(0.5 * of.inverse), colors_);
        points_.clear();
        for (const Doubtful& doubtful : doubtful_)
            points_.push_back(middleOf(of, doubtful.pixel));
        evaluate(of, paint, points_, glm::mat2(of.inverse), wholes_);
        asked_.clear();  // those that may jump
        for (std::size_t i = 0; i < doubtful_.size(); ++i) {
            if (of.rough.isRoughWhole(doubtful_[i].change, QuarterColors(&colors_[4 * i], 4), wholes_[i])) {
                rough_.push_back(doubtful_[i].pixel);
            } else if (doubtful_[i].change.mayJump) {
                points_[asked_.size()] = points_[i];
                wholes_[asked_.size()] = wholes_[i];
                asked_.push_back(i);
            }
        }
        points_.resize(asked_.size());
        findRoughCorners(of, paint);
    }

    /// points_ are the middles of asked_, wholes_ their colours.
    void findRoughCorners(const ProgramView& of, std::uint32_t paint) {
        if (asked_.empty())
            return;
        const glm::vec2 right = 0.5f * glm::mat2(of.inverse)[0], down = 0.5f * glm::mat2(of.inverse)[1];
        for (const glm::vec2 way : {-right - down, right - down, down - right, right + down}) {
            corners_ = points_;
            for (glm::vec2& corner : corners_)
                corner += way;
            evaluate(of, paint, corners_, glm::mat2(0), cornerColors_);
            for (std::size_t k = 0; k < asked_.size(); ++k)
                if (of.rough.isRoughCorner(cornerColors_[k], wholes_[k]))
                    rough_.push_back(doubtful_[asked_[k]].pixel);
        }
    }
    glm::vec2 middleOf(const ProgramView& of, const BandPixel& pixel) const {
        return of.point({pixel.x + 0.5, top_ + pixel.row + 0.5});
    }

    int width_ = 0, top_ = 0, rows_ = 0;
    Accumulator<Float4>* sums_ = nullptr;
    std::vector<std::vector<ProgramSide>> sides_;  ///< by paint
    std::vector<std::uint32_t> programs_;          ///< that have sides
    Accumulator<float> coverage_;
    PartSums partSums_;
    std::vector<Run> runs_;
    std::vector<Cut> cuts_;
    std::vector<Doubtful> doubtful_;
    std::vector<std::size_t> asked_;  ///< of doubtful_
    std::vector<BandPixel> rough_;    ///< of one program, in order
    std::vector<glm::vec2> points_, corners_;
    std::vector<Float4> colors_, partColors_, wholes_, cornerColors_;
    std::vector<Part> parts_;
    bool hasRows_ = false;  ///< of the program that is drawn
    RowPaints rowPaints_;
    ProgramPixels pixels_;
    std::unique_ptr<FinerProgram> finer_;
};

}  // namespace vtm::asset
