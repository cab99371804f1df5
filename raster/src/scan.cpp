#include <vtm/raster/scan.hpp>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/vec4.hpp>

#include "raster/chord_scanner.hpp"
#include "raster/src/draw_map.hpp"
#include "raster/src/drawing.hpp"
#include "raster/src/map_scanner.hpp"
#include "raster/src/parallel_drawing.hpp"
#include "raster/src/scan_stores.hpp"

namespace vtm::asset {

namespace {

using glm::vec4;

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
    const auto placed = asset.instances.empty() ? nullptr : std::make_shared<const PlacedMaps>(impl_->owned);
    for (const Command& command : asset.commands) {
        impl_->scanned.drawn.push_back({ScannedMap(asset, asset.maps[command.map])});
        if (placed)
            impl_->scanned.place(placed, command.map);
    }
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
    impl_->draw(crop(view, seen), materials, ByteStore(partOf(target, seen), seen.width()),
                Drawing::Of::SeenSquares);
}

std::vector<PixelBox> changedPixels(const View& view, const Difference& difference) {
    std::vector<PixelBox> boxes;
    for (const Area& area : difference.areas) {
        const glm::dvec2 corner(area.left, area.top), size(area.right - area.left, area.bottom - area.top);
        const PixelBox box = pixelsOf(view, {glm::dmat2(size.x, 0, 0, size.y), corner});
        addBox(
            box.grown(glm::ivec2(difference.pixelsAround)).intersection({{0, 0}, {view.width, view.height}}),
            boxes);
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
    explicit Impl(const Paints& of) : paints(of), maps(of.asset().commands.size()) {
        for (std::size_t i = 0; i < maps.size(); ++i)
            if (const Command& command = of.asset().commands[i]; command.kind == Command::Kind::DrawMap) {
                firstPaints.insert(command.paint);
                maps[i].map = command.map;
            }
    }
    Impl(const Paints& of, Impl&& last, std::span<const MapChange> changes) : Impl(of) {
        if (last.placed)
            std::call_once(arePlacedMade, [&] {
                placed = std::make_shared<PlacedMaps>(paints.asset(), std::move(*last.placed), changes);
            });
        std::map<std::uint32_t, Kept*> before;
        for (Kept& kept : last.maps)
            if (kept.scanned)
                before[kept.map] = &kept;
        for (std::size_t i = 0; i < maps.size(); ++i)
            if (maps[i].map < changes.size())
                if (const auto same = before.find(changes[maps[i].map].before); same != before.end()) {
                    takeOver(std::move(*same->second->scanned), changes[maps[i].map].squares, i);
                    before.erase(same);
                }
    }

    template <class Store>
    void draw(const Command& command, const View& view, const MaterialFunction& materials,
              const Store& store) {
        const Scanned& scanned = scannedOf(command);
        if (!materials && ParallelDrawing::pays(scanned, view)) {
            if (!drawIfEmpty(scanned, view, store))
                ParallelDrawing(scanned, view, pool).draw(store);
            return;
        }
        // An exception loses the scratch, whose sums may be half done.
        std::unique_ptr<RowScratch> scratch = pool.take();
        drawScanned(scanned, view, materials, *scratch, store);
        pool.giveBack(std::move(scratch));
    }

private:
    static constexpr std::uint32_t noMap = 0xFFFFFFFF;
    struct Kept {
        std::uint32_t map = noMap;  ///< that the command draws
        std::once_flag isMade;
        std::optional<Scanned> scanned;
    };

    /// Of a command.
    const Scanned& scannedOf(const Command& command) {
        Kept& kept = maps[std::size_t(&command - paints.asset().commands.data())];
        std::call_once(kept.isMade, [&] {
            if (!kept.scanned)
                make(command, kept.scanned);
        });
        return *kept.scanned;
    }
    void make(const Command& command, std::optional<Scanned>& scanned) {
        const AssetView& asset = paints.asset();
        scanned.emplace(paints.from(command.paint), paintCount(command.paint), Sums::Encoded);
        scanned->drawn.push_back({ScannedMap(asset, asset.maps[command.map])});
        place(command.map, *scanned);
    }
    void takeOver(Scanned&& scanned, std::span<const Cell> changed, std::size_t command) {
        const AssetView& asset = paints.asset();
        const auto [map, firstPaint] = std::pair(maps[command].map, asset.commands[command].paint);
        scanned.setPaints(paints.from(firstPaint), paintCount(firstPaint));
        if (!changed.empty())
            scanned.drawn[0].own.update(asset, asset.maps[map], changed);
        place(map, scanned);
        maps[command].scanned = std::move(scanned);
    }
    /// In a map those that are placed in it.
    void place(std::uint32_t map, Scanned& scanned) {
        const AssetView& asset = paints.asset();
        if (asset.maps[map].instances == 0)
            return;
        std::call_once(arePlacedMade, [&] { placed = std::make_shared<PlacedMaps>(asset); });
        scanned.place(placed, map);
    }
    std::size_t paintCount(std::uint32_t first) const {
        const auto next = firstPaints.upper_bound(first);  // where those of the next map begin
        return (next == firstPaints.end() ? paints.asset().paints.size() : *next) - first;
    }

    ScratchPool pool;
    const Paints paints;
    std::set<std::uint32_t> firstPaints;  ///< of the maps that are drawn
    std::vector<Kept> maps;               ///< by command
    std::once_flag arePlacedMade;
    std::shared_ptr<PlacedMaps> placed;
};

MapScanner::MapScanner(const Paints& paints) : impl_(std::make_unique<Impl>(paints)) {}
MapScanner::MapScanner(const Paints& paints, MapScanner&& last, std::span<const MapChange> changes)
    : impl_(std::make_unique<Impl>(paints, std::move(*last.impl_), changes)) {}
MapScanner::~MapScanner() = default;
MapScanner::MapScanner(MapScanner&&) noexcept = default;
MapScanner& MapScanner::operator=(MapScanner&&) noexcept = default;

void MapScanner::add(const Command& command, const View& view, const PixelsToAddTo& pixels,
                     const MaterialFunction& materials) const {
    impl_->draw(command, view, materials, AddStore(pixels));
}

void MapScanner::layOver(const Command& command, float opacity, const View& view, const PixelsToAddTo& pixels,
                         const MaterialFunction& materials) const {
    impl_->draw(command, view, materials, OverStore(pixels, opacity));
}

std::shared_ptr<const Images> imagesOf(const AssetView& asset) {
    return std::make_shared<const Images>(asset);
}

struct ChordScanner::Impl {
    View view;
    RowScratch scratch;

    template <class Store>
    void draw(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints, Store store) {
        const Scanned scanned(paints);
        const MaterialFunction noMaterials;
        Drawing drawing(scanned, view, noMaterials, scratch, finerLevels(paints.asset, view));
        for (const std::vector<Chord>& chords : bands)
            drawing.draw(first++, std::array{std::span(chords)}, store);
    }
};

ChordScanner::ChordScanner(const View& view) : impl_(new Impl{.view = view, .scratch = {}}) {
    validate(view);
}
ChordScanner::~ChordScanner() = default;

void ChordScanner::draw(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
                        const ByteTarget& target) {
    impl_->draw(first, bands, paints, ByteStore(target, impl_->view.width));
}

void ChordScanner::scan(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
                        const std::function<void(int, const ColorRun&)>& take) {
    impl_->draw(first, bands, paints, RunStore([&](int row, int from, int end, const vec4& color) {
                    take(row, {from, end, color});
                }));
}

void ChordScanner::add(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
                       const PixelsToAddTo& pixels) {
    impl_->draw(first, bands, paints, AddStore(pixels));
}

void ChordScanner::layOver(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
                           float opacity, const PixelsToAddTo& pixels) {
    impl_->draw(first, bands, paints, OverStore(pixels, opacity));
}

}  // namespace vtm::asset
