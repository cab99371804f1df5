#include "compiler/session/editor.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "compiler/compile/settings.hpp"
#include "compiler/lower/lower.hpp"
#include "compiler/paint/painters.hpp"
#include "compiler/tree/encode.hpp"
#include "compiler/tree/partition.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {
namespace {

/// A block has this part of the picture's clipped runs, but at least so many.
constexpr std::size_t blockShare = 256, minBlock = 16;

std::size_t runsPerBlock(std::size_t runs) { return std::max(minBlock, runs / blockShare); }

/// Culls and builds blocks, one after the other.
class Worker {
public:
    Worker(const LoweredScene& picture, const Painter& painter, const TreeOptions& options, WorkLimit& work)
        : painter_(painter.clone()), culler_(picture, *painter_), builder_(picture, painter, options, work) {}

    Tree run(Cell cell) {
        culler_.run(cell);
        return builder_.run(std::move(cell), true);
    }
    const TreeTimes& times() const { return builder_.times(); }

private:
    const std::unique_ptr<Painter> painter_;
    Culler culler_;
    BlockBuilder builder_;
};

/// A part of the picture, as a set of squares that blocks may have.
class BlockArea {
public:
    void add(asset::Cell square) {
        const unsigned shift = 2 * (maxBlockLevel - square.level), side = 1u << shift;
        const std::uint64_t columns = columnsOf(square.x << shift, side);
        for (unsigned y = square.y << shift; y < (square.y << shift) + side; ++y)
            rows_[y] |= columns;
    }

    /// Boxes that cover it exactly, for a picture whose longer side is `length`.
    std::vector<asset::Area> boxes(double length) {
        std::vector<asset::Area> boxes;
        const double unit = length / perSide;
        for (unsigned y = 0; y < perSide; ++y)
            while (rows_[y] != 0) {
                const auto first = unsigned(std::countr_zero(rows_[y])),
                           count = unsigned(std::countr_one(rows_[y] >> first));
                const std::uint64_t columns = columnsOf(first, count);
                unsigned end = y;
                for (; end < perSide && (rows_[end] & columns) == columns; ++end)
                    rows_[end] &= ~columns;
                boxes.push_back({unit * first, unit * y, unit * (first + count), unit * end});
            }
        return boxes;
    }

private:
    static constexpr unsigned perSide = 1u << (2 * maxBlockLevel);
    static_assert(perSide == 64);

    static std::uint64_t columnsOf(unsigned first, unsigned count) {
        return (count == perSide ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1) << first;
    }

    std::array<std::uint64_t, perSide> rows_{};  ///< a bit for each square of the last level
};

class Editor {
public:
    Editor(Kept& kept, Result& result, const Options& options)
        : kept_(kept), result_(result), options_(options), treeOptions_(treeOptions(options)) {}

    std::optional<Edited> run(const scene::Scene& scene) {
        const auto start = Clock::now();
        kept_.cache.put(std::move(kept_.picture.outlines));
        picture_ =
            lower(scene, kept_.excerpt, kept_.lattice, treeOptions_.budget, Sharing::None, &kept_.cache);
        const auto lowered = Clock::now();
        Update update;
        update.anew = !kept_.partition;
        update.outlines = kept_.cache.added();
        if (picture_.lacksImages || (!update.anew && 2 * update.outlines > kept_.cache.used()))
            return std::nullopt;
        compare();
        if (update.anew)
            kept_.partition.emplace(kept_.lattice.square(), runsPerBlock(kept_.cache.usedRuns()),
                                    treeOptions_.maxDepth);
        if (update.anew || geometryChanged_)
            update.blocks = build();
        update.blocksInAll = kept_.partition->blocks().size();
        update.paints = kept_.paints.update(picture_, kept_.names, repainted_);
        difference_.everything = update.anew;
        if (update.anew)
            difference_.areas = {{0, 0, kept_.excerpt.width, kept_.excerpt.height}};
        else
            findAreas();
        encode(update, start, lowered);
        kept_.picture = std::move(picture_);
        return Edited{update, std::move(difference_)};
    }

private:
    double longerSide() const { return std::max(kept_.excerpt.width, kept_.excerpt.height); }

    /// Finds what differs from the last picture.
    void compare() {
        changes_ = matchLayers(kept_.picture, picture_);
        kept_.names.update(picture_, changes_);
        const std::vector<std::uint32_t>& names = kept_.names.names();
        std::vector<LayerMeaning> now = meanings(picture_, names);
        repainted_.assign(kept_.names.layers().size(), false);
        geometryChanged_ =
            std::find(changes_.after.begin(), changes_.after.end(), noIndex) != changes_.after.end();
        for (std::uint32_t layer = 0; layer < now.size(); ++layer) {
            const std::uint32_t before = changes_.before[layer];
            if (before == noIndex || now[layer].paint != kept_.meanings[before].paint)
                repainted_[names[layer]] = true;
            if (before == noIndex)
                geometryChanged_ = true;
            else if (now[layer].shape != kept_.meanings[before].shape)
                touched_.push_back(layer);
        }
        geometryChanged_ |= !touched_.empty();
        kept_.meanings = std::move(now);
    }

    /// Builds the blocks that are not what they were; returns their number.
    std::size_t build() {
        EditablePainter painter(picture_, kept_.names.names());
        kept_.partition->update(kept_.picture.layers, picture_, changes_, touched_, painter);
        std::vector<Partition::Block*> dirty;
        for (Partition::Block& block : kept_.partition->blocks())
            if (block.dirty)
                dirty.push_back(&block);

        WorkLimit work(treeOptions_.maxWork);
        std::vector<Tree> trees(dirty.size());
        tbb::enumerable_thread_specific<Worker> workers(
            [&] { return Worker(picture_, painter, treeOptions_, work); });
        const auto start = Clock::now();
        tbb::parallel_for(std::size_t{0}, dirty.size(), [&, holding = limits::current()](std::size_t i) {
            const limits::Scope scope(holding);
            trees[i] = workers.local().run(dirty[i]->cell);
        });
        const double wall = milliseconds(start, Clock::now());
        TreeTimes sum;
        for (const Worker& worker : workers)
            sum += worker.times();
        times_ += sum.sharing(wall);
        for (std::size_t i = 0; i < dirty.size(); ++i) {
            replace(*dirty[i], std::move(trees[i]));
            difference_.squares.push_back(squareOf(*dirty[i]));
        }
        return dirty.size();
    }

    asset::Cell squareOf(const Partition::Block& block) const {
        const Square &root = kept_.lattice.square(), &square = block.cell.square;
        return {std::uint32_t((square.x0 - root.x0) / square.side),
                std::uint32_t((square.y0 - root.y0) / square.side), block.cell.level};
    }

    /// Blocks that were built, or show a stack whose paint changed.
    void findAreas() {
        BlockArea area;
        for (const asset::Cell& square : difference_.squares)
            area.add(square);
        if (const std::vector<std::uint8_t> changed = kept_.paints.changed(); !changed.empty())
            for (const Partition::Block& block : kept_.partition->blocks())
                if (std::ranges::any_of(block.paints, [&](PaintId id) { return changed[id] != 0; }))
                    area.add(squareOf(block));
        difference_.areas = area.boxes(longerSide());
    }

    /// Gives the block a tree whose paints are places in its own table of stacks.
    void replace(Partition::Block& block, Tree tree) {
        const StackTable stacks = std::move(tree.palette.stacks);
        const std::vector<PaintId> before = std::move(block.paints);
        block.paints.clear();
        std::vector<PaintId> places(stacks.size(), noIndex);
        const auto place = [&](PaintId local) {
            if (places[local] == noIndex)
                block.paints.push_back(places[local] = kept_.paints.use(stacks[local]));
            return places[local];
        };
        const auto entry = [&](asset::Entry& e) {
            if (e.kind() == asset::Entry::Kind::Solid)
                e = asset::Entry::make(e.kind(), place(e.payload()));
        };
        entry(tree.root);
        for (asset::Node& node : tree.nodes)
            std::for_each(node.children.begin(), node.children.end(), entry);
        for (Tree::Leaf& leaf : tree.leaves)
            for (PaintId& corner : leaf.corners)
                corner = place(corner);
        for (Tree::Piece& piece : tree.pieces)
            piece.left = place(piece.left), piece.right = place(piece.right);
        tree.nodes.shrink_to_fit();
        tree.leaves.shrink_to_fit();
        tree.pieces.shrink_to_fit();
        block.tree = std::move(tree);
        block.dirty = false;
        block.place.reset();
        for (PaintId id : before)  // last, so that what stays in use keeps its place
            kept_.paints.release(id);
    }

    /// The next asset, made of what changed; the rest is moved in from the last one when nothing can fail any
    /// more.
    void encode(const Update& update, Clock::time_point start, Clock::time_point lowered) {
        asset::Asset& last = result_.asset;
        asset::Asset next;
        next.width = kept_.excerpt.width;
        next.height = kept_.excerpt.height;
        next.mode = options_.mode;
        const bool moved = kept_.paints.encode(picture_, update.anew || picture_.data != kept_.picture.data,
                                               last, next, colourError_);
        const bool isJoined = update.blocks > 0 || moved;
        difference_.everything |= moved;  // all paints may have other numbers
        difference_.paints = update.paints > 0 || update.blocks > 0;
        const asset::Entry root =
            isJoined ? joinBlocks(*kept_.partition, kept_.paints.indices(), moved ? nullptr : &last, next)
                     : last.maps[0].root;
        next.maps = {{0, 0, longerSide(), root}};
        if (isJoined)
            checkDrawn(next.maps.size(), next.nodes.size(), next.pieces.size());
        next.commands = {asset::Command{}};
        next.materials = picture_.materials;
        const bool newImages = update.anew || picture_.images != kept_.picture.images;
        difference_.images = newImages || picture_.materials != kept_.picture.materials;
        if (newImages)
            next.images = bitmapsOf(picture_);
        if (!isJoined)
            next.fallbackLeaves = last.fallbackLeaves;
        Result report;
        report.asset.width = kept_.excerpt.width;
        report.asset.height = kept_.excerpt.height;
        report.sampledStrokes = picture_.sampledStrokes;
        for (const Partition::Block& block : kept_.partition->blocks())
            certify(block.tree, treeOptions_.budget, report);
        next.finestPixel = finestPixel(report);
        report.warnings = warningsOf(report, options_, colourError_);
        report.warnings.insert(report.warnings.end(), picture_.warnings.begin(), picture_.warnings.end());
        report.stages = stageTimes(milliseconds(start, lowered), milliseconds(lowered, Clock::now()), times_);

        if (!newImages)
            next.images.swap(last.images);
        if (!isJoined) {
            next.nodes.swap(last.nodes);
            next.leaves.swap(last.leaves);
            next.pieces.swap(last.pieces);
        }
        report.asset = std::move(next);
        result_ = std::move(report);
    }

    Kept& kept_;
    Result& result_;
    const Options& options_;
    const TreeOptions treeOptions_;
    LoweredScene picture_;
    LayerChanges changes_;
    std::vector<std::uint32_t> touched_;   ///< layers that stayed, but whose items show elsewhere
    std::vector<std::uint8_t> repainted_;  ///< by name
    bool geometryChanged_ = false;
    asset::Difference difference_;
    TreeTimes times_;
    float colourError_ = 0;
};

}  // namespace

Kept::Kept(const Excerpt& of, const Options& options)
    : excerpt(of), lattice(of.width, of.height, latticeBits(options)) {}

bool Kept::isWorn() const {
    constexpr std::size_t factor = 4;  // seldom enough to be paid for by the edits in between
    const std::size_t wanted = runsPerBlock(cache.usedRuns()), maximum = partition->maximum();
    return wanted > factor * maximum || maximum > factor * wanted || cache.isWorn(picture.outlines);
}

std::optional<Edited> edit(Kept& kept, Result& result, const scene::Scene& scene, const Options& options) {
    return Editor(kept, result, options).run(scene);
}

}  // namespace vtm::compiler
