#include "asset/scan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "asset/src/blend.hpp"
#include "asset/src/paint.hpp"
#include "asset/src/program_pixels.hpp"
#include "asset/src/row_sums.hpp"
#include "asset/src/scan_stores.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::vec2;
using glm::vec4;

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

/// What one picture needs and the next uses again.
struct Scratch {
    Bands bands;
    Accumulator<Float4> colors;
    Accumulator<float> coverage;
    ProgramPixels pixels;
    std::vector<std::vector<Side>> sides;  ///< by paint; those of programs in a band
    std::vector<std::uint16_t> programs;   ///< in a band
    std::vector<Share> shares;
    std::vector<Float4> run;  ///< colours of a program
};

/// What is kept of an asset.
struct Picture {
    struct Drawn {
        Map map;
        std::vector<Boundary> boundaries;
    };
    Asset asset;                   ///< without trees: paints and what they need
    std::optional<Paints> paints;  ///< of `asset`
    std::vector<Drawn> drawn;
    Sums sums = Sums::Encoded;
    std::vector<Float4> solid;            ///< by paint, as it is added; nothing for programs
    std::vector<std::uint8_t> isProgram;  ///< by paint

    vec4 added(vec4 color) const { return sums == Sums::Light ? light(color) : color; }
};

/// A picture under a view, band by band.
class Drawing {
public:
    Drawing(const Picture& of, const View& view, const MaterialFunction& materials, Scratch& scratch)
        : of_(of),
          view_(view),
          materials_(materials),
          scratch_(scratch),
          inverse_(glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]))) {
        scratch_.bands.clear(view.height);
        for (const Picture::Drawn& drawn : of.drawn) {
            Chords chords(drawn.map, view, scratch_.bands);
            for (const Boundary& boundary : drawn.boundaries)
                chords.add(boundary);
        }
        scratch_.colors.resize(view.width);
        scratch_.coverage.resize(view.width);
        scratch_.sides.resize(of.solid.size());
    }

    template <class Store>
    void drawBand(int band, const Store& store) {
        top_ = band * bandRows;
        rows_ = std::min(bandRows, view_.height - top_);
        scratch_.programs.clear();
        const std::uint8_t* isProgram = of_.isProgram.data();
        const Float4* solid = of_.solid.data();
        const auto top = float(top_);
        const int rows = rows_;
        for (const Chord& c : scratch_.bands.of(band)) {
            if (const unsigned programs = isProgram[c.left] + isProgram[c.right]; programs != 0) {
                addSides(c);
                if (programs == 2)
                    continue;
            }
            scratch_.colors.add(c, top, rows, solid[c.left] - solid[c.right]);
        }
        if (!scratch_.programs.empty())
            scratch_.pixels.resize(view_.width);
        for (const std::uint16_t paint : scratch_.programs)
            addProgram(paint);
        for (int row = 0; row < rows_; ++row)
            scratch_.colors.resolve(std::size_t(row), [&](int first, int end, Float4 color) {
                if (scratch_.programs.empty())
                    store(top_ + row, first, end, color);
                else
                    scratch_.pixels.finish(top_, row, first, end, color, store);
            });
    }

private:
    void addSides(const Chord& chord) {
        addSide(chord, chord.left, 1);
        addSide(chord, chord.right, -1);
    }
    void addSide(const Chord& chord, std::uint16_t paint, float change) {
        if (!of_.isProgram[paint])
            return;
        std::vector<Side>& sides = scratch_.sides[paint];
        if (sides.empty())
            scratch_.programs.push_back(paint);
        sides.push_back({&chord, change});
    }

    /// By its own coverage.
    void addProgram(std::uint16_t paint) {
        Accumulator<float>& coverage = scratch_.coverage;
        for (const Side& side : scratch_.sides[paint])
            coverage.add(*side.chord, float(top_), rows_, side.change);
        scratch_.sides[paint].clear();
        std::vector<Share>& shares = scratch_.shares;
        for (int row = 0; row < rows_; ++row) {
            int begin = 0;
            coverage.resolve(std::size_t(row), [&](int first, int end, float share) {
                if (std::abs(share) < leastShare)
                    return addShares(paint, row, begin);
                if (shares.empty())
                    begin = first;
                shares.push_back({end, share});
            });
            addShares(paint, row, begin);
        }
    }

    /// Of a program, in the pixels of a row from `first` on.
    void addShares(std::uint16_t paint, int row, int first) {
        if (scratch_.shares.empty())
            return;
        const int end = scratch_.shares.back().end;
        std::vector<Float4>& run = scratch_.run;
        run.resize(std::size_t(end - first));
        const dvec2 point = inverse_ * (dvec2(first + 0.5, top_ + row + 0.5) - view_.toPixels[2]);
        of_.paints->colors(paint, {vec2(point), glm::mat2(inverse_)}, vec2(inverse_[0]), run, materials_);
        if (of_.sums == Sums::Light)
            for (Float4& color : run)
                color = float4(light(toVec4(color)));
        Float4* pixels = scratch_.pixels.use(row, first, end);
        std::size_t i = 0;
        for (const auto& [shareEnd, share] : scratch_.shares)
            for (const auto last = std::size_t(shareEnd - first); i < last; ++i)
                pixels[i] += share * run[i];
        scratch_.shares.clear();
    }

    const Picture& of_;
    const View& view_;
    const MaterialFunction& materials_;
    Scratch& scratch_;
    glm::dmat2 inverse_;
    int top_ = 0, rows_ = 0;
};

}  // namespace

struct Scanner::Impl : Picture {
    template <class Store>
    void draw(const View& view, const MaterialFunction& materials, const Store& store);

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
            store(y, 0, view.width, Float4{});
        return;
    }
    // An exception loses the scratch, whose sums may be half done.
    std::unique_ptr<Scratch> scratch = takeScratch();
    Drawing drawing(*this, view, materials, *scratch);
    for (int band = 0; band * bandRows < view.height; ++band)
        drawing.drawBand(band, store);
    giveBack(std::move(scratch));
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
        impl_->solid.push_back(asset::isProgram(paint) ? Float4{}
                                                       : float4(impl_->added(std::bit_cast<vec4>(paint))));
    }
}

Scanner::~Scanner() = default;
Scanner::Scanner(Scanner&&) noexcept = default;
Scanner& Scanner::operator=(Scanner&&) noexcept = default;

void Scanner::draw(const View& view, const ByteTarget& target, const MaterialFunction& materials) const {
    impl_->draw(view, materials, ByteStore(target, view.width));
}

void Scanner::scan(const View& view, const std::function<void(int, const ColorRun&)>& take,
                   const MaterialFunction& materials) const {
    impl_->draw(view, materials, RunStore([&](int row, int first, int end, const vec4& color) {
                    take(row, {first, end, color});
                }));
}

image::Raster Scanner::draw(const View& view, const MaterialFunction& materials) const {
    validate(view);
    image::Raster raster(view.width, view.height);
    impl_->draw(view, materials, RunStore([&](int row, int first, int end, const vec4& color) {
                    for (int x = first; x < end; ++x)
                        for (int c = 0; c < 4; ++c)
                            raster.pixel(x, row)[c] = glm::clamp(color[c], 0.0f, 1.0f);
                }));
    return raster;
}

}  // namespace vtm::asset
