#include "asset/scan.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "asset/planar_map.hpp"
#include "asset/src/paint.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::vec2;
using glm::vec4;

/// Rows that are summed at a time: their changes stay in the cache.
constexpr int bandRows = 16;

/// A chord is nowhere further from its curve, pixels: 0.33/255 of a pixel's area at most.
constexpr double chordTolerance = 1.0 / 512;

/// A piece with what does not depend on the view: how far it is from its chord, and how much it bends.
struct Boundary {
    PlanarPiece piece;
    double bulge, bend;

    explicit Boundary(const PlanarPiece& p) : piece(p), bulge(p.bulge()) {
        // |t''| is at most 4 |mA| + 2 |mB| at one end, the reverse at the other.
        const double a = std::abs(p.slopeA), b = std::abs(p.slopeB);
        bend = (4 * std::max(a, b) + 2 * std::min(a, b)) * glm::length(p.b - p.a);
    }
};

/// A straight part of a piece, in pixels, and the rows that it meets. Left and right are the pixels'.
struct Chord {
    vec2 a, b;
    std::uint16_t left, right;
    std::uint16_t firstBand, lastBand;
};
static_assert(maxViewSide / bandRows < 65536);

// ---- Chords ---------------------------------------------------------------------------------------

/// Appends the chords of all pieces that can change a pixel of the view.
class Chords {
public:
    Chords(const Map& map, const View& view, std::vector<Chord>& chords)
        : width_(view.width), height_(view.height), chords_(chords) {
        const double step = map.side / double(latticeExtent);
        linear_ = glm::dmat2(view.toPixels[0] * step, view.toPixels[1] * step);
        origin_ = view.toPixels * glm::dvec3(map.x, map.y, 1);
        const double determinant = glm::determinant(linear_);
        mirrored_ = determinant < 0;
        // The largest singular value is at most this.
        stretch_ = std::sqrt(glm::dot(linear_[0], linear_[0]) + glm::dot(linear_[1], linear_[1]));
    }

    void add(const Boundary& boundary) {
        const PlanarPiece& piece = boundary.piece;
        const dvec2 a = linear_ * piece.a + origin_, b = linear_ * piece.b + origin_;
        const double bulge = boundary.bulge * stretch_;
        if (std::max(a.y, b.y) + bulge <= 0 || std::min(a.y, b.y) - bulge >= height_ ||
            std::min(a.x, b.x) - bulge >= width_)
            return;
        // A chord over a step h of s is off by h² max|t''| / 8.
        const double steps2 = boundary.bend * stretch_ / (8 * chordTolerance);
        if (steps2 <= 1)
            return addChord(vec2(a), vec2(b), piece);
        const int count = int(std::min(std::ceil(std::sqrt(steps2)), mostChords));
        const dvec2 d = piece.b - piece.a, across = linear_ * dvec2(-d.y, d.x);
        vec2 last(a);
        for (int i = 1; i < count; ++i) {
            const double s = double(i) / count;
            const vec2 next(a + s * (b - a) + piece.height(s) * across);
            addChord(last, next, piece);
            last = next;
        }
        addChord(last, vec2(b), piece);
    }

private:
    /// Of one piece: a quarter turn as long as the largest view has fewer.
    static constexpr double mostChords = 4096;

    void addChord(vec2 a, vec2 b, const PlanarPiece& piece) {
        const float top = std::min(a.y, b.y), bottom = std::max(a.y, b.y);
        if (top == bottom || bottom <= 0 || top >= float(height_) || std::min(a.x, b.x) >= float(width_))
            return;
        const auto band = [&](float y) {
            return std::uint16_t(int(std::clamp(y, 0.0f, float(height_ - 1))) / bandRows);
        };
        const auto left = std::uint16_t(mirrored_ ? piece.right : piece.left),
                   right = std::uint16_t(mirrored_ ? piece.left : piece.right);
        chords_.push_back({a, b, left, right, band(top), band(bottom)});
    }

    int width_, height_;
    std::vector<Chord>& chords_;
    glm::dmat2 linear_;
    dvec2 origin_;
    bool mirrored_;
    double stretch_;
};

/// By band of rows: those of band i are numbers[first[i]] to numbers[first[i + 1]].
struct Bands {
    std::vector<std::uint32_t> first, next, numbers;

    void sort(const std::vector<Chord>& chords, int height) {
        const int count = (height + bandRows - 1) / bandRows;
        first.assign(std::size_t(count) + 1, 0);
        for (const Chord& c : chords)
            for (std::size_t band = c.firstBand; band <= c.lastBand; ++band)
                ++first[band + 1];
        for (std::size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        numbers.resize(first.back());
        next.assign(first.begin(), first.end() - 1);
        for (std::uint32_t i = 0; i < chords.size(); ++i)
            for (std::size_t band = chords[i].firstBand; band <= chords[i].lastBand; ++band)
                numbers[next[band]++] = i;
    }

    std::span<const std::uint32_t> of(int band) const {
        return {numbers.data() + first[std::size_t(band)], numbers.data() + first[std::size_t(band) + 1]};
    }
};

// ---- Sums -----------------------------------------------------------------------------------------

/// The changes of a band: `Value` is a colour, or the coverage of one paint.
template <class Value>
class Accumulator {
public:
    /// All is zero between pictures, so that a row as wide as before costs nothing to prepare.
    void resize(int width) {
        width_ = width;
        words_ = (std::size_t(width) + 2 + 63) / 64;
        changes_.resize(stride() * bandRows, Value(0));
        touched_.resize(words_ * bandRows);
    }

    /// Adds what changes at a chord on the way along each row from left to right: `change` is the value on
    /// its left, going from a to b with y up, minus that on its right. `top`: the first row's y.
    void add(const Chord& chord, float top, int rows, const Value& change) {
        vec2 a = chord.a, b = chord.b;
        a.y -= top;
        b.y -= top;
        // ∫ (1 - clamp(x)) dy along the chord is what the pixel has of its right side.
        Value way = change * -1.0f;
        if (a.y > b.y) {
            std::swap(a, b);
            way = change;
        }
        const float from = std::max(a.y, 0.0f), to = std::min(b.y, float(rows));
        if (!(from < to))
            return;
        const float slope = (b.x - a.x) / (b.y - a.y);
        const auto at = [&](float y) { return y <= a.y ? a.x : y >= b.y ? b.x : a.x + (y - a.y) * slope; };
        float y = from, x = at(from);
        for (int row = int(from); y < to; ++row) {
            const float nextY = std::min(float(row + 1), to), nextX = at(nextY);
            addInRow(std::size_t(row), std::min(x, nextX), std::max(x, nextX), way * (nextY - y));
            y = nextY;
            x = nextX;
        }
    }

    /// Calls run(first column, end, value) for the row's stretches of one value, in order, and clears it.
    template <class Run>
    void resolve(std::size_t row, Run&& run) {
        Value value(0);
        Value* changes = &changes_[row * stride()];
        std::uint64_t* touched = &touched_[row * words_];
        int done = 0;
        for (std::size_t w = 0; w < words_; ++w) {
            for (std::uint64_t bits = touched[w]; bits != 0; bits &= bits - 1) {
                const int column = int(w * 64) + std::countr_zero(bits);
                if (column >= width_)
                    break;
                if (column > done)
                    run(done, column, value);
                value += changes[column];
                done = column;
                changes[column] = Value(0);
            }
            touched[w] = 0;
        }
        changes[width_] = changes[width_ + 1] = Value(0);
        if (done < width_)
            run(done, width_, value);
    }

private:
    std::size_t stride() const { return std::size_t(width_) + 2; }

    void touch(std::size_t row, int first, int last) {
        std::uint64_t* touched = &touched_[row * words_];
        for (int column = first; column <= last; ++column)
            touched[column / 64] |= std::uint64_t(1) << (column % 64);
    }

    /// A straight line from x0 to x1 >= x0; `amount`: the change times the height.
    void addInRow(std::size_t row, float x0, float x1, const Value& amount) {
        const auto right = float(width_);
        if (x0 < 0 || x1 > right) {
            if (x0 >= right)
                return;
            if (x1 <= 0)
                return addInRow(row, 0, 0, amount);
            // Cut at the borders: what is left of the picture changes its first column, what is right
            // nothing.
            const float inverse = 1 / (x1 - x0);
            if (x0 < 0)
                addInRow(row, 0, 0, amount * (-x0 * inverse));
            const float from = std::max(x0, 0.0f), to = std::min(x1, right);
            return addInRow(row, from, to, amount * ((to - from) * inverse));
        }
        Value* changes = &changes_[row * stride()];
        const int first = int(x0), last = int(x1);
        touch(row, first, last + 1);
        if (first == last) {
            const Value later = amount * ((x0 + x1) * 0.5f - float(first));
            changes[first] += amount - later;
            changes[first + 1] += later;
            return;
        }
        // covered(i): what pixel i has of the amount, growing from 0 to 1.
        const float inverse = 1 / (x1 - x0), start = float(first + 1) - x0;
        float before = 0.5f * start * start * inverse;
        changes[first] += amount * before;
        for (int i = first + 1; i < last; ++i) {
            const float covered = (float(i) - x0 + 0.5f) * inverse;
            changes[i] += amount * (covered - before);
            before = covered;
        }
        const float rest = x1 - float(last);
        const float covered = 1 - 0.5f * rest * rest * inverse;
        changes[last] += amount * (covered - before);
        changes[last + 1] += amount * (1 - covered);
    }

    int width_ = 0;
    std::size_t words_ = 0;
    std::vector<Value> changes_;
    std::vector<std::uint64_t> touched_;
};

// ---- Pixels ---------------------------------------------------------------------------------------

std::uint32_t packed(vec4 color) {
#if defined(__SSE2__)
    // max first: it makes 0 of what is no number.
    const __m128 unit = _mm_min_ps(_mm_max_ps(_mm_loadu_ps(&color.x), _mm_setzero_ps()), _mm_set1_ps(1));
    const __m128i words = _mm_cvttps_epi32(_mm_add_ps(_mm_mul_ps(unit, _mm_set1_ps(255)), _mm_set1_ps(0.5f)));
    const __m128i halves = _mm_packs_epi32(words, words);
    return std::uint32_t(_mm_cvtsi128_si32(_mm_packus_epi16(halves, halves)));
#else
    const vec4 scaled = glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f;
    const std::array<std::uint8_t, 4> bytes{std::uint8_t(scaled.r), std::uint8_t(scaled.g),
                                            std::uint8_t(scaled.b), std::uint8_t(scaled.a)};
    return std::bit_cast<std::uint32_t>(bytes);
#endif
}

/// Stores a run of one colour.
class ByteStore {
public:
    explicit ByteStore(const ByteTarget& target) : target_(target) {}
    void operator()(int row, int first, int end, vec4 color) const {
        std::uint8_t* at = target_.pixels + std::size_t(row) * target_.rowBytes + std::size_t(first) * 4;
        const std::uint32_t word = packed(color);
        for (int x = first; x < end; ++x, at += 4)
            std::memcpy(at, &word, 4);
    }

private:
    ByteTarget target_;
};

class RasterStore {
public:
    explicit RasterStore(image::Raster& raster) : raster_(raster) {}
    void operator()(int row, int first, int end, vec4 color) const {
        for (int x = first; x < end; ++x)
            for (int c = 0; c < 4; ++c)
                raster_.pixel(x, row)[c] = glm::clamp(color[c], 0.0f, 1.0f);
    }

private:
    image::Raster& raster_;
};

}  // namespace

struct Scanner::Impl {
    struct Drawn {
        Map map;
        std::vector<Boundary> boundaries;
    };
    /// What one picture needs and the next uses again.
    struct Scratch {
        std::vector<Chord> chords;
        Bands bands;
        Accumulator<vec4> colors;
        Accumulator<float> coverage;
        std::vector<vec4> pixels;
    };
    Asset asset;                   ///< without trees: paints and what they need
    std::optional<Paints> paints;  ///< of `asset`
    std::vector<Drawn> drawn;
    std::vector<vec4> solid;      ///< by paint; nothing for programs
    std::vector<bool> isProgram;  ///< by paint

    template <class Store>
    void draw(const View& view, const MaterialFunction& materials, const Store& store);
    template <class Store>
    void drawBand(const View& view, const MaterialFunction& materials, int band, Scratch& scratch,
                  const Store& store) const;
    /// The programs of a band, each by its own coverage, over rows of solid colours.
    void addPrograms(const View& view, const MaterialFunction& materials, int band, Scratch& scratch) const;

    std::unique_ptr<Scratch> takeScratch() {
        const std::lock_guard lock(mutex_);
        if (free_.empty())
            return std::make_unique<Scratch>();
        std::unique_ptr<Scratch> scratch = std::move(free_.back());
        free_.pop_back();
        return scratch;
    }
    void giveBack(std::unique_ptr<Scratch> scratch) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(scratch));
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Scratch>> free_;
};

template <class Store>
void Scanner::Impl::draw(const View& view, const MaterialFunction& materials, const Store& store) {
    validate(view);
    const double determinant = glm::determinant(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    if (drawn.empty() || !(std::abs(determinant) > std::numeric_limits<double>::min())) {
        for (int y = 0; y < view.height; ++y)
            store(y, 0, view.width, vec4(0));
        return;
    }
    // An exception loses the scratch, whose sums may be half done.
    std::unique_ptr<Scratch> scratch = takeScratch();
    scratch->chords.clear();
    for (const Drawn& d : drawn) {
        Chords chords(d.map, view, scratch->chords);
        for (const Boundary& boundary : d.boundaries)
            chords.add(boundary);
    }
    scratch->bands.sort(scratch->chords, view.height);
    scratch->colors.resize(view.width);
    for (int band = 0; band * bandRows < view.height; ++band)
        drawBand(view, materials, band, *scratch, store);
    giveBack(std::move(scratch));
}

template <class Store>
void Scanner::Impl::drawBand(const View& view, const MaterialFunction& materials, int band, Scratch& scratch,
                             const Store& store) const {
    const int top = band * bandRows, rows = std::min(bandRows, view.height - top);
    bool programs = false;
    for (const std::uint32_t i : scratch.bands.of(band)) {
        const Chord& c = scratch.chords[i];
        programs = programs || isProgram[c.left] || isProgram[c.right];
        scratch.colors.add(c, float(top), rows, solid[c.left] - solid[c.right]);
    }
    if (!programs) {
        for (int row = 0; row < rows; ++row)
            scratch.colors.resolve(std::size_t(row), [&](int first, int end, const vec4& color) {
                store(top + row, first, end, color);
            });
        return;
    }
    std::vector<vec4>& pixels = scratch.pixels;
    pixels.resize(std::size_t(bandRows) * std::size_t(view.width));
    for (int row = 0; row < rows; ++row)
        scratch.colors.resolve(std::size_t(row), [&](int first, int end, const vec4& color) {
            std::fill_n(pixels.begin() + row * view.width + first, end - first, color);
        });
    addPrograms(view, materials, band, scratch);
    for (int row = 0; row < rows; ++row)
        for (int x = 0; x < view.width; ++x)
            store(top + row, x, x + 1, pixels[std::size_t(row) * std::size_t(view.width) + std::size_t(x)]);
}

void Scanner::Impl::addPrograms(const View& view, const MaterialFunction& materials, int band,
                                Scratch& scratch) const {
    const int top = band * bandRows, rows = std::min(bandRows, view.height - top);
    const std::vector<Chord>& chords = scratch.chords;
    /// A chord and the change of coverage that it means to one program.
    struct Side {
        std::uint16_t paint;
        std::uint32_t chord;
        float change;
    };
    std::vector<Side> sides;
    for (const std::uint32_t i : scratch.bands.of(band)) {
        if (isProgram[chords[i].left])
            sides.push_back({chords[i].left, i, 1});
        if (isProgram[chords[i].right])
            sides.push_back({chords[i].right, i, -1});
    }
    std::ranges::stable_sort(sides, {}, &Side::paint);
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    Accumulator<float>& coverage = scratch.coverage;
    coverage.resize(view.width);
    for (std::size_t i = 0; i < sides.size();) {
        const std::uint16_t paint = sides[i].paint;
        for (; i < sides.size() && sides[i].paint == paint; ++i)
            coverage.add(chords[sides[i].chord], float(top), rows, sides[i].change);
        for (int row = 0; row < rows; ++row)
            coverage.resolve(std::size_t(row), [&](int first, int end, float share) {
                // Roundings of the running sum; a share that small is no 1/255 of a pixel.
                if (std::abs(share) < 1e-5f)
                    return;
                for (int x = first; x < end; ++x) {
                    const dvec2 point = inverse * (dvec2(x + 0.5, top + row + 0.5) - view.toPixels[2]);
                    scratch.pixels[std::size_t(row) * std::size_t(view.width) + std::size_t(x)] +=
                        share * paints->color(paint, {vec2(point), glm::mat2(inverse)}, materials);
                }
            });
    }
}

Scanner::Scanner(const AssetView& asset) : impl_(std::make_unique<Impl>()) {
    if (!isSumOfMaps(asset))
        throw std::invalid_argument("only pictures of disjoint regions can be summed along rows");
    for (const Command& command : asset.commands) {
        const std::vector<PlanarPiece> pieces = planarPieces(asset, asset.maps[command.map]);
        impl_->drawn.push_back({asset.maps[command.map], {pieces.begin(), pieces.end()}});
    }
    Asset& kept = impl_->asset;
    kept.paints.assign(asset.paints.begin(), asset.paints.end());
    kept.data.assign(asset.data.begin(), asset.data.end());
    kept.images.assign(asset.images.begin(), asset.images.end());
    kept.materials.assign(asset.materials.begin(), asset.materials.end());
    impl_->paints.emplace(kept);
    for (const Paint& paint : kept.paints) {
        impl_->isProgram.push_back(asset::isProgram(paint));
        impl_->solid.push_back(asset::isProgram(paint) ? vec4(0) : std::bit_cast<vec4>(paint));
    }
}

Scanner::~Scanner() = default;
Scanner::Scanner(Scanner&&) noexcept = default;
Scanner& Scanner::operator=(Scanner&&) noexcept = default;

void Scanner::draw(const View& view, const ByteTarget& target, const MaterialFunction& materials) const {
    impl_->draw(view, materials, ByteStore(target));
}

image::Raster Scanner::draw(const View& view, const MaterialFunction& materials) const {
    validate(view);
    image::Raster raster(view.width, view.height);
    impl_->draw(view, materials, RasterStore(raster));
    return raster;
}

}  // namespace vtm::asset
