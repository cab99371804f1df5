#include <vtm/raster/scan.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/instances.hpp"
#include "raster/chord_scanner.hpp"
#include "raster/src/blend.hpp"
#include "raster/src/draw_map.hpp"
#include "raster/src/map_scanner.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/rough.hpp"
#include "raster/src/row_sums.hpp"
#include "raster/src/scan_programs.hpp"
#include "raster/src/scan_stores.hpp"
#include "raster/src/scanned_map.hpp"
#include "raster/steepness.hpp"

namespace vtm::asset {

namespace {

using glm::vec4;

/// What one picture needs and the next uses again.
struct RowScratch {
    Bands bands;
    Accumulator<Wholes<Float4>> colors;
    BandPrograms programs;
    std::unique_ptr<RowScratch> finer;  ///< for what is drawn finer
};

/// The maps of an asset that are placed in others.
class PlacedMaps {
public:
    /// Must outlive it.
    explicit PlacedMaps(const AssetView& asset) : asset_(asset), walk_(asset), maps_(asset.maps.size()) {
        for (const Symbol& symbol : asset.symbols)
            if (!maps_[symbol.map])
                maps_[symbol.map].emplace(asset, asset.maps[symbol.map]);
    }

    /// Calls visit(map, its place, its paints), which tells whether to go on to those in it, for each map
    /// that is placed in one.
    template <class Visit>
    void forEach(std::uint32_t outer, Visit&& visit) const {
        const Map& map = asset_.maps[outer];
        walk_(map, [&](const PlacedMap& placed) {
            if (&placed.map == &map)
                return true;
            return bool(visit(*maps_[std::size_t(&placed.map - asset_.maps.data())], placed.toPicture,
                              placed.paints));
        });
    }

private:
    const AssetView asset_;
    const MapWalk walk_;
    std::vector<std::optional<ScannedMap>> maps_;
};

/// What is drawn.
struct Scanned {
    struct Drawn {
        ScannedMap own;
        std::uint32_t map = noMap;  ///< in which others are placed
    };
    static constexpr std::uint32_t noMap = 0xFFFFFFFFu;

    Scanned(const Paints& of, std::size_t paintCount, Sums sumsOf) : paints(of), sums(sumsOf) {
        setPaints(of, paintCount);
    }
    void setPaints(const Paints& of, std::size_t count) {
        paints = of;
        isProgram.clear();
        solid.clear();
        for (const Paint& paint : of.asset().paints.first(count)) {
            isProgram.push_back(asset::isProgram(paint));
            solid.push_back(asset::isProgram(paint) ? Float4{} : float4(added(std::bit_cast<vec4>(paint))));
        }
    }

    Paints paints;
    std::vector<Drawn> drawn;
    std::shared_ptr<const PlacedMaps> placed;  ///< null if nothing is
    Sums sums = Sums::Encoded;
    std::vector<Float4> solid;            ///< by paint, as it is added; nothing for programs
    std::vector<std::uint8_t> isProgram;  ///< by paint

    /// Of chords that somebody else makes.
    explicit Scanned(const ChordPaints& of) : paints(of.asset, of.images) {
        isProgram.resize(of.asset.paints.size(), 1);
        solid.resize(of.asset.paints.size());
        isProgram.resize(isProgram.size() + of.colors.size());
        for (const vec4& color : of.colors)
            solid.push_back(float4(color));
    }

    const AssetView& asset() const { return paints.asset(); }
    /// The boxes of boundaries, and for each map, after its own, all that is placed in it.
    std::size_t partCount() const {
        std::size_t count = 0;
        for (const Drawn& map : drawn)
            count += map.own.boxCount() + 1;
        return count;
    }
    std::size_t boundaryCount() const {
        std::size_t count = 0;
        for (const Drawn& map : drawn)
            count += map.own.boundaryCount();
        return count;
    }
    vec4 added(vec4 color) const { return sums == Sums::Light ? light(color) : color; }
};

/// Rough pixels in a row are drawn together across gaps of fewer columns.
constexpr int maxFinerGap = 4;

/// Pixels first to end - 1 of rows top to bottom - 1 of a band.
struct BandBox {
    int first, end, top, bottom;

    int width() const { return end - first; }
    int height() const { return bottom - top; }
};

/// Boxes around all of the pixels, which are sorted by column, disjoint and from left to right.
std::vector<BandBox> boxesAround(std::span<const BandPixel> pixels) {
    std::vector<BandBox> boxes;
    for (const BandPixel& p : pixels) {
        if (boxes.empty() || p.x >= boxes.back().end + maxFinerGap)
            boxes.push_back({p.x, p.x + 1, p.row, p.row + 1});
        BandBox& box = boxes.back();
        box = {box.first, p.x + 1, std::min(box.top, p.row), std::max(box.bottom, p.row + 1)};
    }
    return boxes;
}

/// Adds up colours that are finer: the mean over each pixel of a box.
class MeanStore {
public:
    explicit MeanStore(const BandBox& box)
        : box_(box), means_(std::size_t(box.width()) * std::size_t(box.height())) {}

    void operator()(int row, int first, int end, Float4 color) {
        while (first < end) {
            const int next = std::min(end, (first / finerSide + 1) * finerSide);
            mean(first / finerSide, row / finerSide) += float(next - first) * share * color;
            first = next;
        }
    }
    void operator()(int row, int first, std::span<const Float4> colors) {
        for (const Float4& color : colors)
            mean(first++ / finerSide, row / finerSide) += share * color;
    }
    /// In the band.
    Float4 at(const BandPixel& p) { return mean(p.x - box_.first, p.row - box_.top); }

private:
    static constexpr float share = 1.0f / (finerSide * finerSide);

    Float4& mean(int x, int y) { return means_[std::size_t(y) * std::size_t(box_.width()) + std::size_t(x)]; }

    BandBox box_;
    std::vector<Float4> means_;
};

/// The chords of a picture under a view, band by band.
class Drawing {
public:
    Drawing(const Scanned& of, const View& view, const MaterialFunction& materials, RowScratch& scratch,
            int finerLevels, float roughness = 1)
        : of_(of),
          view_(view),
          scratch_(scratch),
          programs_(programView(of, view_, materials, roughness, finerLevels > 0)),
          finerLevels_(finerLevels) {
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
            Chords<> chords(drawn.own.place(), view_, scratch_.bands);
            drawn.own.forEachOfSeen(
                chords.pixel(), [&](glm::dvec2 min, glm::dvec2 max) { return chords.mayShow(min, max); },
                [&](const Boundary& boundary) { chords.add(boundary); });
            if (drawn.map != Scanned::noMap)
                addPlaced(drawn.map);
        }
    }
    /// Some of the parts that make up the picture.
    void addParts(std::size_t first, std::size_t end) {
        std::size_t begin = 0;  // of the map's parts
        for (const Scanned::Drawn& drawn : of_.drawn) {
            const std::size_t count = drawn.own.boxCount();
            Chords<> chords(drawn.own.place(), view_, scratch_.bands);
            for (std::size_t i = std::max(first, begin); i < std::min(end, begin + count); ++i)
                addChords(chords, drawn.own.box(i - begin));
            begin += count + 1;
            if (drawn.map != Scanned::noMap && first < begin && begin <= end)
                addPlaced(drawn.map);
        }
    }
    void addChord(const Chord& chord) { scratch_.bands.add(chord, float(view_.width), float(view_.height)); }

    template <class Store>
    void draw(Store& store) {
        for (int band = 0; band * bandRows < view_.height; ++band)
            drawBand(band, store);
    }
    /// One band, of chords that were made for it.
    template <class Store>
    void draw(int band, std::vector<Chord>& chords, Store& store) {
        scratch_.bands.exchange(band, chords);
        drawBand(band, store);
        scratch_.bands.exchange(band, chords);
    }

private:
    template <class PaintOf>
    static void addChords(Chords<PaintOf>& chords, const BoundaryBox& box) {
        limits::check();
        if (chords.mayMatter(box.min(), box.max()))
            for (const Boundary& boundary : box.at(chords.pixel()))
                chords.add(boundary);
    }

    /// What lies beside the view changes no pixel.
    void addPlaced(std::uint32_t map) {
        of_.placed->forEach(
            map, [&](const ScannedMap& own, const Affine2& place, const PlacedPaints& paints) {
                if (!isSeen(place))
                    return false;
                const Affine2 toPicture{place.linear * (1 / own.place().extent), place.offset};
                Chords chords(toPicture, view_, scratch_.bands, std::cref(paints));
                for (std::size_t i = 0; i < own.boxCount(); ++i)
                addChords(chords, own.box(i));
                return true;
            });
    }

    bool isSeen(const Affine2& toPicture) const {
        const Affine2 toPixels =
            compose({glm::dmat2(view_.toPixels[0], view_.toPixels[1]), view_.toPixels[2]}, toPicture);
        const glm::dvec2 centre = toPixels(glm::dvec2(0.5));
        const glm::dvec2 reach = 0.5 * (glm::abs(toPixels.linear[0]) + glm::abs(toPixels.linear[1])) + 1.0;
        return centre.x + reach.x > 0 && centre.y + reach.y > 0 && centre.x - reach.x < view_.width &&
               centre.y - reach.y < view_.height;
    }

    template <class Store>
    void drawBand(int band, Store& store) {
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
        if (!programs.rough().empty())
            drawFiner(band);
        for (int row = 0; row < rows; ++row)
            scratch_.colors.resolve(std::size_t(row), [&](int first, int end, Float4 color) {
                if (programs.empty())
                    store(top + row, first, end, color);
                else
                    programs.pixels().finish(top, row, first, end, color, store);
            });
    }

    // ---- Rough pixels ----

    void drawFiner(int band) {
        std::vector<BandPixel>& rough = scratch_.programs.rough();
        std::ranges::sort(rough, {}, &BandPixel::x);
        std::vector<std::pair<BandPixel, Float4>> colors;
        auto next = rough.begin();
        for (const BandBox& box : boxesAround(rough)) {
            MeanStore means = drawBox(band, box);
            for (; next != rough.end() && next->x < box.end; ++next)
                colors.emplace_back(*next, means.at(*next));
        }
        std::ranges::sort(colors, {}, [](const auto& c) { return c.first; });
        const auto isSamePixel = [](const auto& a, const auto& b) { return a.first == b.first; };
        colors.erase(std::unique(colors.begin(), colors.end(), isSamePixel), colors.end());
        for (const auto& [pixel, color] : colors)
            scratch_.programs.pixels().replace(pixel.row, pixel.x, color);
    }

    /// Chords are within chordTolerance of a pixel of their curves here, and finer pixels need no finer ones.
    MeanStore drawBox(int band, const BandBox& box) {
        const glm::dvec2 corner(box.first, band * bandRows + box.top);
        View finer{box.width() * finerSide, box.height() * finerSide, view_.toPixels};
        finer.toPixels[2] -= corner;
        for (int i = 0; i < 3; ++i)
            finer.toPixels[i] *= double(finerSide);
        if (!scratch_.finer)
            scratch_.finer = std::make_unique<RowScratch>();
        Drawing drawing(of_, finer, programs_.materials, *scratch_.finer, finerLevels_ - 1,
                        finerTolerance * programs_.rough.times);
        for (const Chord& c : scratch_.bands.of(band))
            drawing.addChord({float(finerSide) * (c.a - glm::vec2(corner)),
                              float(finerSide) * (c.b - glm::vec2(corner)), c.left, c.right});
        MeanStore means(box);
        drawing.draw(means);
        return means;
    }

    static ProgramView programView(const Scanned& of, const View& view, const MaterialFunction& materials,
                                   float roughness, bool findsRough) {
        const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
        const float minSteep = minSteepness(inverse);
        return {of.paints, of.sums, view, inverse, minSteep, materials, roughBounds(minSteep, roughness),
                findsRough};
    }

    const Scanned& of_;
    const View view_;
    RowScratch& scratch_;
    ProgramView programs_;
    int finerLevels_;
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

int finerLevelsOf(const Scanned& of, const View& view) {
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

/// RowScratches that nobody uses.
class ScratchPool {
public:
    std::unique_ptr<RowScratch> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty())
            return std::make_unique<RowScratch>();
        std::unique_ptr<RowScratch> scratch = std::move(free_.back());
        free_.pop_back();
        return scratch;
    }
    void giveBack(std::unique_ptr<RowScratch> scratch) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(scratch));
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<RowScratch>> free_;
};

/// Draws one view on all processors. Each makes the chords of some of the picture's parts; then each draws
/// some bands, of chords in the order of the parts, so that the sums do not depend on who made which.
class ParallelDrawing {
public:
    ParallelDrawing(const Scanned& of, const View& view, ScratchPool& pool)
        : of_(of), view_(view), pool_(pool), finerLevels_(finerLevelsOf(of, view)) {}

    /// Whether it is worth it.
    static bool pays(const Scanned& of, const View& view) {
        constexpr std::size_t manyBoundaries = 1u << 12, manyPixels = 1u << 17;
        return tbb::this_task_arena::max_concurrency() > 1 &&
               (of.boundaryCount() >= manyBoundaries ||
                std::size_t(view.width) * std::size_t(view.height) >= manyPixels);
    }

    /// `store`: called by several threads at once.
    template <class Store>
    void draw(const Store& store) {
        const limits::Stage stage("scanning");
        const auto threads = std::size_t(tbb::this_task_arena::max_concurrency());
        makeChords(threads);
        const int bands = (view_.height + bandRows - 1) / bandRows;
        const int tasks = std::min(bands, int(4 * threads));
        tbb::parallel_for(0, tasks, [&, holding = limits::current()](int task) {
            const limits::Scope scope(holding);
            drawBands(bands * task / tasks, bands * (task + 1) / tasks, store);
        });
        // An exception loses the scratches, whose sums may be half done.
        for (std::unique_ptr<RowScratch>& scratch : made_)
            pool_.giveBack(std::move(scratch));
    }

private:
    void makeChords(std::size_t count) {
        const std::size_t parts = of_.partCount();
        made_.resize(std::min(count, parts));
        tbb::parallel_for(std::size_t{0}, made_.size(), [&, holding = limits::current()](std::size_t i) {
            const limits::Scope scope(holding);
            made_[i] = pool_.take();
            Drawing drawing(of_, view_, noMaterials_, *made_[i], finerLevels_);
            drawing.addParts(parts * i / made_.size(), parts * (i + 1) / made_.size());
        });
    }

    template <class Store>
    void drawBands(int first, int end, const Store& store) {
        std::unique_ptr<RowScratch> scratch = pool_.take();
        Drawing drawing(of_, view_, noMaterials_, *scratch, finerLevels_);
        for (int band = first; band < end; ++band)
            drawing.draw(band, joined(band), store);
        pool_.giveBack(std::move(scratch));
    }

    /// All chords of a band, in the first scratch that has some.
    std::vector<Chord>& joined(int band) const {
        std::vector<Chord>* all = nullptr;
        for (const std::unique_ptr<RowScratch>& made : made_) {
            std::vector<Chord>& some = made->bands.of(band);
            if (!all || all->empty())
                all = &some;
            else
                all->insert(all->end(), some.begin(), some.end());
        }
        return *all;
    }

    const Scanned& of_;
    const View& view_;
    ScratchPool& pool_;
    const MaterialFunction noMaterials_;
    const int finerLevels_;
    std::vector<std::unique_ptr<RowScratch>> made_;  ///< chords of the parts, in their order
};

/// What the paints of an asset need, but images and materials.
Asset recordsOf(const AssetView& from) {
    Asset kept;
    kept.paints.assign(from.paints.begin(), from.paints.end());
    kept.data.assign(from.data.begin(), from.data.end());
    kept.finestPixel = from.finestPixel;
    return kept;
}

/// What the paints of an asset need.
Asset paintsOf(const AssetView& from) {
    Asset kept = recordsOf(from);
    kept.images.assign(from.images.begin(), from.images.end());
    kept.materials.assign(from.materials.begin(), from.materials.end());
    return kept;
}

/// With maps that are placed in maps.
Asset paintsAndTreesOf(const AssetView& from) {
    Asset kept = paintsOf(from);
    kept.maps.assign(from.maps.begin(), from.maps.end());
    kept.nodes.assign(from.nodes.begin(), from.nodes.end());
    kept.leaves.assign(from.leaves.begin(), from.leaves.end());
    kept.pieces.assign(from.pieces.begin(), from.pieces.end());
    kept.instanceTrees.assign(from.instanceTrees.begin(), from.instanceTrees.end());
    kept.instances.assign(from.instances.begin(), from.instances.end());
    kept.symbols.assign(from.symbols.begin(), from.symbols.end());
    kept.palettes.assign(from.palettes.begin(), from.palettes.end());
    return kept;
}

/// What a box costs to draw beside its pixels, in pixels.
constexpr std::size_t pixelsOfABox = 1024;

/// Joins it with those with which it costs less.
void addBox(PixelBox box, std::vector<PixelBox>& boxes) {
    if (box.empty())
        return;
    for (std::size_t i = 0; i < boxes.size();) {
        const PixelBox both = box.joined(boxes[i]);
        if (both.area() <= box.area() + boxes[i].area() + pixelsOfABox) {
            box = both;
            boxes[i] = boxes.back();
            boxes.pop_back();
            i = 0;
        } else {
            ++i;
        }
    }
    boxes.push_back(box);
}

}  // namespace

struct Scanner::Impl {
    Impl(Asset&& ownedAsset, Sums sums)
        : owned(std::move(ownedAsset)), scanned(Paints(owned), owned.paints.size(), sums) {}

    Asset owned;
    Scanned scanned;

    /// From the top, in every row from the left.
    template <class Store>
    void draw(const View& view, const MaterialFunction& materials, const Store& store,
              Drawing::Of what = Drawing::Of::Picture) {
        // An exception loses the scratch, whose sums may be half done.
        std::unique_ptr<RowScratch> scratch = pool_.take();
        drawScanned(scanned, view, materials, *scratch, store, what);
        pool_.giveBack(std::move(scratch));
    }
    /// Several rows at once. Materials are the caller's functions, which may be made for one thread.
    template <class Store>
    void drawOnAll(const View& view, const MaterialFunction& materials, const Store& store) {
        if (materials || !ParallelDrawing::pays(scanned, view))
            draw(view, materials, store);
        else if (!drawIfEmpty(scanned, view, store))
            ParallelDrawing(scanned, view, pool_).draw(store);
    }

    void updatePaints(const AssetView& asset, bool imagesToo) {
        std::shared_ptr<const Images> images = scanned.paints.sharedImages();
        Asset next = imagesToo ? paintsOf(asset) : recordsOf(asset);
        if (!imagesToo) {
            next.images = std::move(owned.images);
            next.materials = std::move(owned.materials);
        }
        owned = std::move(next);
        scanned.setPaints(imagesToo ? Paints(owned) : Paints(owned, std::move(images)), owned.paints.size());
    }

private:
    ScratchPool pool_;
};

Scanner::Scanner(const AssetView& asset, Sums sums)
    : impl_(
          std::make_unique<Impl>(asset.instances.empty() ? paintsOf(asset) : paintsAndTreesOf(asset), sums)) {
    requireSumOfMaps(asset);
    for (const Command& command : asset.commands)
        impl_->scanned.drawn.push_back({ScannedMap(asset, asset.maps[command.map]),
                                        asset.instances.empty() ? Scanned::noMap : command.map});
    if (!asset.instances.empty())
        impl_->scanned.placed = std::make_shared<const PlacedMaps>(impl_->owned);
}

Scanner::Scanner(std::span<const PlanarMap> maps, const AssetView& asset, Sums sums)
    : impl_(std::make_unique<Impl>(paintsOf(asset), sums)) {
    for (const PlanarMap& map : maps)
        impl_->scanned.drawn.push_back({ScannedMap(map)});
}

Scanner::~Scanner() = default;
Scanner::Scanner(Scanner&&) noexcept = default;
Scanner& Scanner::operator=(Scanner&&) noexcept = default;

void Scanner::update(const AssetView& asset, const Difference& difference) {
    const Sums sums = impl_->scanned.sums;
    if (difference.everything) {
        *this = Scanner(asset, sums);
        return;
    }
    if (asset.maps.size() != 1 || !asset.instances.empty() || impl_->scanned.drawn.size() != 1)
        throw std::invalid_argument("a scanner is brought to an asset of one map without instances alone");
    if (difference.paints || difference.images)
        impl_->updatePaints(asset, difference.images);
    impl_->owned.finestPixel = asset.finestPixel;
    if (!difference.squares.empty())
        impl_->scanned.drawn[0].own.update(asset, asset.maps[0], difference.squares);
}

std::optional<double> Scanner::finestPixel() const { return impl_->owned.finestPixel; }

void Scanner::draw(const View& view, const ByteTarget& target, const MaterialFunction& materials) const {
    impl_->drawOnAll(view, materials, ByteStore(target, view.width));
}

void Scanner::drawBox(const View& view, const PixelBox& box, const ByteTarget& target,
                      const MaterialFunction& materials) const {
    validate(view);
    const PixelBox seen = box.intersection({{0, 0}, {view.width, view.height}});
    if (seen.empty())
        return;
    const ByteTarget there{
        target.pixels + std::size_t(seen.min.y) * target.rowBytes + std::size_t(seen.min.x) * 4,
        target.rowBytes};
    impl_->draw(crop(view, seen), materials, ByteStore(there, seen.width()), Drawing::Of::SeenSquares);
}

std::vector<PixelBox> changedPixels(const View& view, const Difference& difference) {
    std::vector<PixelBox> boxes;
    for (const Area& area : difference.areas) {
        const glm::dvec2 corner(area.left, area.top), size(area.right - area.left, area.bottom - area.top);
        addBox(pixelsOf(view, {glm::dmat2(size.x, 0, 0, size.y), corner}), boxes);
    }
    return boxes;
}

void Scanner::add(const View& view, const PixelsToAddTo& pixels, const MaterialFunction& materials) const {
    impl_->draw(view, materials, AddStore(pixels));
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
    impl_->drawOnAll(view, materials, RunStore([&](int row, int first, int end, const vec4& color) {
                    for (int x = first; x < end; ++x)
                        for (int c = 0; c < 4; ++c)
                            raster.pixel(x, row)[c] = unit(color[c]);
                }));
    return raster;
}

struct MapScanner::Impl {
    const Paints& paints;
    std::shared_ptr<const PlacedMaps> placed = nullptr;
    RowScratch scratch;
};

MapScanner::MapScanner(const Paints& paints) : impl_(new Impl{.paints = paints, .scratch = {}}) {}
MapScanner::~MapScanner() = default;

void MapScanner::add(std::uint32_t index, std::uint32_t firstPaint, std::size_t paintCount, const View& view,
                     const PixelsToAddTo& pixels, const MaterialFunction& materials) {
    const AssetView& asset = impl_->paints.asset();
    const Map& map = asset.maps[index];
    Scanned scanned(impl_->paints.from(firstPaint), paintCount, Sums::Encoded);
    scanned.drawn.push_back({ScannedMap(asset, map)});
    if (map.instances != 0) {
        if (!impl_->placed)
            impl_->placed = std::make_shared<const PlacedMaps>(asset);
        scanned.drawn.back().map = index;
        scanned.placed = impl_->placed;
    }
    drawScanned(scanned, view, materials, impl_->scratch, AddStore(pixels));
}

std::shared_ptr<const Images> imagesOf(const AssetView& asset) {
    return std::make_shared<const Images>(asset);
}

struct ChordScanner::Impl {
    View view;
    RowScratch scratch;

    template <class Store>
    void draw(int first, std::span<std::vector<Chord>> bands, const ChordPaints& paints, Store store) {
        const Scanned scanned(paints);
        const MaterialFunction noMaterials;
        Drawing drawing(scanned, view, noMaterials, scratch, finerLevels(paints.asset, view));
        for (std::vector<Chord>& chords : bands)
            drawing.draw(first++, chords, store);
    }
};

ChordScanner::ChordScanner(const View& view) : impl_(new Impl{.view = view, .scratch = {}}) {
    validate(view);
}
ChordScanner::~ChordScanner() = default;

void ChordScanner::draw(int first, std::span<std::vector<Chord>> bands, const ChordPaints& paints,
                        const ByteTarget& target) {
    impl_->draw(first, bands, paints, ByteStore(target, impl_->view.width));
}

void ChordScanner::scan(int first, std::span<std::vector<Chord>> bands, const ChordPaints& paints,
                        const std::function<void(int, const ColorRun&)>& take) {
    impl_->draw(first, bands, paints, RunStore([&](int row, int from, int end, const vec4& color) {
                    take(row, {from, end, color});
                }));
}

}  // namespace vtm::asset
