#include "compiler/direct/square_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// All bits or none.
std::int16_t maskOf(bool is) { return is ? -1 : 0; }

std::uint16_t fixedOf(float share) { return std::uint16_t(std::min(fixedShare * share, fixedShare - 1)); }

float shareOfAll(std::int32_t sum) { return float(sum) / (float(fullLight) * placesInSquare); }

TakenLight sumsOf(const std::array<std::int16_t, placesInSquare>& taken,
                  const std::array<std::int16_t, placesInSquare>& left) {
    std::int32_t sum = 0;
    for (const std::int16_t t : taken)
        sum += t;
    std::int16_t most = 0;
    for (const std::int16_t l : left)
        most = std::int16_t(most | l);
    return {shareOfAll(sum), std::uint16_t(most)};
}

/// Takes part(light) of each light where inside(winding) gives all bits, and not none. Loops of one type each
/// are compiled to eight places at a time.
template <class Inside, class Part>
TakenLight take(PlaceLights& __restrict lights, const PlaceWindings& __restrict windings,
                const Inside& inside, const Part& part) {
    std::array<std::int16_t, placesInSquare> taken, left;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::int16_t is = inside(windings[i]);
        taken[i] = std::int16_t(part(lights[i]) & is);
        lights[i] = std::uint16_t(lights[i] - std::uint16_t(taken[i]));
        left[i] = std::int16_t(lights[i] & is);
    }
    return sumsOf(taken, left);
}

template <class Inside>
TakenLight take(PlaceLights& lights, const PlaceWindings& windings, const Inside& inside, float alpha) {
    if (alpha >= 1)
        return take(lights, windings, inside, [](std::uint16_t light) { return light; });
    const std::uint16_t share = fixedOf(alpha);
    return take(lights, windings, inside,
                [=](std::uint16_t light) { return std::uint16_t(std::uint32_t(light) * share >> 16); });
}

}  // namespace

PlaceRange::PlaceRange(float top, float bottom) : top_(fixedHeight(top)), bottom_(fixedHeight(bottom)) {}

void PlaceRange::add(PlaceWindings& windings, std::int32_t winding) const {
    const auto amount = std::int16_t(winding);
    for (int r = 0; r < placesAlong; ++r) {
        const auto top = std::int16_t(top_ - r * fixedRow), bottom = std::int16_t(bottom_ - r * fixedRow);
        std::int16_t* row = &windings[std::size_t(r) * placesAlong];
        for (std::size_t c = 0; c < placesAlong; ++c) {
            const bool isIn = (fixedTurns[c] >= top) & (fixedTurns[c] < bottom);
            row[c] = std::int16_t(row[c] + (maskOf(isIn) & amount));
        }
    }
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
    const auto columns = columnsIn(square);
    const auto amount = std::int16_t(winding);
    for (std::size_t r = 0; r < placesAlong; ++r) {
        const std::int16_t row = rows_[r];
        std::int16_t* to = &windings[r * placesAlong];
        for (std::size_t c = 0; c < placesAlong; ++c)
            to[c] = std::int16_t(to[c] + (maskOf(columns[c] > row) & amount));
    }
}

void PlacedEdge::add(PlaceWindings& windings, int square, std::int32_t winding,
                     const PlaceRange& range) const {
    const auto columns = columnsIn(square);
    const auto amount = std::int16_t(winding);
    for (std::size_t r = 0; r < placesAlong; ++r) {
        const std::int16_t row = rows_[r];
        const auto top = std::int16_t(range.top_ - int(r) * fixedRow),
                   bottom = std::int16_t(range.bottom_ - int(r) * fixedRow);
        std::int16_t* to = &windings[r * placesAlong];
        for (std::size_t c = 0; c < placesAlong; ++c) {
            const bool isIn = (columns[c] > row) & (fixedTurns[c] >= top) & (fixedTurns[c] < bottom);
            to[c] = std::int16_t(to[c] + (maskOf(isIn) & amount));
        }
    }
}

PlaceSteps::PlaceSteps(int squares)
    : turns_(turns),
      squares_(squares),
      last_(float(squares * placesAlong)),
      rowSize_(std::size_t(squares) * placesAlong + 1),
      steps_(rowSize_ * placesAlong) {}

void PlaceSteps::add(int first, int end, glm::vec2 a, glm::vec2 b, float slope, std::int32_t winding) {
    hasLevel_ = true;
    here_.resize(std::size_t(squares_));
    fromHere_.resize(std::size_t(squares_) + 1);
    const float top = float(first) / placesAlong, bottom = float(end) / placesAlong;
    if (top < a.y)
        add(PlacedEdge(a, 0), top, a.y, a.x, a.x, winding);
    add(PlacedEdge(a, slope), std::max(top, a.y), std::min(bottom, b.y), std::min(a.x, b.x),
        std::max(a.x, b.x), winding);
    if (b.y < bottom)
        add(PlacedEdge(b, 0), b.y, bottom, b.x, b.x, winding);
}

void PlaceSteps::add(const PlacedEdge& edge, float top, float bottom, float left, float right,
                     std::int32_t winding) {
    const PlaceRange range(top, bottom);
    const auto square = [&](float x) { return int(std::clamp(x, 0.0f, float(squares_))); };
    const int behind = right < 0 ? 0 : std::min(square(right) + 1, squares_);
    for (int i = square(left); i < behind; ++i)
        edge.add(here_[std::size_t(i)], i, winding, range);
    range.add(fromHere_[std::size_t(behind)], winding);
}

void PlaceSteps::windingsOf(int square, Before& before, PlaceWindings& windings) const {
    for (std::size_t r = 0; r < placesAlong; ++r) {
        const std::int16_t* steps = &steps_[r * rowSize_ + std::size_t(square) * placesAlong];
        std::int16_t winding = before.rows[r];
        for (std::size_t c = 0; c < placesAlong; ++c)
            windings[r * placesAlong + c] = winding = std::int16_t(winding + steps[c]);
        before.rows[r] = winding;
    }
    if (!hasLevel_)
        return;
    const PlaceWindings &here = here_[std::size_t(square)], &fromHere = fromHere_[std::size_t(square)];
    for (std::size_t i = 0; i < windings.size(); ++i)
        before.places[i] = std::int16_t(before.places[i] + fromHere[i]);
    for (std::size_t i = 0; i < windings.size(); ++i)
        windings[i] = std::int16_t(windings[i] + before.places[i] + here[i]);
}

TakenLight takeLight(PlaceLights& lights, const PlaceWindings& windings, bool isEvenOdd, float alpha) {
    if (isEvenOdd)
        return take(
            lights, windings, [](std::int16_t w) { return maskOf((w & 1) != 0); }, alpha);
    return take(
        lights, windings, [](std::int16_t w) { return maskOf(w != 0); }, alpha);
}

TakenLight takeLightBeside(PlaceLights& __restrict lights, const PlacedEdge& edge, int square, bool isLeft,
                           float alpha) {
    // All of them where the edge is not, and then none.
    const std::int16_t side = maskOf(isLeft);
    const auto columns = edge.columnsIn(square);
    const bool isOpaque = alpha >= 1;
    const std::uint16_t share = fixedOf(alpha);
    std::array<std::int16_t, placesInSquare> taken, left;
    for (std::size_t r = 0; r < placesAlong; ++r) {
        const std::int16_t row = edge.rows_[r];
        std::uint16_t* light = &lights[r * placesAlong];
        std::int16_t *const takenHere = &taken[r * placesAlong], *const leftHere = &left[r * placesAlong];
        for (std::size_t c = 0; c < placesAlong; ++c) {
            const auto inside = std::int16_t(maskOf(columns[c] > row) ^ side);
            const auto part = isOpaque ? light[c] : std::uint16_t(std::uint32_t(light[c]) * share >> 16);
            takenHere[c] = std::int16_t(part & inside);
            light[c] = std::uint16_t(light[c] - std::uint16_t(takenHere[c]));
            leftHere[c] = std::int16_t(light[c] & inside);
        }
    }
    return sumsOf(taken, left);
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
