/// \file
/// What paint programs add to a band of pixels: each by its own coverage, and steep ones, where they have
/// other shares of a pixel's quarters than of the whole, by those too (docs/coverage.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/raster/scan.hpp>
#include "raster/src/blend.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/program_pixels.hpp"
#include "raster/src/rough.hpp"
#include "raster/src/row_sums.hpp"
#include "raster/steepness.hpp"

namespace vtm::asset {

/// What programs are drawn for.
struct ProgramView {
    const Paints& paints;
    Sums sums;
    const View& view;
    glm::dmat2 inverse;  ///< pixels to the picture
    float minSteep;      ///< of raster/steepness.hpp
    const MaterialFunction& materials;
    RoughBounds rough;
    bool findsRough;  ///< whether rough pixels are looked for

    glm::vec2 point(glm::dvec2 pixel) const { return {inverse * (pixel - view.toPixels[2])}; }
};

/// A pixel of a band.
struct BandPixel {
    int row, x;

    auto operator<=>(const BandPixel&) const = default;
};

/// What is not made better where quarters differ: a tenth of a step of 8 bits.
inline constexpr float minPart = 0.1f / 255;

/// Those of one band at a time.
class BandPrograms {
public:
    void resize(std::size_t paints, int width) {
        sides_.resize(paints);
        coverage_.resize(width);
        quarters_.resize(width);
        width_ = width;
    }

    bool empty() const { return programs_.empty(); }
    /// Pixels that want to be drawn finer; some more than once.
    std::vector<BandPixel>& rough() { return rough_; }
    ProgramPixels& pixels() { return pixels_; }

    void clear() {
        programs_.clear();
        rough_.clear();
    }
    /// A chord at which a program has `change` more on its left. It must stay until the band is drawn.
    void addSide(const Chord& chord, std::uint32_t paint, float change) {
        std::vector<Side>& sides = sides_[paint];
        if (sides.empty())
            programs_.push_back(paint);
        sides.push_back({&chord, change});
    }

    /// Adds all of the programs to pixels().
    void draw(const ProgramView& of, int top, int rows) {
        if (programs_.empty())
            return;
        top_ = top;
        rows_ = rows;
        pixels_.resize(width_);
        for (const std::uint32_t paint : programs_) {
            if (of.paints.changes()[paint].steepness > of.minSteep)
                drawSteep(of, paint);
            else
                drawWholes(of, paint, coverage_, [](int, int, int, float share) { return share; });
            sides_[paint].clear();
        }
    }

private:
    /// A chord and the change of coverage that it means to a program.
    struct Side {
        const Chord* chord;
        float change;
    };
    /// Pixels of a row up to `end`, of which a program has the same share.
    struct Share {
        int end;
        float share;
    };
    /// A pixel and what its quarters add to a fourth of the program's share of the whole.
    struct Cut {
        int row, x;
        Float4 more;  ///< zero where no edge cuts it

        bool isCut() const { return largest(more) > 0; }
    };

    /// Each pixel by the mean colour over it, times shareOf(row, first column, end, what was summed).
    template <class Grid, class ShareOf>
    void drawWholes(const ProgramView& of, std::uint32_t paint, Accumulator<Grid>& coverage,
                    const ShareOf& shareOf) {
        for (const Side& side : sides_[paint])
            coverage.add(*side.chord, float(top_), rows_, side.change);
        for (int row = 0; row < rows_; ++row) {
            int begin = 0;
            coverage.resolve(std::size_t(row), [&](int first, int end, auto sum) {
                const float share = shareOf(row, first, end, sum);
                if (std::abs(share) < minShare)
                    return addShares(of, paint, row, begin);
                if (shares_.empty())
                    begin = first;
                shares_.push_back({end, share});
            });
            addShares(of, paint, row, begin);
        }
    }

    /// In the pixels of a row from `first` on.
    void addShares(const ProgramView& of, std::uint32_t paint, int row, int first) {
        if (shares_.empty())
            return;
        const int end = shares_.back().end;
        colors_.resize(std::size_t(end - first));
        const glm::mat2 pixel(of.inverse);
        of.paints.colors(paint, {of.point({first + 0.5, top_ + row + 0.5}), pixel}, pixel[0], colors_,
                         of.materials);
        toSums(of, colors_);
        Float4* pixels = pixels_.use(row, first, end);
        std::size_t i = 0;
        for (const auto& [shareEnd, share] : shares_)
            for (const auto last = std::size_t(shareEnd - first); i < last; ++i)
                pixels[i] += share * colors_[i];
        shares_.clear();
    }

    static void toSums(const ProgramView& of, std::span<Float4> colors) {
        if (of.sums == Sums::Light)
            for (Float4& color : colors)
                color = float4(light(toVec4(color)));
    }

    void drawSteep(const ProgramView& of, std::uint32_t paint) {
        // The first moment of the program's part, times what the colour changes by over a pixel, is about
        // what the quarters make better.
        const float change = float(minSteepChange) / of.minSteep * of.paints.changes()[paint].steepness;
        const float minMoment = std::max(minPart / change, minShare);
        const bool mayBeRough = of.findsRough && of.rough.mayBeRough(of.paints.changes()[paint]);
        drawWholes(of, paint, quarters_, [&](int row, int first, int end, Float4 q) {
            const float share = 0.25f * (q[0] + q[1] + q[2] + q[3]);
            const float momentX = (q[1] + q[3] - q[0] - q[2]) / 16,
                        momentY = (q[2] + q[3] - q[0] - q[1]) / 16;
            const bool isCut = momentX * momentX + momentY * momentY > minMoment * minMoment;
            if (isCut || (mayBeRough && std::abs(share) > minShare))
                for (int x = first; x < end; ++x)
                    cuts_.push_back({row, x, isCut ? 0.25f * (q - share) : Float4{}});
            return share;
        });
        addCuts(of, paint, mayBeRough);
    }

    void addCuts(const ProgramView& of, std::uint32_t paint, bool mayBeRough) {
        const glm::mat2 quarter(0.5 * of.inverse);
        const glm::vec2 right = 0.5f * quarter[0], down = 0.5f * quarter[1];
        points_.clear();
        for (const Cut& cut : cuts_) {
            const glm::vec2 middle = middleOf(of, cut);
            for (const glm::vec2 way : {-right - down, right - down, down - right, right + down})
                points_.push_back(middle + way);
        }
        colors_.resize(points_.size());
        of.paints.colors(paint, points_, quarter, colors_, of.materials);
        toSums(of, colors_);
        for (std::size_t i = 0; i < cuts_.size(); ++i) {
            Float4& pixel = *pixels_.use(cuts_[i].row, cuts_[i].x, cuts_[i].x + 1);
            for (std::size_t k = 0; k < 4; ++k)
                pixel += cuts_[i].more[k] * colors_[4 * i + k];
            if (of.findsRough && cuts_[i].isCut() &&
                of.rough.isRoughCut(of.paints.changes()[paint], quartersAt(i)))
                rough_.push_back({cuts_[i].row, cuts_[i].x});
        }
        if (mayBeRough)
            findUncutRough(of, paint);
        cuts_.clear();
    }

    /// colors_ are those of the cuts' quarters.
    void findUncutRough(const ProgramView& of, std::uint32_t paint) {
        points_.clear();
        for (const Cut& cut : cuts_)
            points_.push_back(middleOf(of, cut));
        wholes_.resize(points_.size());
        of.paints.colors(paint, points_, glm::mat2(of.inverse), wholes_, of.materials);
        toSums(of, wholes_);
        for (std::size_t i = 0; i < cuts_.size(); ++i)
            if (of.rough.isRoughWhole(of.paints.changes()[paint], quartersAt(i), wholes_[i]))
                rough_.push_back({cuts_[i].row, cuts_[i].x});
        if (of.paints.changes()[paint].mayJump)
            findRoughCorners(of, paint);
    }

    /// points_ are the cuts' middles, wholes_ their colours.
    void findRoughCorners(const ProgramView& of, std::uint32_t paint) {
        const glm::vec2 right = 0.5f * glm::mat2(of.inverse)[0], down = 0.5f * glm::mat2(of.inverse)[1];
        colors_.resize(points_.size());
        for (const glm::vec2 way : {-right - down, right - down, down - right, right + down}) {
            corners_ = points_;
            for (glm::vec2& corner : corners_)
                corner += way;
            of.paints.colors(paint, corners_, glm::mat2(0), colors_, of.materials);
            toSums(of, colors_);
            for (std::size_t i = 0; i < cuts_.size(); ++i)
                if (of.rough.isRoughCorner(colors_[i], wholes_[i]))
                    rough_.push_back({cuts_[i].row, cuts_[i].x});
        }
    }

    /// While colors_ are those of the cuts' quarters.
    QuarterColors quartersAt(std::size_t cut) const { return QuarterColors(&colors_[4 * cut], 4); }
    glm::vec2 middleOf(const ProgramView& of, const Cut& cut) const {
        return of.point({cut.x + 0.5, top_ + cut.row + 0.5});
    }

    int width_ = 0, top_ = 0, rows_ = 0;
    std::vector<std::vector<Side>> sides_;  ///< by paint
    std::vector<std::uint32_t> programs_;   ///< that have sides
    Accumulator<Wholes<float>> coverage_;
    Accumulator<Quarters> quarters_;
    std::vector<Share> shares_;
    std::vector<Cut> cuts_;
    std::vector<BandPixel> rough_;
    std::vector<glm::vec2> points_, corners_;
    std::vector<Float4> colors_, wholes_;
    ProgramPixels pixels_;
};

}  // namespace vtm::asset
