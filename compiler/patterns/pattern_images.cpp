#include "compiler/patterns/pattern_images.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluate.hpp>
#include "compiler/compile/settings.hpp"

namespace vtm::compiler {
namespace {

using geometry::Box;
using glm::vec2;
using glm::vec4;
using scene::Affine;
using scene::Point;

/// Along the picture's longer side: a tile of a pattern of 20 000 has 14 pixels.
constexpr double pixelsAlongPicture = 2048;
constexpr double maxTileSide = 2048, maxSide = 4096, maxPixels = 0x1p25;
/// So many samples of a tile, along each axis, make a pixel, and a sample is a pixel of the tile.
constexpr int samples = 2;
/// What is drawn beside what is needed, as a share of it: filters read beyond a pixel, and tiles that are the
/// same but for rounding share an image.
constexpr double room = 1.0 / 64;
/// Of outlines, as a share of a tile: a 32nd of its pixels.
constexpr double tolerance = 0x1p-17;

/// One tile alone.
image::Raster drawnTile(const scene::Pattern& pattern, glm::ivec2 size, Options options, DrawnTiles& tiles) {
    scene::Scene scene;
    scene.width = scene.height = 1;  // the excerpt says what is drawn
    scene.root.children = pattern.content->children;
    const Excerpt excerpt = inPixels(pattern.min, pattern.max, Point(size));
    options.mode = asset::Mode::Exact;
    options.tolerance = tolerance;
    options.filterPixels = 0;
    return asset::evaluate(compileExcerpt(scene, excerpt, options, &tiles).asset, {size.x, size.y});
}

/// A tile that is repeated.
class Tiles {
public:
    explicit Tiles(const image::Raster& tile) : tile_(tile) {}

    /// Between the centres of four pixels; (0, 0) to (1, 1) is a tile.
    vec4 operator()(Point p) const {
        const Point at = glm::fract(p) * Point(tile_.width, tile_.height) - 0.5;
        const glm::ivec2 first(glm::floor(at));
        const vec2 share(at - Point(first));
        const int left = wrapped(first.x, tile_.width), right = wrapped(first.x + 1, tile_.width),
                  top = wrapped(first.y, tile_.height), bottom = wrapped(first.y + 1, tile_.height);
        return glm::mix(glm::mix(pixel(left, top), pixel(right, top), share.x),
                        glm::mix(pixel(left, bottom), pixel(right, bottom), share.x), share.y);
    }

private:
    /// Within one period of it.
    static int wrapped(int i, int period) { return i < 0 ? i + period : i >= period ? i - period : i; }
    vec4 pixel(int x, int y) const { return glm::make_vec4(tile_.pixel(x, y)); }

    const image::Raster& tile_;
};

/// `toTiles`: from pixels to where a tile is a unit.
image::Raster tiled(const image::Raster& tile, glm::ivec2 size, const Affine& toTiles) {
    const Tiles tiles(tile);
    image::Raster result(size.x, size.y);
    for (int y = 0; y < size.y; ++y) {
        limits::check();
        for (int x = 0; x < size.x; ++x) {
            vec4 sum(0);
            for (int i = 0; i < samples * samples; ++i)
                sum += tiles(scene::apply(
                    toTiles, Point(x, y) + (Point(i % samples, i / samples) + 0.5) / double(samples)));
            sum /= float(samples * samples);
            std::copy_n(&sum.x, 4, result.pixel(x, y));
        }
    }
    return result;
}

bool isMoved(const scene::Pattern& a, const Affine& aToPicture, const scene::Pattern& b,
             const Affine& bToPicture) {
    return a.content == b.content && a.min == b.min && a.max == b.max && aToPicture[0] == bToPicture[0] &&
           aToPicture[1] == bToPicture[1];
}

Box moved(const Box& box, Point by) { return {box.min + by, box.max + by}; }

}  // namespace

std::shared_ptr<const image::Raster> DrawnTiles::tile(const scene::Pattern& pattern, glm::ivec2 size,
                                                      const Options& options) {
    if (auto known = find(pattern, size))
        return known;
    auto pixels = std::make_shared<const image::Raster>(drawnTile(pattern, size, options, *this));
    const std::lock_guard lock(mutex_);
    tiles_.push_back({pattern.content, pattern.min, pattern.max, pixels, size});
    return pixels;
}

std::shared_ptr<const image::Raster> DrawnTiles::find(const scene::Pattern& pattern, glm::ivec2 size) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find_if(tiles_, [&](const Tile& tile) {
        return tile.content == pattern.content && tile.min == pattern.min && tile.max == pattern.max &&
               tile.size == size;
    });
    return found == tiles_.end() ? nullptr : found->pixels;
}

PatternImages::PatternImages(const Options& options, double longerSide, DrawnTiles* outer)
    : options_(options),
      tiles_(outer ? *outer : own_),
      scale_(std::min(pixelsAlongPicture / longerSide,
                      outer ? double(samples) : std::numeric_limits<double>::infinity())) {}

TileLimits PatternImages::limits() const {
    // Layer by layer each tile is a group, a hundred times as slow to draw; images are what other renderers
    // make of tiles.
    constexpr TileLimits ofLayers{1000, 4000};
    return options_.mode == asset::Mode::Compat ? ofLayers : TileLimits{};
}

std::optional<scene::ImagePaint> PatternImages::paint(const scene::Pattern& pattern, const Affine& toPicture,
                                                      const Box& seen, const Box& most) {
    bool isKnown = false;
    for (const Drawn& known : drawn_) {
        if (!isMoved(known.pattern, known.toPicture, pattern, toPicture))
            continue;
        isKnown = true;
        const Point by = toPicture[2] - known.toPicture[2];
        if (!moved(known.box, by).contains(seen))
            continue;
        scene::ImagePaint paint = known.paint;
        paint.transform[2] += by;
        return paint;
    }
    auto made = drawn(pattern, toPicture, isKnown ? most : seen);
    if (!made)
        return std::nullopt;
    drawn_.push_back(std::move(*made));
    return drawn_.back().paint;
}

std::optional<PatternImages::Drawn> PatternImages::drawn(const scene::Pattern& pattern,
                                                         const Affine& toPicture, Box box) {
    const Point more = room * (box.max - box.min) + 1 / scale_;
    box = {box.min - more, box.max + more};
    Point size = glm::clamp(glm::ceil(scale_ * (box.max - box.min)), 1.0, maxSide);
    // The first four that are as large as the picture have all pixels, the others fewer and fewer.
    const double most = (maxPixels - pixels_) / 4;
    if (size.x * size.y > most)
        size = glm::max(glm::floor(size * std::sqrt(most / (size.x * size.y))), 1.0);
    if (!(size.x * size.y <= maxPixels - pixels_))
        return std::nullopt;
    pixels_ += size.x * size.y;
    const Point period = pattern.max - pattern.min;
    const Point tilePixels = scale_ * period * Point(glm::length(toPicture[0]), glm::length(toPicture[1]));
    const glm::ivec2 tileSize(glm::clamp(glm::ceil(double(samples) * tilePixels), 1.0, maxTileSide));
    const auto tile = tiles_.tile(pattern, tileSize, options_);
    const Point pixel = (box.max - box.min) / size;
    const Affine toBox{pixel.x, 0, 0, pixel.y, box.min.x, box.min.y};
    const Affine toTiles = scene::compose(
        Affine{1 / period.x, 0, 0, 1 / period.y, -pattern.min.x / period.x, -pattern.min.y / period.y},
        scene::compose(*scene::inverse(toPicture), toBox));
    scene::ImagePaint paint;
    paint.bitmap =
        std::make_shared<const image::Bitmap>(image::toBitmap(tiled(*tile, glm::ivec2(size), toTiles)));
    paint.transform = toBox;
    return Drawn{pattern, toPicture, box, std::move(paint)};
}

}  // namespace vtm::compiler
