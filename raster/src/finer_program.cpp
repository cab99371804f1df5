#include "raster/src/finer_program.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/vec2.hpp>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/view.hpp>
#include "raster/chord.hpp"
#include "raster/src/rough.hpp"

namespace vtm::asset {
namespace {

/// Rough pixels are drawn together across gaps of fewer columns: each box takes all of the program's chords
/// in the band, and a column of a gap about as long as so many of them.
int maxFinerGap(std::size_t chords) {
    constexpr std::size_t leastGap = 4, chordsOfColumn = 10;
    return int(std::max(leastGap, chords / chordsOfColumn));
}

/// Boxes around all of the pixels, which are sorted by column, disjoint and from left to right.
std::vector<BandBox> boxesAround(std::span<const BandPixel> pixels, int maxGap) {
    std::vector<BandBox> boxes;
    for (const BandPixel& p : pixels) {
        if (boxes.empty() || p.x >= boxes.back().end + maxGap)
            boxes.push_back({p.x, p.x + 1, p.row, p.row + 1});
        BandBox& box = boxes.back();
        box = {box.first, p.x + 1, std::min(box.top, p.row), std::max(box.bottom, p.row + 1)};
    }
    return boxes;
}

/// Of a box whose upper left corner is there.
View finerView(const View& view, const BandBox& box, glm::dvec2 corner) {
    View finer{box.width() * finerSide, box.height() * finerSide, view.toPixels};
    finer.toPixels[2] -= corner;
    for (int i = 0; i < 3; ++i)
        finer.toPixels[i] *= double(finerSide);
    return finer;
}

}  // namespace

BandPrograms::BandPrograms() = default;
BandPrograms::~BandPrograms() = default;

void BandPrograms::addFiner(const ProgramView& of, std::uint32_t paint) {
    if (!finer_)
        finer_ = std::make_unique<FinerProgram>();
    finer_->draw(of, paint, top_, sides_[paint], rough_, *sums_);
}

void FinerProgram::draw(const ProgramView& of, std::uint32_t paint, int top,
                        std::span<const ProgramSide> sides, std::span<BandPixel> pixels,
                        Accumulator<Float4>& sums) {
    std::ranges::sort(pixels, {}, &BandPixel::x);
    auto next = pixels.begin();
    for (const BandBox& box : boxesAround(pixels, maxFinerGap(sides.size()))) {
        const auto last =
            std::find_if(next, pixels.end(), [&](const BandPixel& p) { return p.x >= box.end; });
        drawBox(of, paint, top, sides, box, {next, last});
        for (; next != last; ++next)
            sums.addPixel(std::size_t(next->row), next->x,
                          meanAt(box, next->row - box.top, next->x - box.first));
    }
}

/// Chords are within chordTolerance of a pixel of their curves here, and finer pixels need no finer ones.
void FinerProgram::drawBox(const ProgramView& of, std::uint32_t paint, int top,
                           std::span<const ProgramSide> sides, const BandBox& box,
                           std::span<const BandPixel> pixels) {
    limits::check();
    FinerPixels wanted(box.width(), box.height());
    for (const BandPixel& p : pixels)
        wanted.add(p.x - box.first, p.row - box.top);
    const glm::dvec2 corner(box.first, top + box.top);
    const View view = finerView(of.view, box, corner);
    const ProgramView finer(of.paints, of.sums, view, of.materials, finerTolerance * of.rough.times, false,
                            of.finerLevels - 1, &wanted);

    bands_.clear(view.height);
    for (const ProgramSide& side : sides) {
        const Chord& c = *side.chord;
        bands_.add({float(finerSide) * (c.a - glm::vec2(corner)),
                    float(finerSide) * (c.b - glm::vec2(corner)), c.left, c.right},
                   float(view.width), float(view.height));
    }
    means_.assign(std::size_t(box.width()) * std::size_t(box.height()), Float4{});
    programs_.resize(of.paints.asset().paints.size(), view.width);
    sums_.resize(view.width);
    for (int band = 0; band * bandRows < view.height; ++band) {
        const int first = band * bandRows, rows = std::min(bandRows, view.height - first);
        programs_.clear();
        for (const Chord& chord : bands_.of(band))
            programs_.addSide(chord, paint, float(chord.left == paint) - float(chord.right == paint));
        programs_.draw(finer, first, rows, sums_);
        for (int row = 0; row < rows; ++row)
            sums_.resolve(std::size_t(row), [&](int from, int to, Float4 color) {
                if (!isNothing(color))
                    addToMeans(box, first + row, from, to, color);
            });
    }
}

/// Finer pixels of a row.
void FinerProgram::addToMeans(const BandBox& box, int row, int first, int end, Float4 color) {
    constexpr float share = 1.0f / (finerSide * finerSide);
    while (first < end) {
        const int next = std::min(end, (first / finerSide + 1) * finerSide);
        meanAt(box, row / finerSide, first / finerSide) += float(next - first) * share * color;
        first = next;
    }
}

}  // namespace vtm::asset
