/// \file
/// What paint programs add to a band of pixels: each by its own coverage, and steep ones, where they have
/// other shares of a pixel's quarters than of the whole, by those too (docs/coverage.md).
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

/// What is not made better where quarters differ: a tenth of a step of 8 bits.
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
    void draw(const ProgramView& of, int top, int rows, Accumulator<Wholes<Float4>>& sums) {
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
    /// A pixel and what its quarters add to a fourth of the program's share of the whole.
    struct Cut {
        int row, x;
        Float4 more;  ///< zero where no edge cuts it

        bool isCut() const { return largest(more) > 0; }
        /// Of the first moment of the program's part about the pixel's middle.
        float squaredMoment() const {
            const float right = more[1] + more[3] - more[0] - more[2],
                        down = more[2] + more[3] - more[0] - more[1];
            return (right * right + down * down) / 16;
        }
    };
    /// What the program changes by in a pixel, or some neighbours.
    struct Near {
        PaintChange change;
        float minSquaredMoment;
        bool mayBeRough;  ///< where no edge cuts it

        bool matters(const Cut& cut) const { return mayBeRough || cut.squaredMoment() > minSquaredMoment; }
    };
    /// So many neighbours, at most, are looked at together; of uncut ones that many more at first.
    static constexpr int maxNeighbours = 8, maxUncut = 64;

    /// Calls take(row, first column, end, what was summed) for what the program has of the band. Only the
    /// pixels in the box around its chords are looked at.
    template <class Grid, class Take>
    void forEachRun(const ProgramView& of, std::uint32_t paint, Accumulator<Grid>& coverage, Take&& take) {
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

    /// Leaves the others. Whether a paint's rows are asked depends on the band alone, and so do its bytes.
    void addKnownParts(RowPaint& rows) {
        std::size_t left = 0;
        const std::size_t all = parts_.size();
        for (std::size_t first = 0; first < all; first += 4) {
            const std::size_t count = std::min(all - first, std::size_t{4});
            RowGradient::Pixels pixels;
            for (std::size_t i = 0; i < 4; ++i) {
                const BandPixel& pixel = parts_[first + std::min(i, count - 1)].pixel;
                pixels[i] = {pixel.x, top_ + pixel.row};
            }
            RowGradient::Colors colors;
            const unsigned known = rows.at(pixels, colors);
            for (std::size_t i = 0; i < count; ++i) {
                const Part part = parts_[first + i];
                if ((known >> i & 1) != 0)
                    addPixel(part.pixel, part.share * colors[i]);
                else
                    parts_[left++] = part;
            }
        }
        parts_.resize(left);
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
        forEachRun(of, paint, quarters_, [&](int row, int first, int end, Float4 q) {
            const float share = 0.25f * (q[0] + q[1] + q[2] + q[3]);
            runs_.push_back({row, first, end, share});
            const Cut cut{row, first, 0.25f * (q - share)};
            if (cut.squaredMoment() > minMoment * minMoment)
                addPixels(cut, end);
            else if (mayBeRough && std::abs(share) > minShare)
                addUncut(of, paint, row, first, end);
        });
        keepSteep(of, paint);
        addCuts(of, paint);
        addOthers(of, paint);
        if (!rough_.empty())
            addFiner(of, paint);
        rough_.clear();
    }
    /// The wholes of all but the rough pixels.
    void addOthers(const ProgramView& of, std::uint32_t paint) {
        auto rough = rough_.begin();
        for (Run run : runs_) {
            for (; rough != rough_.end() && *rough < BandPixel{run.row, run.end}; ++rough) {
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
    /// the quarters make better.
    static float minMomentOf(const ProgramView& of, const PaintChange& change) {
        const float overPixel = of.rough.pixel * change.steepness;
        return std::max(of.rough.times * minPart / overPixel, minShare);
    }

    void addPixels(Cut cut, int end) {
        for (; cut.x < end; ++cut.x)
            cuts_.push_back(cut);
    }
    /// Those that may be rough.
    void addUncut(const ProgramView& of, std::uint32_t paint, int row, int first, int end) {
        for (; first < end; first += maxUncut) {
            const int to = std::min(first + maxUncut, end);
            if (to - first <= maxNeighbours ||
                of.rough.mayBeRoughNear(of.changeNear(paint, top_ + row, first, to)))
                addPixels({row, first, Float4{}}, to);
        }
    }
    Near nearOf(const ProgramView& of, std::uint32_t paint, int row, int first, int end) const {
        const PaintChange change = of.changeNear(paint, top_ + row, first, end);
        const float minMoment = minMomentOf(of, change);
        return {change, minMoment * minMoment, of.finerLevels > 0 && of.rough.mayBeRoughNear(change)};
    }
    /// Leaves those of cuts_ in which the paint changes enough to matter. Most neighbours are dropped
    /// together.
    void keepSteep(const ProgramView& of, std::uint32_t paint) {
        nears_.clear();
        std::size_t kept = 0;
        for (std::size_t i = 0, end; i < cuts_.size(); i = end) {
            for (end = i + 1; end < cuts_.size() && cuts_[end].row == cuts_[i].row &&
                              cuts_[end].x < cuts_[i].x + maxNeighbours;)
                ++end;
            const Near all = nearOf(of, paint, cuts_[i].row, cuts_[i].x, cuts_[end - 1].x + 1);
            for (std::size_t k = i; k < end; ++k) {
                const Cut cut = cuts_[k];
                if (!all.matters(cut))
                    continue;
                const Near near = end == i + 1 ? all : nearOf(of, paint, cut.row, cut.x, cut.x + 1);
                if (near.matters(cut)) {
                    cuts_[kept++] = cut;
                    nears_.push_back(near);
                }
            }
        }
        cuts_.resize(kept);
    }

    void addCuts(const ProgramView& of, std::uint32_t paint) {
        if (cuts_.empty())
            return;
        const glm::mat2 quarter(0.5 * of.inverse);
        const glm::vec2 right = 0.5f * quarter[0], down = 0.5f * quarter[1];
        points_.clear();
        for (const Cut& cut : cuts_) {
            const glm::vec2 middle = middleOf(of, cut);
            for (const glm::vec2 way : {-right - down, right - down, down - right, right + down})
                points_.push_back(middle + way);
        }
        evaluate(of, paint, points_, quarter, colors_);
        if (of.finerLevels > 0)
            findRough(of, paint);
        auto rough = rough_.begin();
        for (std::size_t i = 0; i < cuts_.size(); ++i) {
            const BandPixel pixel{cuts_[i].row, cuts_[i].x};
            if (rough != rough_.end() && *rough == pixel) {
                ++rough;
                continue;
            }
            Float4 more{};
            for (std::size_t k = 0; k < 4; ++k)
                more += cuts_[i].more[k] * colors_[4 * i + k];
            addPixel(pixel, more);
        }
        cuts_.clear();
    }

    /// Those of cuts_, in their order, become rough_. colors_ are those of their quarters.
    void findRough(const ProgramView& of, std::uint32_t paint) {
        asked_.clear();
        points_.clear();
        for (std::size_t i = 0; i < cuts_.size(); ++i)
            if (cuts_[i].isCut() && of.rough.isRoughCut(nears_[i].change, quartersAt(i))) {
                addRough(i);
            } else if (nears_[i].mayBeRough) {
                asked_.push_back(i);
                points_.push_back(middleOf(of, cuts_[i]));
            }
        if (!asked_.empty())
            findRoughWholes(of, paint);
        std::ranges::sort(rough_);
        rough_.erase(std::ranges::unique(rough_).begin(), rough_.end());
    }

    /// Of asked_, of which points_ are the middles.
    void findRoughWholes(const ProgramView& of, std::uint32_t paint) {
        evaluate(of, paint, points_, glm::mat2(of.inverse), wholes_);
        std::size_t jumping = 0;  // of asked_, those that may jump
        for (std::size_t k = 0; k < asked_.size(); ++k) {
            const std::size_t i = asked_[k];
            if (of.rough.isRoughWhole(nears_[i].change, quartersAt(i), wholes_[k])) {
                addRough(i);
            } else if (nears_[i].change.mayJump) {
                asked_[jumping] = i;
                points_[jumping] = points_[k];
                wholes_[jumping++] = wholes_[k];
            }
        }
        asked_.resize(jumping);
        points_.resize(jumping);
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
                    addRough(asked_[k]);
        }
    }
    void addRough(std::size_t cut) { rough_.push_back({cuts_[cut].row, cuts_[cut].x}); }

    /// While colors_ are those of the cuts' quarters.
    QuarterColors quartersAt(std::size_t cut) const { return QuarterColors(&colors_[4 * cut], 4); }
    glm::vec2 middleOf(const ProgramView& of, const Cut& cut) const {
        return of.point({cut.x + 0.5, top_ + cut.row + 0.5});
    }

    int width_ = 0, top_ = 0, rows_ = 0;
    Accumulator<Wholes<Float4>>* sums_ = nullptr;
    std::vector<std::vector<ProgramSide>> sides_;  ///< by paint
    std::vector<std::uint32_t> programs_;          ///< that have sides
    Accumulator<Wholes<float>> coverage_;
    Accumulator<Quarters> quarters_;
    std::vector<Run> runs_;
    std::vector<Cut> cuts_;
    std::vector<Near> nears_;         ///< of cuts_
    std::vector<std::size_t> asked_;  ///< of cuts_
    std::vector<BandPixel> rough_;    ///< of one program, in order
    std::vector<glm::vec2> points_, corners_;
    std::vector<Float4> colors_, wholes_, cornerColors_;
    std::vector<Part> parts_;
    bool hasRows_ = false;  ///< of the program that is drawn
    RowPaints rowPaints_;
    ProgramPixels pixels_;
    std::unique_ptr<FinerProgram> finer_;
};

}  // namespace vtm::asset
