/// \file
/// What paint programs add to a band of pixels: each by its own coverage, and steep ones, where they have
/// other shares of a pixel's quarters than of the whole, by those too (docs/coverage.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "asset/scan.hpp"
#include "asset/src/blend.hpp"
#include "asset/src/paint.hpp"
#include "asset/src/program_pixels.hpp"
#include "asset/src/row_sums.hpp"
#include "asset/steepness.hpp"

namespace vtm::asset {

/// What programs are drawn for.
struct ProgramView {
    const Paints& paints;
    Sums sums;
    const View& view;
    glm::dmat2 inverse;  ///< pixels to the picture
    float leastSteep;    ///< of asset/steepness.hpp
    const MaterialFunction& materials;

    glm::vec2 point(glm::dvec2 pixel) const { return {inverse * (pixel - view.toPixels[2])}; }
};

/// What is not made better where quarters differ: a tenth of a step of 8 bits.
inline constexpr float leastPart = 0.1f / 255;

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
    ProgramPixels& pixels() { return pixels_; }

    void clear() { programs_.clear(); }
    /// A chord at which a program has `change` more on its left. It must stay until the band is drawn.
    void addSide(const Chord& chord, std::uint16_t paint, float change) {
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
        for (const std::uint16_t paint : programs_) {
            if (of.paints.steepness()[paint] > of.leastSteep)
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
        Float4 more;
    };

    /// Each pixel by the mean colour over it, times shareOf(row, first column, end, what was summed).
    template <class Grid, class ShareOf>
    void drawWholes(const ProgramView& of, std::uint16_t paint, Accumulator<Grid>& coverage,
                    const ShareOf& shareOf) {
        for (const Side& side : sides_[paint])
            coverage.add(*side.chord, float(top_), rows_, side.change);
        for (int row = 0; row < rows_; ++row) {
            int begin = 0;
            coverage.resolve(std::size_t(row), [&](int first, int end, auto sum) {
                const float share = shareOf(row, first, end, sum);
                if (std::abs(share) < leastShare)
                    return addShares(of, paint, row, begin);
                if (shares_.empty())
                    begin = first;
                shares_.push_back({end, share});
            });
            addShares(of, paint, row, begin);
        }
    }

    /// In the pixels of a row from `first` on.
    void addShares(const ProgramView& of, std::uint16_t paint, int row, int first) {
        if (shares_.empty())
            return;
        const int end = shares_.back().end;
        colors_.resize(std::size_t(end - first));
        const glm::mat2 pixel(of.inverse);
        of.paints.colors(paint, {of.point({first + 0.5, top_ + row + 0.5}), pixel}, pixel[0], colors_,
                         of.materials);
        toSums(of);
        Float4* pixels = pixels_.use(row, first, end);
        std::size_t i = 0;
        for (const auto& [shareEnd, share] : shares_)
            for (const auto last = std::size_t(shareEnd - first); i < last; ++i)
                pixels[i] += share * colors_[i];
        shares_.clear();
    }

    void toSums(const ProgramView& of) {
        if (of.sums == Sums::Light)
            for (Float4& color : colors_)
                color = float4(light(toVec4(color)));
    }

    void drawSteep(const ProgramView& of, std::uint16_t paint) {
        // The first moment of the program's part, times what the colour changes by over a pixel, is about
        // what the quarters make better.
        const float change = float(leastSteepChange) / of.leastSteep * of.paints.steepness()[paint];
        const float leastMoment = std::max(leastPart / change, leastShare);
        drawWholes(of, paint, quarters_, [&](int row, int first, int end, Float4 q) {
            const float share = 0.25f * (q[0] + q[1] + q[2] + q[3]);
            const float momentX = (q[1] + q[3] - q[0] - q[2]) / 16,
                        momentY = (q[2] + q[3] - q[0] - q[1]) / 16;
            if (momentX * momentX + momentY * momentY > leastMoment * leastMoment)
                for (int x = first; x < end; ++x)
                    cuts_.push_back({row, x, 0.25f * (q - share)});
            return share;
        });
        addCuts(of, paint);
    }

    void addCuts(const ProgramView& of, std::uint16_t paint) {
        const glm::mat2 quarter(0.5 * of.inverse);
        const glm::vec2 right = 0.5f * quarter[0], down = 0.5f * quarter[1];
        points_.clear();
        for (const Cut& cut : cuts_) {
            const glm::vec2 middle = of.point({cut.x + 0.5, top_ + cut.row + 0.5});
            for (const glm::vec2 way : {-right - down, right - down, down - right, right + down})
                points_.push_back(middle + way);
        }
        colors_.resize(points_.size());
        of.paints.colors(paint, points_, quarter, colors_, of.materials);
        toSums(of);
        for (std::size_t i = 0; i < cuts_.size(); ++i) {
            Float4& pixel = *pixels_.use(cuts_[i].row, cuts_[i].x, cuts_[i].x + 1);
            for (std::size_t k = 0; k < 4; ++k)
                pixel += cuts_[i].more[k] * colors_[4 * i + k];
        }
        cuts_.clear();
    }

    int width_ = 0, top_ = 0, rows_ = 0;
    std::vector<std::vector<Side>> sides_;  ///< by paint
    std::vector<std::uint16_t> programs_;   ///< that have sides
    Accumulator<Wholes<float>> coverage_;
    Accumulator<Quarters> quarters_;
    std::vector<Share> shares_;
    std::vector<Cut> cuts_;
    std::vector<glm::vec2> points_;
    std::vector<Float4> colors_;
    ProgramPixels pixels_;
};

}  // namespace vtm::asset
