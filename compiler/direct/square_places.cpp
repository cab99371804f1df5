#include "compiler/direct/square_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace vtm::compiler {
namespace {

/// Of heights, and of what lies right of an edge if it is positive.
constexpr float fixedPoint = 8192;
/// Beyond this, an edge has all of a square on one side.
constexpr float mostApart = 2.25f;
/// Of shares.
constexpr float fixedShare = 0x1p16f;

/// By column or row: how far the places of it are moved. In the order of the multiples of the golden section.
constexpr std::array<float, placesAlong> turns = [] {
    std::array<float, placesAlong> parts{}, ranks{};
    for (int i = 0; i < placesAlong; ++i) {
        const float multiple = float(i) * std::numbers::phi_v<float>;
        parts[std::size_t(i)] = multiple - float(int(multiple));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        int rank = 0;
        for (const float other : parts)
            rank += other < parts[i];
        ranks[i] = (float(rank) + 0.5f) / placesInSquare;
    }
    return ranks;
}();

/// The same in fixed point.
constexpr std::array<std::int16_t, placesAlong> fixedTurns = [] {
    std::array<std::int16_t, placesAlong> fixed{};
    for (std::size_t i = 0; i < fixed.size(); ++i)
        fixed[i] = std::int16_t(fixedPoint * turns[i]);
    return fixed;
}();
constexpr auto fixedRow = std::int16_t(fixedPoint / placesAlong);

std::int16_t fixedHeight(float y) { return std::int16_t(fixedPoint * std::clamp(y, 0.0f, 1.0f)); }

/// Half of a row of places. Of comparisons written one by one, compilers make single numbers again.
using Eight = std::int16_t __attribute__((vector_size(16)));
constexpr std::size_t halves = placesAlong * sizeof(std::int16_t) / sizeof(Eight);
using Row = std::array<Eight, halves>;

Eight all(std::int16_t value) { return Eight{} + value; }

Row rowAt(const std::int16_t* from) {
    Row row;
    std::memcpy(row.data(), from, sizeof(row));
    return row;
}

/// From the first one on, sums up to each and with it.
Eight runningSums(Eight x) {
    constexpr Eight none{};
    x += __builtin_shufflevector(none, x, 0, 8, 9, 10, 11, 12, 13, 14);
    x += __builtin_shufflevector(none, x, 0, 0, 8, 9, 10, 11, 12, 13);
    x += __builtin_shufflevector(none, x, 0, 0, 0, 0, 8, 9, 10, 11);
    return x;
}

/// Adds to some of a row's winding numbers: isIn(k) has all bits where it does, in that half.
template <class IsIn>
void addToRow(std::int16_t* windings, std::int32_t winding, const IsIn& isIn) {
    Row row = rowAt(windings);
    for (std::size_t k = 0; k < halves; ++k)
        row[k] += isIn(k) & all(std::int16_t(winding));
    std::memcpy(windings, row.data(), sizeof(row));
}

std::uint16_t fixedOf(float share) { return std::uint16_t(std::min(fixedShare * share, fixedShare - 1)); }

float shareOfAll(std::int32_t sum) { return float(sum) / (float(fullLight) * placesInSquare); }

/// Parts of the light at half a row of places.
using EightLights = std::uint16_t __attribute__((vector_size(16)));
using FourSums = std::uint32_t __attribute__((vector_size(16)));

/// Parts of `of`; shares are as fixedOf() gives them.
EightLights partsOf(EightLights of, EightLights shares) {
#if defined(__SSE2__)  // compilers multiply in 32 bits
    return EightLights(_mm_mulhi_epu16(__m128i(of), __m128i(shares)));
#else
    EightLights parts;
    for (std::size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); ++i)
        parts[i] = std::uint16_t(std::uint32_t(of[i]) * shares[i] >> 16);
    return parts;
#endif
}

/// Takes part(lights) of those where isInside(row, half) has all bits, and not none.
template <class IsInside, class Part>
TakenLight take(PlaceLights& lights, const IsInside& isInside, const Part& part) {
    // What is taken at two places is summed in 16 bits.
    static_assert(halves == 2 && 2 * fullLight <= 0xFFFF);
    FourSums sums{};
    EightLights most{};
    for (std::size_t r = 0; r < placesAlong; ++r) {
        EightLights ofTwo{};
        for (std::size_t k = 0; k < halves; ++k) {
            std::uint16_t* const at = &lights[r * placesAlong + k * placesAlong / halves];
            EightLights here;
            std::memcpy(&here, at, sizeof(here));
            const auto inside = EightLights(isInside(r, k));
            const EightLights taken = part(here) & inside;
            here -= taken;
            std::memcpy(at, &here, sizeof(here));
            ofTwo += taken;
            most |= here & inside;
        }
        const auto pairs = FourSums(ofTwo);
        sums += (pairs & 0xFFFF) + (pairs >> 16);
    }
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < sizeof(sums) / sizeof(sums[0]); ++i)
        sum += sums[i];
    std::uint16_t mostOfAll = 0;
    for (std::size_t i = 0; i < sizeof(most) / sizeof(most[0]); ++i)
        mostOfAll = std::uint16_t(mostOfAll | most[i]);
    return {shareOfAll(std::int32_t(sum)), mostOfAll};
}

template <class IsInside>
TakenLight take(PlaceLights& lights, const IsInside& isInside, float alpha) {
    if (alpha >= 1)
        return take(lights, isInside, [](EightLights here) { return here; });
    const EightLights shares = EightLights{} + fixedOf(alpha);
    return take(lights, isInside, [=](EightLights here) { return partsOf(here, shares); });
}

using Numbers = std::array<std::int32_t, placesAlong>;

/// Of places at `from` + i `by` less turns[i], in squares: those before them, but from `least` to `most`.
/// Four at a time.
Numbers alongTurns(float from, float by, float least, float most) {
    using Four = float __attribute__((vector_size(16)));
    using FourInts = std::int32_t __attribute__((vector_size(16)));
    constexpr std::size_t lanes = 4;
    constexpr Four first{0, 1, 2, 3};
    const Four low = Four{} + least, high = Four{} + most;
    Numbers numbers;
    for (std::size_t i = 0; i < placesAlong; i += lanes) {
        Four turn;
        std::memcpy(&turn, &turns[i], sizeof(turn));
        Four place = (from + (first + float(i)) * by - turn) * placesAlong + 1;
        place = place < high ? place : high;
        place = place > low ? place : low;
        const FourInts whole = __builtin_convertvector(place, FourInts);
        std::memcpy(&numbers[i], &whole, sizeof(whole));
    }
    return numbers;
}

}  // namespace

PlaceRange::PlaceRange(float top, float bottom) : top_(fixedHeight(top)), bottom_(fixedHeight(bottom)) {}

/// Calls visit(row, isIn) for each row of places that has some in the range; isIn(k) tells which.
template <class Visit>
void PlaceRange::forEachRow(const Visit& visit) const {
    const Row turnsOf = rowAt(fixedTurns.data());
    const int first = top_ / fixedRow, end = (bottom_ + fixedRow - 1) / fixedRow;
    for (int r = first; r < end; ++r) {
        const Eight top = all(std::int16_t(top_ - r * fixedRow)),
                    bottom = all(std::int16_t(bottom_ - r * fixedRow));
        visit(std::size_t(r), [&](std::size_t k) { return (turnsOf[k] >= top) & (turnsOf[k] < bottom); });
    }
}

void PlaceRange::add(PlaceWindings& windings, std::int32_t winding) const {
    forEachRow([&](std::size_t r, const auto& isIn) { addToRow(&windings[r * placesAlong], winding, isIn); });
}

PlacedEdge::PlacedEdge(glm::vec2 a, float slope)
    : a_(a), perX_(1 / std::max(1.0f, std::abs(slope))), perY_(-slope * perX_) {
    for (std::size_t i = 0; i < placesAlong; ++i) {
        const float at = float(i) / placesAlong;
        columns_[i] = std::int16_t(fixedPoint * (perX_ * at + perY_ * turns[i]));
        rows_[i] = std::int16_t(-fixedPoint * (perX_ * turns[i] + perY_ * at));
    }
}

std::array<std::int16_t, placesAlong> PlacedEdge::columnsIn(int square) const {
    const float constant = perX_ * (float(square) - a_.x) - perY_ * a_.y;
    const auto fixed = std::int16_t(fixedPoint * std::clamp(constant, -mostApart, mostApart));
    std::array<std::int16_t, placesAlong> columns;
    for (std::size_t c = 0; c < placesAlong; ++c)
        columns[c] = std::int16_t(columns_[c] + fixed);
    return columns;
}

void PlacedEdge::add(PlaceWindings& windings, int square, std::int32_t winding) const {
    const Row columns = rowAt(columnsIn(square).data());
    for (std::size_t r = 0; r < placesAlong; ++r) {
        const Eight row = all(rows_[r]);
        addToRow(&windings[r * placesAlong], winding, [&](std::size_t k) { return columns[k] > row; });
    }
}

void PlacedEdge::add(PlaceWindings& windings, int square, std::int32_t winding,
                     const PlaceRange& range) const {
    const Row columns = rowAt(columnsIn(square).data());
    range.forEachRow([&](std::size_t r, const auto& isIn) {
        const Eight row = all(rows_[r]);
        addToRow(&windings[r * placesAlong], winding,
                 [&](std::size_t k) { return (columns[k] > row) & isIn(k); });
    });
}

PlaceSteps::PlaceSteps(int squares)
    : squares_(squares),
      last_(float(squares * placesAlong)),
      rowSize_(std::size_t(squares) * placesAlong + 1),
      steps_(rowSize_ * placesAlong) {}

void PlaceSteps::add(int first, int end, float x, float perRow, std::int32_t winding) {
    const float inRow0 = x - float(first) * perRow;
    const Numbers places = alongTurns(inRow0, perRow, 0, last_);
    for (auto r = std::size_t(first); r < std::size_t(end); ++r) {
        std::int16_t& step = steps_[r * rowSize_ + std::size_t(places[r])];
        step = std::int16_t(step + winding);
    }
}

void PlaceSteps::addLevel(int first, int end, glm::vec2 a, glm::vec2 b, std::int32_t winding) {
    hasLevel_ = true;
    inColumn_.resize(std::size_t(squares_));
    fromColumn_.resize(std::size_t(squares_));
    const auto columnAt = [&](float x) {  // the first whose middle is not on its left
        return int(std::ceil(std::clamp(x * placesAlong - 0.5f, 0.0f, last_)));
    };
    const bool goesRight = b.x > a.x;
    const int left = columnAt(std::min(a.x, b.x)), right = columnAt(std::max(a.x, b.x));
    // On the right of one that goes right is what lies above it.
    startFrom(goesRight ? left : right, first, winding);
    startFrom(goesRight ? right : left, end, -winding);
    const std::int32_t below = goesRight ? -winding : winding;
    const float slope = (b.y - a.y) / (b.x - a.x);
    for (int square = left / placesAlong; square * placesAlong < right; ++square) {
        const float inColumn0 = a.y + (float(square) + 0.5f / placesAlong - a.x) * slope;
        const Numbers rows = alongTurns(inColumn0, slope / placesAlong, float(first), float(end));
        LevelSteps& steps = inColumn_[std::size_t(square)];
        const int begin = std::max(left - square * placesAlong, 0),
                  behind = std::min(right - square * placesAlong, placesAlong);
        for (auto c = std::size_t(begin); c < std::size_t(behind); ++c) {
            std::int16_t& step = steps[std::size_t(rows[c])][c];
            step = std::int16_t(step + below);
        }
    }
}

/// A winding number from a row down, in all columns from one on.
void PlaceSteps::startFrom(int column, int row, std::int32_t winding) {
    if (column >= squares_ * placesAlong)
        return;
    LevelSteps& steps = fromColumn_[std::size_t(column / placesAlong)];
    std::int16_t& step = steps[std::size_t(row)][std::size_t(column % placesAlong)];
    step = std::int16_t(step + winding);
}

void PlaceSteps::windingsOf(int square, Column& before, PlaceWindings& windings) const {
    Row in{}, from{};
    for (std::size_t r = 0; r < placesAlong; ++r) {
        const Row steps = rowAt(&steps_[r * rowSize_ + std::size_t(square) * placesAlong]);
        if (hasLevel_) {
            const Row inHere = rowAt(inColumn_[std::size_t(square)][r].data()),
                      fromHere = rowAt(fromColumn_[std::size_t(square)][r].data());
            for (std::size_t k = 0; k < halves; ++k) {
                in[k] += inHere[k];
                from[k] += fromHere[k];
            }
        }
        Row row;
        for (std::size_t k = 0; k < halves; ++k) {
            const Eight sums = runningSums(steps[k] + from[k]) + all(before[r]);
            before[r] = sums[7];
            row[k] = sums + in[k];
        }
        std::memcpy(&windings[r * placesAlong], row.data(), sizeof(row));
    }
}

TakenLight takeLight(PlaceLights& lights, const PlaceWindings& windings, bool isEvenOdd, float alpha) {
    const auto windingsAt = [&](std::size_t r, std::size_t k) {
        return rowAt(&windings[r * placesAlong])[k];
    };
    if (isEvenOdd)
        return take(
            lights, [&](std::size_t r, std::size_t k) { return (windingsAt(r, k) & 1) != 0; }, alpha);
    return take(
        lights, [&](std::size_t r, std::size_t k) { return windingsAt(r, k) != 0; }, alpha);
}

TakenLight takeLightBeside(PlaceLights& lights, const PlacedEdge& edge, int square, bool isLeft,
                           float alpha) {
    // All of them where the edge is not, and then none.
    const Eight side = all(isLeft ? -1 : 0);
    const Row columns = rowAt(edge.columnsIn(square).data());
    return take(
        lights, [&](std::size_t r, std::size_t k) { return (columns[k] > all(edge.rows_[r])) ^ side; },
        alpha);
}

float mixLights(PlaceLights& __restrict lights, float share, const PlaceLights& __restrict others,
                float times) {
    const std::uint16_t kept = fixedOf(1 - share), added = fixedOf(times);
    for (std::size_t i = 0; i < lights.size(); ++i)
        lights[i] =
            std::uint16_t((std::uint32_t(lights[i]) * kept >> 16) + (std::uint32_t(others[i]) * added >> 16));
    std::int32_t sum = 0;
    for (const std::uint16_t light : lights)
        sum += std::int16_t(light);
    return shareOfAll(sum);
}

}  // namespace vtm::compiler
