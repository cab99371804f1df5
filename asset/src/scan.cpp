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
#include "asset/src/row_sums.hpp"
#include "asset/src/scan_programs.hpp"
#include "asset/src/scan_stores.hpp"
#include "asset/steepness.hpp"
#include "limits/limits.hpp"

namespace vtm::asset {

namespace {

using glm::vec4;

/// What one picture needs and the next uses again.
struct Scratch {
    Bands bands;
    Accumulator<Wholes<Float4>> colors;
    BandPrograms programs;
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
        : of_(of), view_(view), scratch_(scratch), programs_(programView(of, view, materials)) {
        scratch_.bands.clear(view.height);
        for (const Picture::Drawn& drawn : of.drawn) {
            Chords chords(drawn.map, view, scratch_.bands);
            for (const Boundary& boundary : drawn.boundaries) {
                limits::check();
                chords.add(boundary);
            }
        }
        scratch_.colors.resize(view.width);
        scratch_.programs.resize(of.solid.size(), view.width);
    }

    template <class Store>
    void drawBand(int band, const Store& store) {
        limits::check();
        const int top = band * bandRows, rows = std::min(bandRows, view_.height - top);
        BandPrograms& programs = scratch_.programs;
        programs.clear();
        const std::uint8_t* isProgram = of_.isProgram.data();
        const Float4* solid = of_.solid.data();
        for (const Chord& c : scratch_.bands.of(band)) {
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
        programs.draw(programs_, top, rows);
        for (int row = 0; row < rows; ++row)
            scratch_.colors.resolve(std::size_t(row), [&](int first, int end, Float4 color) {
                if (programs.empty())
                    store(top + row, first, end, color);
                else
                    programs.pixels().finish(top, row, first, end, color, store);
            });
    }

private:
    static ProgramView programView(const Picture& of, const View& view, const MaterialFunction& materials) {
        const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
        return {*of.paints, of.sums, view, inverse, leastSteepness(inverse), materials};
    }

    const Picture& of_;
    const View& view_;
    Scratch& scratch_;
    ProgramView programs_;
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
    const limits::Stage stage("scanning");
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
