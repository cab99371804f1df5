/// \file
/// Drawing one view of what is scanned: the chords of its boundaries by bands of rows, then one band after
/// the other. Pixels in which paints are rough are drawn finer.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <vtm/limits/limits.hpp>
#include "raster/src/boundary_chords.hpp"
#include "raster/src/placed_chords.hpp"
#include "raster/src/row_sums.hpp"
#include "raster/src/scan_programs.hpp"
#include "raster/src/scanned.hpp"
#include "raster/steepness.hpp"

namespace vtm::asset {

/// What one picture needs and the next uses again.
struct RowScratch {
    Bands bands;
    Accumulator<Float4> colors;
    BandPrograms programs;
    PlacedChordsByMap placed;
};

/// The chords of a picture under a view, band by band.
class Drawing {
public:
    Drawing(const Scanned& of, const View& view, const MaterialFunction& materials, RowScratch& scratch,
            int finerLevels)
        : of_(of),
          view_(view),
          scratch_(scratch),
          programs_(of.paints, of.sums, view_, materials, 1, of.drawn.size() <= 1, finerLevels, nullptr) {
        scratch_.bands.clear(view.height);
        scratch_.colors.resize(view.width);
        scratch_.programs.resize(of.asset().paints.size(), view.width);
    }

    /// What is seen of the picture is the same of a part of it.
    enum class Of { Picture, SeenSquares };

    void add(Of what) {
        if (what == Of::Picture)
            return addParts(0, of_.partCount());
        for (const Scanned::Drawn& drawn : of_.drawn) {
            auto chords = chordsOf(drawn.own.place(), view_, scratch_.bands);
            drawn.own.forEachOfSeen(
                chords.pixel(), [&](glm::dvec2 min, glm::dvec2 max) { return chords.mayShow(min, max); },
                [&](const Boundaries& boundaries) { chords.add(boundaries); });
            if (drawn.map != Scanned::noMap)
                addPlaced(drawn.map, 0, drawn.placed.maps);
        }
    }
    /// Some of the parts that make up the picture.
    void addParts(std::size_t first, std::size_t end) {
        for (const Scanned::Drawn& drawn : of_.drawn) {
            const std::size_t boxes = drawn.own.boxCount(), parts = boxes + drawn.placedParts();
            const std::size_t from = std::min(first, parts), to = std::min(end, parts);
            auto chords = chordsOf(drawn.own.place(), view_, scratch_.bands);
            addChords(chords, drawn.own, from, std::min(to, boxes));
            if (const std::size_t next = std::max(from, boxes); next < to)
                addPlaced(drawn.map, (next - boxes) * Scanned::placedOfPart,
                          (to - boxes) * Scanned::placedOfPart);
            first -= from;
            end -= to;
        }
    }
    void addChord(const Chord& chord) { scratch_.bands.add(chord, float(view_.width), float(view_.height)); }

    template <class Store>
    void draw(Store& store) {
        for (int band = 0; band * bandRows < view_.height; ++band)
            draw(band, std::array{scratch_.bands.of(band)}, store);
    }
    /// One band, of chords that were made for it, some in each part.
    template <class Store>
    void draw(int band, std::span<const std::span<const Chord>> parts, Store& store) {
        limits::check();
        const int top = band * bandRows, rows = std::min(bandRows, view_.height - top);
        BandPrograms& programs = scratch_.programs;
        programs.clear();
        for (const std::span<const Chord> chords : parts)
            addToSums(chords, top, rows);
        programs.draw(programs_, top, rows, scratch_.colors);
        for (int row = 0; row < rows; ++row)
            drawRow(top, row, store);
    }

private:
    /// Of a map's boxes first to end - 1. While those of one are made, the next one is fetched.
    template <class Take>
    static void addChords(Chords<Take>& chords, const ScannedMap& map, std::size_t first, std::size_t end) {
        const Boundaries* next = nullptr;
        for (std::size_t i = first; i < end || next; ++i) {
            limits::check();
            const Boundaries* found = nullptr;
            if (i < end && chords.mayMatter(map.box(i).min(), map.box(i).max())) {
                found = &map.box(i).at(chords.pixel());
                found->prefetch();
            }
            if (next)
                chords.add(*next);
            next = found;
        }
    }

    /// Those first to end - 1 that are placed in a map.
    void addPlaced(std::uint32_t map, std::size_t first, std::size_t end) {
        const Affine2 toPixels = toPixelsOf(view_);
        of_.placed->forEach(
            map, first, end,
            [&](std::size_t number, const ScannedMap& own, const Affine2& toPicture,
                const PlacedPaints& paints) {
                const Affine2 place = compose(toPixels, toPicture);
                const Seen seen = seenOf(place);
                if (seen == Seen::All) {
                    addAt(place.offset, scratch_.placed.of(number, own, place.linear), paints);
                } else if (seen == Seen::Part) {
                    auto chords = chordsOf({toPicture.linear * (1 / own.place().extent), toPicture.offset},
                                           view_, scratch_.bands, std::cref(paints));
                    addChords(chords, own, 0, own.boxCount());
                }
                return seen != Seen::Nothing;
            });
    }

    void addAt(glm::vec2 place, const PlacedChords& placed, const PlacedPaints& paints) {
        limits::check();
        const auto there = placed.chords | std::views::transform([&](const Chord& c) {
                               return Chord{c.a + place, c.b + place, paints(c.left), paints(c.right)};
                           });
        scratch_.bands.addAll(there, place.y + placed.min.y, place.y + placed.max.y);
    }

    /// What the view shows of a placed map. What lies beside it changes no pixel.
    enum class Seen { Nothing, Part, All };
    Seen seenOf(const Affine2& place) const {
        const glm::dvec2 centre = place(glm::dvec2(0.5)), size(view_.width, view_.height);
        const glm::dvec2 reach = 0.5 * (glm::abs(place.linear[0]) + glm::abs(place.linear[1])) + 1.0;
        const glm::dvec2 low = centre - reach, high = centre + reach;
        if (!(high.x > 0 && high.y > 0 && low.x < size.x && low.y < size.y))
            return Seen::Nothing;
        return low.x >= 0 && low.y >= 0 && high.x <= size.x && high.y <= size.y ? Seen::All : Seen::Part;
    }

    void addToSums(std::span<const Chord> chords, int top, int rows) {
        BandPrograms& programs = scratch_.programs;
        const std::uint8_t* isProgram = of_.isProgram.data();
        const Float4* solid = of_.solid.data();
        for (const Chord& c : chords) {
            if (isProgram[c.left] + isProgram[c.right] != 0) {
                if (isProgram[c.left])
                    programs.addSide(c, c.left, 1);
                if (isProgram[c.right])
                    programs.addSide(c, c.right, -1);
                if (isProgram[c.left] && isProgram[c.right])
                    continue;
            }
            scratch_.colors.add(c, float(top), rows, solid[c.left] - solid[c.right]);
        }
    }

    template <class Store>
    void drawRow(int top, int row, Store& store) {
        const int y = top + row;
        ProgramPixels& pixels = scratch_.programs.pixels();
        if (pixels.empty())
            return scratch_.colors.resolveFours(
                std::size_t(row), [&](int first, int end, Float4 color) { store(y, first, end, color); },
                [&](int first, std::span<const Float4> colors) { store(y, first, colors); });
        pixels.beginRow(row);
        const auto drawAlone = [&](int first, int end, std::uint32_t paint) {
            scratch_.programs.drawAlone(programs_, paint, y, first, end, store);
        };
        scratch_.colors.resolve(std::size_t(row), [&](int first, int end, Float4 color) {
            pixels.finish(y, first, end, color, store, drawAlone);
        });
    }

    const Scanned& of_;
    const View view_;
    RowScratch& scratch_;
    const ProgramView programs_;
};

/// Draws what needs no boundaries. Returns whether that is all.
template <class Store>
bool drawIfEmpty(const Scanned& of, const View& view, const Store& store) {
    validate(view);
    if (view.width == 0 || view.height == 0)
        return true;
    const double determinant = glm::determinant(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    if (!of.drawn.empty() && std::abs(determinant) > std::numeric_limits<double>::min())
        return false;
    for (int y = 0; y < view.height; ++y)
        store(y, 0, view.width, Float4{});
    return true;
}

inline int finerLevelsOf(const Scanned& of, const View& view) {
    return of.sums == Sums::Encoded ? finerLevels(of.asset(), view) : 0;
}

template <class Store>
void drawScanned(const Scanned& of, const View& view, const MaterialFunction& materials, RowScratch& scratch,
                 const Store& store, Drawing::Of what = Drawing::Of::Picture) {
    if (drawIfEmpty(of, view, store))
        return;
    const limits::Stage stage("scanning");
    Drawing drawing(of, view, materials, scratch, finerLevelsOf(of, view));
    drawing.add(what);
    drawing.draw(store);
}

}  // namespace vtm::asset
