#include "paper/compile/mask.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <vtm/compiler/stroke.hpp>
#include "compiler/lower/outline.hpp"
#include "compiler/tree/encode.hpp"
#include "paper/compile/cell.hpp"
#include "paper/compile/mip.hpp"

namespace vtm::paper {

namespace {

using asset::Entry;

/// Where in a cell the winding number is known: off every simple fraction, so that borders of drawings
/// do not run through it.
constexpr Point referenceInCell{0.4871, 0.5137};

/// The 16-tree over the outline.
class TreeBuilder {
public:
    TreeBuilder(const Outline& outline, double tolerance, unsigned maxDepth, MaskResult& result)
        : outline_(outline), tolerance_(tolerance), maxDepth_(maxDepth), result_(result) {}

    Entry build() {
        CellTask root;
        root.chords.resize(outline_.chords.size());
        std::iota(root.chords.begin(), root.chords.end(), 0u);
        keepSeen(root);
        root.reference = referenceInCell;
        root.winding = windingAt(outline_, root.reference);
        return build(root, 0);
    }

private:
    Entry build(const CellTask& task, unsigned depth) {
        const CellDecision decision = decide(outline_, task, tolerance_, depth == maxDepth_);
        result_.approximated += decision.approximated ? 1 : 0;
        switch (decision.kind) {
            case CellDecision::Kind::Solid:
                return Entry::make(Entry::Kind::Solid, decision.inside ? 1 : 0);
            case CellDecision::Kind::Cell:
                return addCell(decision.cell);
            default:
                return split(task, depth);
        }
    }

    Entry addCell(const Cell& cell) {
        if (result_.mask.cells.size() >= maxCells)
            throw compiler::LimitError("a mask needs more than " + std::to_string(maxCells) + " cells");
        result_.mask.cells.push_back(cell);
        return Entry::make(Entry::Kind::Leaf, std::uint32_t(result_.mask.cells.size() - 1));
    }

    Entry split(const CellTask& task, unsigned depth) {
        return compiler::appendNode(result_.mask.nodes, [&](std::size_t i) {
            return build(child(task, unsigned(i % 4), unsigned(i / 4)), depth + 1);
        });
    }

    CellTask child(const CellTask& parent, unsigned x, unsigned y) const {
        CellTask task;
        task.side = parent.side / 4;
        task.corner = parent.corner + task.side * Point(x, y);
        task.reference = task.corner + task.side * referenceInCell;
        task.winding =
            parent.winding + windingChange(outline_, parent.chords, parent.reference, task.reference);
        task.chords = parent.chords;
        keepSeen(task);
        return task;
    }

    void keepSeen(CellTask& task) const {
        const CellFrame frame(task);
        std::erase_if(task.chords, [&](std::uint32_t i) { return clip(outline_.chords[i], frame).empty(); });
    }

    const Outline& outline_;
    const double tolerance_;
    const unsigned maxDepth_;
    MaskResult& result_;
};

/// Whether all of the picture is inside, up to `margin`, of the mask's side, at its border.
bool covers(const Outline& outline, const Placement& placement, Point pictureSize, double margin) {
    const Point min = -placement.min / placement.side + margin,
                max = (pictureSize - placement.min) / placement.side - margin;
    return std::ranges::none_of(outline.chords, [&](const Chord& c) { return !clip(c, min, max).empty(); }) &&
           outline.isInside(windingAt(outline, 0.5 * (min + max)));
}

MaskResult emptyMask() {
    MaskResult result;
    result.mask.mip.texels = {0};
    return result;
}

struct Fill {
    scene::Path path;
    scene::FillRule rule;
};

/// Outlines stray by this share of the tolerance, pieces by the rest.
constexpr double outlineShare = 1.0 / 4;

Fill fillOf(const scene::Path& path, const scene::Affine& toPicture,
            const std::variant<scene::FillRule, scene::StrokeStyle>& geometry, double tolerance) {
    if (const auto* rule = std::get_if<scene::FillRule>(&geometry))
        return {path, *rule};
    const double stretch = compiler::largestStretch(toPicture);
    if (!(stretch > 0) || !std::isfinite(stretch))
        return {{}, scene::FillRule::NonZero};
    return {compiler::strokeOutline(path, std::get<scene::StrokeStyle>(geometry),
                                    tolerance * outlineShare / stretch),
            scene::FillRule::NonZero};
}

/// Of a mask's side: cells of the fifth level are still 16 times as wide.
constexpr double largestTolerance = 1.0 / 16384;

}  // namespace

MaskResult makeMask(const scene::Path& path, const scene::Affine& toPicture,
                    const std::variant<scene::FillRule, scene::StrokeStyle>& geometry,
                    const MaskOptions& options) {
    const Fill fill = fillOf(path, toPicture, geometry, options.tolerance);
    const Placement placement = placeMask(fill.path, toPicture, options.pictureSize);
    if (!(placement.side > 0))
        return emptyMask();
    const double tolerance = std::min(options.tolerance / placement.side, largestTolerance);
    const Outline outline =
        outlineInMask(fill.path, toPicture, fill.rule, placement, tolerance * outlineShare);
    MaskResult result;
    Mask& mask = result.mask;
    mask.x = placement.min.x, mask.y = placement.min.y, mask.side = placement.side;
    mask.root = TreeBuilder(outline, tolerance * (1 - outlineShare), options.maxDepth, result).build();
    if (mask.root.kind() == Entry::Kind::Solid && mask.root.payload() == 0)
        return emptyMask();
    mask.mip = makeMip(outline, options.mipLog2);
    result.coversPicture = covers(outline, placement, options.pictureSize, tolerance);
    return result;
}

}  // namespace vtm::paper
