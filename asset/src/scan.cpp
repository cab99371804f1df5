#include "asset/scan.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "asset/src/blend.hpp"
#include "asset/src/paint.hpp"
#include "asset/src/row_sums.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::vec2;
using glm::vec4;

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
        std::vector<vec4> run;  ///< colours of a program
    };
    Asset asset;                   ///< without trees: paints and what they need
    std::optional<Paints> paints;  ///< of `asset`
    std::vector<Drawn> drawn;
    Sums sums = Sums::Encoded;
    std::vector<vec4> solid;      ///< by paint, as it is added; nothing for programs
    std::vector<bool> isProgram;  ///< by paint

    vec4 added(vec4 color) const { return sums == Sums::Light ? light(color) : color; }
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
                std::vector<vec4>& run = scratch.run;
                run.resize(std::size_t(end - first));
                const dvec2 point = inverse * (dvec2(first + 0.5, top + row + 0.5) - view.toPixels[2]);
                paints->colors(paint, {vec2(point), glm::mat2(inverse)}, vec2(inverse[0]), run, materials);
                vec4* pixels = scratch.pixels.data() + std::size_t(row) * std::size_t(view.width) + first;
                for (std::size_t x = 0; x < run.size(); ++x)
                    pixels[x] += share * added(run[x]);
            });
    }
}

Scanner::Scanner(const AssetView& asset, Sums sums) : impl_(std::make_unique<Impl>()) {
    impl_->sums = sums;
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
        impl_->solid.push_back(asset::isProgram(paint) ? vec4(0) : impl_->added(std::bit_cast<vec4>(paint)));
    }
}

Scanner::~Scanner() = default;
Scanner::Scanner(Scanner&&) noexcept = default;
Scanner& Scanner::operator=(Scanner&&) noexcept = default;

void Scanner::draw(const View& view, const ByteTarget& target, const MaterialFunction& materials) const {
    impl_->draw(view, materials, ByteStore(target));
}

void Scanner::scan(const View& view, const std::function<void(int, const ColorRun&)>& take,
                   const MaterialFunction& materials) const {
    impl_->draw(view, materials, [&](int row, int first, int end, const vec4& color) {
        take(row, {first, end, color});
    });
}

image::Raster Scanner::draw(const View& view, const MaterialFunction& materials) const {
    validate(view);
    image::Raster raster(view.width, view.height);
    impl_->draw(view, materials, RasterStore(raster));
    return raster;
}

}  // namespace vtm::asset
