#include "compiler/lower/lower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <unordered_set>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/stroke.hpp>
#include "compiler/containers/hash.hpp"
#include "compiler/containers/number_map.hpp"
#include "compiler/filters/bounds.hpp"
#include "compiler/lower/outline_cache.hpp"
#include "compiler/lower/outlines_ahead.hpp"
#include "compiler/lower/paints.hpp"
#include "compiler/lower/repeated_paths.hpp"
#include "compiler/patterns/pattern_images.hpp"
#include "compiler/patterns/tile_range.hpp"
#include "compiler/patterns/tiling_stack.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {
namespace {

using geometry::Box;
using scene::Affine;
using scene::compose;
using scene::Path;
using scene::Point;

/// Of the first item; null if there is none.
const limits::Place* firstPlace(const scene::Group& group) {
    for (const scene::Node& node : group.children) {
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return &item->place;
        if (const auto* inner = std::get_if<scene::Group>(&node.value))
            if (const limits::Place* place = firstPlace(*inner))
                return place;
    }
    return nullptr;
}

/// Steps of tiles are so much finer than those of the picture, for assets: rounding to both, and arcs of
/// which a tile's are nearer to cubics, then stay within what ErrorBudget has for a step and an arc,
/// √2 / 64 + arcSteps / 64 < arcSteps.
constexpr double provenFineness = 64;

class Lowering {
public:
    Lowering(const scene::Scene& scene, const Excerpt& excerpt, const Lattice& lattice,
             const ErrorBudget& budget, Sharing sharing, OutlineCache* cache,
             std::vector<LayerOrigin>* origins, TilePlan* tiles, PatternImages* images)
        : lattice_(lattice),
          budget_(budget),
          sharing_(sharing),
          frame_{{0, 0}, {excerpt.width, excerpt.height}},
          isPart_(excerpt.isPart),
          cache_(cache),
          origins_(origins),
          tiles_(tiles),
          images_(images),
          tilings_(lattice, budget, sharing == Sharing::All ? 1 : provenFineness),
          shown_(frame_),
          paints_(picture_, excerpt),
          repeated_(budget.fillChords()) {
        if (cache_)
            picture_.outlines = cache_->take();
        // So that most pictures' need not be moved while they grow. Memory that is not written to costs
        // nothing.
        constexpr std::size_t usualPoints = 1u << 17, usualRuns = 1u << 15;
        picture_.outlines.points.reserve(usualPoints);
        picture_.outlines.runs.reserve(usualRuns);
        picture_.groups.emplace_back();
        if (const limits::Place* first = firstPlace(scene.root))
            place_ = *first;
        const limits::Stage stage("compiling", place_);  // between outlines too, an element is named
        if (!cache_)
            ahead_.emplace(scene.root, excerpt.fromScene, [this](Outlines& to, const OutlineOrigin& origin) {
                return appendOutline(to, origin);
            });
        if (ahead_ && budget_.mostChords() < maxChords && ahead_->leastPoints() > budget_.mostChords())
            throwTooManyChords();
        group(scene.root, excerpt.fromScene, openGroup(0));
    }

    LoweredScene take() { return std::move(picture_); }

private:
    void children(const scene::Group& g, const Affine& outer, std::uint32_t into) {
        for (std::size_t i = 0; i < g.children.size(); ++i) {
            limits::check();
            const scene::Node& node = g.children[i];
            if (const auto* item = std::get_if<scene::Item>(&node.value)) {
                const auto* next =
                    i + 1 < g.children.size() ? std::get_if<scene::Item>(&g.children[i + 1].value) : nullptr;
                if (sharing_ != Sharing::None && tilings_.empty() && next && mayHideOutline(*item, *next)) {
                    fillBelowStroke(*item, *next, outer, into);
                    ++i;
                } else {
                    this->item(*item, outer, into);
                }
            } else if (const auto* chosen = std::get_if<scene::Select>(&node.value)) {
                select(*chosen, outer, into);
            } else {
                group(std::get<scene::Group>(node.value), outer, openGroup(into));
            }
        }
    }

    void group(const scene::Group& g, const Affine& outer, std::uint32_t index) {
        LoweredGroup& record = picture_.groups[index];
        record.opacity = g.opacity;
        record.blend = g.blend;
        if (g.clip)
            picture_.groups[index].clip = clip(*g.clip, outer);
        children(g, outer, index);
        if (g.mask)
            mask(*g.mask, outer, index);
    }

    /// Two groups in one, clipped by the same layer and by its complement.
    void select(const scene::Select& s, const Affine& outer, std::uint32_t into) {
        place_ = {};
        const std::uint32_t both = openGroup(into);
        const std::uint32_t mask = geometryLayer(s.mask, compose(outer, s.mask.transform));
        side(s.inside, {mask, noIndex, false}, outer, both);
        side(s.outside, {mask, noIndex, true}, outer, both);
    }

    void side(const std::shared_ptr<const scene::Group>& content, ClipExpression::Term term,
              const Affine& outer, std::uint32_t into) {
        if (!content)
            return;
        const std::uint32_t index = openGroup(into);
        picture_.groups[index].adds = term.inverted;
        picture_.groups[index].clip = addClip({{term}, noIndex});
        // The side's own opacity, clip and mask belong to its content: one group further in.
        group(*content, outer, openGroup(index));
    }

    std::uint32_t openGroup(std::uint32_t parent) {
        LoweredGroup g;
        g.parent = parent;
        g.depth = picture_.groups[parent].depth + 1;
        picture_.groups.push_back(g);
        return static_cast<std::uint32_t>(picture_.groups.size() - 1);
    }

    void mask(const scene::Mask& m, const Affine& outer, std::uint32_t of) {
        const std::uint32_t index = openGroup(of);
        picture_.groups[of].mask = index;
        picture_.groups[index].role = m.kind == scene::MaskKind::Alpha ? GroupRole::AlphaMask
                                      : m.linear                       ? GroupRole::LinearMask
                                                                       : GroupRole::LuminanceMask;
        // The mask's own opacity, clip and mask belong to its content: one group further in.
        group(*m.content, outer, openGroup(index));
    }

    std::uint32_t clip(const scene::Clip& c, const Affine& outer) {
        ClipExpression expression;
        for (const scene::ClipShape& shape : c.shapes) {
            ClipExpression::Term term;
            place_ = shape.place;
            term.layer = clipLayer({shape.path, compose(outer, shape.transform)}, shape.rule);
            if (shape.clip)
                term.clip = clip(*shape.clip, outer);
            expression.terms.push_back(term);
        }
        if (c.clip)
            expression.outer = clip(*c.clip, outer);
        return addClip(std::move(expression));
    }

    /// A new one, or an equal one of an earlier clip.
    std::uint32_t clipLayer(const OutlineOrigin& origin, scene::FillRule rule) {
        const std::uint32_t made = layer(origin, rule);
        if (sharing_ != Sharing::All)
            return made;
        std::uint64_t hash = std::uint64_t(rule);
        for (const LatticePoint p : pointsOf(made))
            hash = hashCombine(hash, sortKey(p));
        std::uint32_t& known = clipLayers_[hash];
        if (known == NumberMap::unknown)
            known = made;
        if (known == made || !isSameOutline(known, made))
            return made;
        const Layer& again = picture_.layers[made];
        if (again.runCount > 0)
            picture_.outlines.points.resize(picture_.outlines.runs[again.firstRun].first);
        picture_.outlines.runs.resize(again.firstRun);
        picture_.layers.pop_back();
        picture_.itemOfLayer.pop_back();
        if (origins_)
            origins_->pop_back();
        return known;
    }

    bool isSameOutline(std::uint32_t first, std::uint32_t second) const {
        const Layer &a = picture_.layers[first], &b = picture_.layers[second];
        if (a.rule != b.rule || a.runCount != b.runCount ||
            !std::ranges::equal(pointsOf(first), pointsOf(second)))
            return false;
        const Run *p = &picture_.outlines.runs[a.firstRun], *q = &picture_.outlines.runs[b.firstRun];
        for (std::uint32_t r = 0; r < a.runCount; ++r)
            if (p[r].first - p[0].first != q[r].first - q[0].first ||
                p[r].last - p[0].first != q[r].last - q[0].first)
                return false;
        return true;
    }

    /// Of a layer that shares none.
    std::span<const LatticePoint> pointsOf(std::uint32_t index) const {
        const Layer& l = picture_.layers[index];
        if (l.runCount == 0)
            return {};
        const std::uint32_t first = picture_.outlines.runs[l.firstRun].first;
        return std::span(picture_.outlines.points)
            .subspan(first, picture_.outlines.runs[l.firstRun + l.runCount - 1].last + 1 - first);
    }

    std::uint32_t addClip(ClipExpression expression) {
        picture_.clips.push_back(std::move(expression));
        return static_cast<std::uint32_t>(picture_.clips.size() - 1);
    }

    /// Whether the stroke of a fill's outline, which lies right above it, may hide where the fill ends.
    static bool mayHideOutline(const scene::Item& fill, const scene::Item& stroke) {
        const auto* style = std::get_if<scene::StrokeStyle>(&stroke.geometry);
        return std::holds_alternative<scene::FillRule>(fill.geometry) && style && style->dashes.empty() &&
               style->width > 0 && fill.path == stroke.path && fill.transform == stroke.transform &&
               stroke.opacity >= 1 && !std::holds_alternative<scene::Pattern>(fill.paint) &&
               !std::holds_alternative<scene::Pattern>(stroke.paint);
    }

    /// Two items. The fill gets outlines of the stroke's where these will do.
    void fillBelowStroke(const scene::Item& fill, const scene::Item& stroke, const Affine& outer,
                         std::uint32_t into) {
        place_ = fill.place;
        const Affine transform = compose(outer, fill.transform);
        const auto fillSource = paints_.add(fill.paint, transform),
                   strokeSource = paints_.add(stroke.paint, transform);
        const OutlineOrigin fillOrigin{fill.path, transform},
            strokeOrigin{stroke.path, transform, &std::get<scene::StrokeStyle>(stroke.geometry)};
        const bool isHidden = strokeSource && picture_.sources[*strokeSource].opaque;
        std::optional<std::uint32_t> shared;
        RunRange strokeRuns, fillRuns;
        if (strokeSource) {
            picture_.sampledStrokes += hasSampledOffsets(*stroke.path);
            strokeRuns = outline(strokeOrigin, &shared);
        }
        if (fillSource) {
            fillRuns = isHidden && shared ? RunRange{strokeRuns.first, *shared} : outline(fillOrigin);
            paint(addLayer(fillOrigin, fillRuns, std::get<scene::FillRule>(fill.geometry)), fill, *fillSource,
                  into);
        }
        if (strokeSource)
            paint(addLayer(strokeOrigin, strokeRuns, scene::FillRule::NonZero), stroke, *strokeSource, into);
    }

    void item(const scene::Item& item, const Affine& outer, std::uint32_t into) {
        place_ = item.place;
        const Affine transform = outer == scene::identity ? item.transform : compose(outer, item.transform);
        if (const auto* pattern = std::get_if<scene::Pattern>(&item.paint)) {
            if (tilings_.empty())
                patternItem(item, *pattern, transform, into);
            else
                patternInTile(item, *pattern, transform, into);
            return;
        }
        const auto source = paints_.add(item.paint, transform);
        if (!source)
            return;
        paint(geometryLayer(item, transform), item, *source, into);
    }

    void paint(std::uint32_t layer, const scene::Item& item, std::uint32_t source, std::uint32_t into) {
        picture_.itemOfLayer[layer] = static_cast<std::uint32_t>(picture_.items.size());
        picture_.items.push_back({layer, source, item.opacity, into});
    }

    /// A group of tiles, clipped by the item's own outline; or an image of them.
    void patternItem(const scene::Item& item, const scene::Pattern& pattern, const Affine& transform,
                     std::uint32_t into) {
        const std::uint32_t shape = geometryLayer(item, transform);
        const Affine toPicture = compose(transform, pattern.transform);
        const auto toPattern = scene::inverse(toPicture);
        const Box inTile = bounds(picture_.layers[shape]).intersection(shown_);
        // A tile that is placed shows all of it.
        const Box seen = isPlacedTile_ ? inTile : inTile.intersection(frame_);
        if (!toPattern || seen.empty())
            return;
        const TileRange range = tilesIn(geometry::mapped(seen, *toPattern), pattern);
        if (range.isFarAway())
            return leaveOut("a pattern's tiles are too far from its origin");
        const TileContent content = tileCounter_.inOneTile(pattern);
        const double count = range.count(), inAll = count * (1 + content.tiles);
        const auto asImage = [&] { patternImage(item, pattern, toPicture, {shape, inAll, inTile}, into); };
        const double segments = count * std::max(content.segments, 1.0);
        if (content.isOfColors && !isFarLargerThan(frame_, pattern, toPicture) &&
            isWorthTiling(count, segments, content) && tilings_.isFine(pattern, toPicture))
            return tiled(pattern, range, tilesSeen(pattern, range, *toPattern, shape),
                         compose(lattice_.toSteps(), toPicture), tileGroup(item, shape, into));
        const bool canPlace = tiles_ && !isPlacedTile_ && tiles_->patterns.size() < maxPlacedFills &&
                              segmentsPlaced_ + segments <= double(maxPlacedSegments);
        if (canPlace && (count > fewTiles || (inAll > fewTiles && content.tiles <= double(maxTilesInTile)))) {
            segmentsPlaced_ += segments;
            tiles_->patterns.push_back({toPicture, pattern.min, pattern.max, glm::i64vec2(range.first),
                                        glm::i64vec2(range.last), shape, content.tiles});
            if (!tiles_->chosen)
                return;
            const TilePlan::Chosen& chosen = (*tiles_->chosen)[tiles_->patterns.size() - 1];
            if (!chosen.isImage)
                return placedTiles(pattern, toPicture, chosen.tiles, tileGroup(item, shape, into));
            tiles_->firstTiles.emplace_back();
            return asImage();
        }
        const TileLimits limits = images_ ? images_->limits() : TileLimits{};
        const double limit = isPlacedTile_ ? maxTilesInTile : limits.ofFill;
        // Fills are planned in the same order each time, so what placed tiles hold does not count.
        tilesLowered_ += isPlacedTile_ ? 0 : count;
        // Where few tiles hold many, these are placed.
        if ((!canPlace && !(inAll <= limit)) || !(tilesLowered_ <= limits.ofAll))
            return asImage();
        const std::uint32_t group = tileGroup(item, shape, into);
        const auto border = borderOf(pattern);
        for (double y = range.first.y; y <= range.last.y; ++y)
            for (double x = range.first.x; x <= range.last.x; ++x)
                tile(pattern, border, toPicture, {x, y}, group);
    }

    /// Of colours. Assets place tiles that repeat, but lines across tiles are better long, and of many fills
    /// that are placed each would have to be looked at beside all others.
    bool isWorthTiling(double count, double segments, const TileContent& content) const {
        if (pointsTiled_ > maxTiledPoints)
            return false;
        if (sharing_ == Sharing::All)
            return segments <= double(maxTiledSegments);
        if (sharing_ == Sharing::None || isPlacedTile_ || segments > double(maxTiledSegmentsOfAssets))
            return false;
        return count <= fewTiles ? content.reachesAcross
                                 : tiles_ && tiles_->patterns.size() >= fewPlacedFills;
    }

    std::uint32_t tileGroup(const scene::Item& item, std::uint32_t shape, std::uint32_t into) {
        const std::uint32_t index = openGroup(into);
        picture_.groups[index].opacity = item.opacity;
        picture_.groups[index].clip = addClip({{{shape, noIndex, false}}, noIndex});
        return index;
    }

    std::vector<TileSpan> tilesSeen(const scene::Pattern& pattern, const TileRange& range,
                                    const Affine& toPattern, std::uint32_t shape) const {
        TileSpans spans(range, pattern);
        const double step = 2 / lattice_.stepsPerUnit();
        const Point slack = glm::abs(scene::applyVector(toPattern, {step, 0})) +
                            glm::abs(scene::applyVector(toPattern, {0, step}));
        const Layer& layer = picture_.layers[shape];
        for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r) {
            limits::check();
            for (std::uint32_t i = picture_.outlines.runs[r].first; i < picture_.outlines.runs[r].last; ++i)
                spans.add(scene::apply(toPattern, lattice_.toUnits(picture_.outlines.points[i])),
                          scene::apply(toPattern, lattice_.toUnits(picture_.outlines.points[i + 1])), slack);
        }
        return spans.take();
    }

    /// A pattern of colours in a tile of another. Its tiles are those in one of these.
    void patternInTile(const scene::Item& item, const scene::Pattern& pattern, const Affine& transform,
                       std::uint32_t into) {
        const Tiling& outer = tilings_.innermost();
        const std::uint32_t shape = geometryLayer(item, transform);
        const Affine toOuter = compose(transform, pattern.transform);
        const auto toPattern = scene::inverse(toOuter);
        scene::Item moved = item;
        moved.transform = transform;
        const Box seen = boundsOf({scene::Node{std::move(moved)}}, scene::identity)
                             .intersection({outer.tileMin(), outer.tileMax()});
        if (!toPattern || seen.empty())
            return;
        const TileRange range = tilesIn(geometry::mapped(seen, *toPattern), pattern);
        if (range.isFarAway())
            return leaveOut("a pattern's tiles are too far from its origin");
        tiled(pattern, range, allOf(range), toOuter, tileGroup(item, shape, into));
    }

    /// The content of tiles as if it were that of a group: each outline is that in all of them.
    void tiled(const scene::Pattern& pattern, const TileRange& range, std::vector<TileSpan> rows,
               const Affine& toOutside, std::uint32_t into) {
        const auto toTile = tilings_.enter(pattern, range, std::move(rows), toOutside);
        if (!toTile)
            return;
        group(*pattern.content, *toTile, openGroup(into));
        tilings_.leave();
    }

    /// Tiles of a fill of many: those that are not placed.
    void placedTiles(const scene::Pattern& pattern, const Affine& toPicture,
                     const std::vector<glm::i64vec2>& chosen, std::uint32_t into) {
        const auto border = borderOf(pattern);
        const auto firstLayer = std::uint32_t(picture_.layers.size());
        tiles_->firstTiles.push_back({firstLayer, 0});
        isPlacedTile_ = true;
        for (const glm::i64vec2 at : chosen) {
            tile(pattern, border, toPicture, Point(at), into);
            if (at == chosen.front())
                tiles_->firstTiles.back().count = std::uint32_t(picture_.layers.size()) - firstLayer;
        }
        isPlacedTile_ = false;
    }

    std::shared_ptr<const Path> borderOf(const scene::Pattern& pattern) {
        return cache_ ? cache_->rectangle(pattern.min, pattern.max)
                      : std::make_shared<const Path>(scene::rectangle(pattern.min, pattern.max));
    }

    /// A fill of so many tiles.
    struct PatternFill {
        std::uint32_t shape;
        double tiles;
        Box seen;
    };

    void patternImage(const scene::Item& item, const scene::Pattern& pattern, const Affine& toPicture,
                      const PatternFill& fill, std::uint32_t into) {
        picture_.lacksImages |= !images_;
        const auto image = images_ ? images_->paint(pattern, toPicture, fill.seen, shown_) : std::nullopt;
        const auto source = image ? paints_.add(*image, scene::identity) : std::nullopt;
        if (!source)
            return leaveOut(
                fmt::format("a pattern needs {:.6g} tiles; the limit is {}", fill.tiles, maxTiles));
        warn("a pattern has too many tiles and is drawn as an image");
        paint(fill.shape, item, *source, into);
    }

    /// Tile `at`.
    void tile(const scene::Pattern& pattern, const std::shared_ptr<const Path>& border,
              const Affine& patternToPicture, Point at, std::uint32_t into) {
        limits::check();
        const Point by = at * (pattern.max - pattern.min);
        const Affine toPicture = compose(patternToPicture, scene::translation(by.x, by.y));
        const std::uint32_t index = openGroup(into);
        const std::uint32_t cut = layer({border, toPicture}, scene::FillRule::NonZero);
        picture_.groups[index].clip = addClip({{{cut, noIndex, false}}, noIndex});
        const Box box = geometry::mapped(Box{pattern.min, pattern.max}, toPicture);
        // Tiles share what is drawn for one of them, unless they are far larger than the picture.
        constexpr double most = 4;
        const bool isShared = box.width() * box.height() <= most * frame_.width() * frame_.height();
        const Box outer = std::exchange(shown_, isShared ? box : box.intersection(frame_));
        group(*pattern.content, toPicture, openGroup(index));
        shown_ = outer;
    }

    /// Of an item or a shape.
    template <class Shaped>
    std::uint32_t geometryLayer(const Shaped& shape, const Affine& transform) {
        if (const auto* rule = std::get_if<scene::FillRule>(&shape.geometry))
            return layer({shape.path, transform}, *rule);
        picture_.sampledStrokes += hasSampledOffsets(*shape.path);
        return layer({shape.path, transform, &std::get<scene::StrokeStyle>(shape.geometry)},
                     scene::FillRule::NonZero);
    }

    std::uint32_t layer(const OutlineOrigin& origin, scene::FillRule rule) {
        const std::size_t pointsBefore = picture_.outlines.points.size();
        const std::optional<RunRange> known = cache_ ? cache_->find(origin) : std::nullopt;
        const RunRange runs = known ? *known : outline(origin);
        if (cache_ && !known)
            cache_->add(origin, runs,
                        static_cast<std::uint32_t>(picture_.outlines.points.size() - pointsBefore));
        return addLayer(origin, runs, rule);
    }

    std::uint32_t addLayer(const OutlineOrigin& origin, RunRange runs, scene::FillRule rule) {
        if (origins_)
            origins_->push_back(
                {tilings_.empty() ? origin.path : nullptr, origin.transform, origin.stroke, rule});
        picture_.layers.push_back({rule, runs.first, runs.count, place_});
        checkLimits();
        picture_.itemOfLayer.push_back(noIndex);
        return static_cast<std::uint32_t>(picture_.layers.size() - 1);
    }

    /// `sides`: of a stroke, what addStroke returns. A stroke beyond the limits is left out, with a warning.
    RunRange outline(const OutlineOrigin& origin, std::optional<std::uint32_t>* sides = nullptr) {
        const limits::Stage stage(origin.stroke ? "stroking" : "flattening", place_);
        if (const auto made = ahead_ && tilings_.empty() ? ahead_->take(origin) : std::nullopt) {
            if (sides)
                *sides = made->sides;
            return append(*made, picture_.outlines);
        }
        const std::size_t points = picture_.outlines.points.size(), runs = picture_.outlines.runs.size();
        try {
            if (!tilings_.empty()) {
                tilings_.append(picture_.outlines, origin);
                pointsTiled_ += picture_.outlines.points.size() - points;
            } else if (const auto first = appendOutline(picture_.outlines, origin); sides) {
                *sides = first;
            }
        } catch (const LimitError& error) {
            if (!origin.stroke)
                throw;
            picture_.outlines.points.resize(points);
            picture_.outlines.runs.resize(runs);
            leaveOut(error.what());
        }
        return {static_cast<std::uint32_t>(runs),
                static_cast<std::uint32_t>(picture_.outlines.runs.size() - runs)};
    }

    /// A stroke beyond the limits is a LimitError. Changes nothing else: threads call it at once.
    std::optional<std::uint32_t> appendOutline(Outlines& to, const OutlineOrigin& origin) const {
        if (!origin.stroke) {
            if (sharing_ != Sharing::All ||
                !repeated_.append(to, origin.path, toSteps(origin), lattice_.clampMin(), lattice_.clampMax()))
                addOutline(to, *origin.path, toSteps(origin), budget_.fillChords(), lattice_.clampMin(),
                           lattice_.clampMax());
            return std::nullopt;
        }
        const double stretch = largestStretch(origin.transform) * lattice_.stepsPerUnit();
        if (!(stretch > 0 && std::isfinite(stretch)))
            return std::nullopt;
        return addStroke(to, *origin.path, *origin.stroke, budget_.strokeOutline() / stretch,
                         budget_.strokeChords().scaled(1 / stretch), toSteps(origin), budget_.strokeChords(),
                         lattice_.clampMin(), lattice_.clampMax(), nearFrame(origin.transform));
    }

    void leaveOut(const std::string& why) { warn(why + "; it is left out"); }
    /// Tiles say the same again and again.
    void warn(const std::string& what) {
        std::string warning = fmt::format("{}:{}: {}", place_.line, place_.column, what);
        if (warned_.insert(warning).second)
            picture_.warnings.push_back(std::move(warning));
    }

    /// What of a path's space a stroke must be right in; everywhere if nothing is said.
    std::optional<PathBox> nearFrame(const Affine& transform) const {
        const auto toPath = isPart_ ? scene::inverse(transform) : std::nullopt;
        if (!toPath)
            return std::nullopt;
        const Box box = geometry::mapped(frame_, *toPath);
        return PathBox{box.min, box.max};
    }

    Affine toSteps(const OutlineOrigin& origin) const {
        return compose(lattice_.toSteps(), origin.transform);
    }

    std::size_t mostChords() const { return std::min(maxChords, budget_.mostChords()); }
    [[noreturn]] void throwTooManyChords() const {
        throw LimitError(fmt::format("the picture's outlines have more than {} chords", mostChords()));
    }

    void checkLimits() const {
        if (picture_.outlines.points.size() > mostChords())
            throwTooManyChords();
        if (picture_.layers.size() >= maxLayers)
            throw LimitError("the picture has more than " + std::to_string(maxLayers) + " layers");
    }

    Box bounds(const Layer& layer) const {
        Box box;
        for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r) {
            box.add(lattice_.toUnits(picture_.outlines.points[picture_.outlines.runs[r].first]));
            box.add(lattice_.toUnits(picture_.outlines.points[picture_.outlines.runs[r].last]));
        }
        return box;
    }

    const Lattice& lattice_;
    const ErrorBudget& budget_;
    const Sharing sharing_;
    const Box frame_;
    const bool isPart_;
    OutlineCache* const cache_;
    std::vector<LayerOrigin>* const origins_;
    TilePlan* const tiles_;
    PatternImages* const images_;
    std::unordered_set<std::string> warned_;
    NumberMap clipLayers_;  ///< by a hash of their outlines
    TileCounter tileCounter_;
    double segmentsPlaced_ = 0, tilesLowered_ = 0;
    std::size_t pointsTiled_ = 0;
    TilingStack tilings_;        ///< around what is being lowered
    bool isPlacedTile_ = false;  ///< of what is being lowered
    Box shown_;                  ///< of what is being lowered: the picture or a tile
    limits::Place place_;        ///< of what is being lowered
    LoweredScene picture_;
    PaintTable paints_;
    mutable RepeatedPaths repeated_;  ///< threads use it at once
    std::optional<OutlinesAhead> ahead_;
};

}  // namespace

LoweredScene lower(const scene::Scene& scene, const Excerpt& excerpt, const Lattice& lattice,
                   const ErrorBudget& budget, Sharing sharing, OutlineCache* cache,
                   std::vector<LayerOrigin>* origins, TilePlan* tiles, PatternImages* images) {
    LoweredScene picture =
        Lowering(scene, excerpt, lattice, budget, sharing, cache, origins, tiles, images).take();
    if (origins)
        for (std::size_t i = 0; i < origins->size(); ++i)
            (*origins)[i].isClip = picture.itemOfLayer[i] == noIndex;
    return picture;
}

}  // namespace vtm::compiler
