#include "compiler/direct/plain_drawing.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vtm/limits/limits.hpp>
#include "compiler/compile/settings.hpp"
#include "compiler/direct/band_sweep.hpp"
#include "compiler/direct/hidden_layers.hpp"
#include "compiler/direct/pixel_colors.hpp"
#include "compiler/direct/region_state.hpp"
#include "compiler/direct/resolve_clips.hpp"
#include "compiler/direct/view_chains.hpp"
#include "compiler/lower/lower.hpp"
#include "compiler/patterns/pattern_images.hpp"
#include "raster/chord_scanner.hpp"
#include "raster/drawing_threads.hpp"

namespace vtm::compiler {
namespace {

using asset::bandRows;
using BandChords = std::vector<asset::Chord>;

/// So many chords are made before they are drawn: their paints are told to the scanner once, and they are
/// still in the cache.
constexpr std::size_t chordsAtOnce = 1u << 15;
/// After so many of a strip its paints are forgotten.
constexpr std::size_t mostStripChords = 1u << 19;
/// And so many colours are remembered.
constexpr std::size_t colorsAtOnce = 1u << 18;
/// Fewer are kept for the next strip. Programs are not: how many a strip remembers tells how it is drawn.
constexpr std::size_t keptColors = 1u << 12;

/// A picture of more chords than that is drawn with a coarser tolerance: edges that lie so close hide most of
/// each other, and what chords miss on both sides of curves cancels.
constexpr std::size_t manyChords = 1u << 24;
constexpr double coarserChords = 8;
constexpr double coarsestTolerance = 0x1p-6;  // of Options::tolerance

/// What one thread uses again.
struct ThreadState {
    ThreadState(const LoweredScene& picture, const ViewChains& chains, std::span<const image::Bitmap> bitmaps,
                const std::shared_ptr<const asset::Images>& images, const asset::View& view)
        : state(picture),
          pixels(picture, bitmaps, images, view),
          sweep(picture, chains, state, pixels, view.width),
          scanner(view) {}

    RegionState state;
    PixelColors pixels;
    BandSweep sweep;
    asset::ChordScanner scanner;
    std::vector<BandChords> bands;  ///< keep their memory
    std::size_t swept = 0;          ///< of them: those with chords that are to be drawn
    bool mustBegin = true;          ///< the sweep, since the paints that it knows are forgotten
};

/// The images, with what the picture's fills read of them.
std::shared_ptr<const asset::Images> fillsOf(const LoweredScene& picture,
                                             std::span<const image::Bitmap> bitmaps) {
    asset::Asset fills;
    fills.data = picture.data;
    for (const Source& source : picture.sources)
        if (source.op == asset::Op::Image)
            fills.paints.push_back(
                encodePaint({{{source.op, asset::Blend::Normal, 1, source.data}, {}}}, fills.data));
    asset::AssetView view(fills);
    view.images = bitmaps;
    return asset::imagesOf(view);
}

/// Where many chains meet bands and a large part of them is hidden, these are not swept. Bands begin anew.
void leaveOutHidden(const LoweredScene& picture, ViewChains& chains, const asset::View& view) {
    constexpr std::size_t many = 1u << 15, share = 8, fewLayers = 64;
    if (chains.inBands() < many || picture.layers.size() < fewLayers)
        return;
    const HiddenLayers hidden(picture, chains, view.width, view.height);
    if (hidden.hiddenInBands() >= chains.inBands() / share)
        chains.leaveOut([&](const DownChain& chain, int band) { return hidden.isHidden(chain.layer, band); });
}

/// A raster shows no finer tolerance than this share of a pixel: single chords are within a quarter of it.
constexpr double finestShown = 1.0 / 64;
/// Others misplace this much of a pixel, half a 255th.
constexpr double misplacedArea = 1.0 / 512;

/// Along the longer side of an excerpt.
double pixelsAlong(const Excerpt& excerpt, const asset::View& view) {
    return largestStretch(view.toPixels) * std::max(excerpt.width, excerpt.height);
}

/// A view shows no finer tolerance.
Options forPixels(Options options, const Excerpt& excerpt, const asset::View& view) {
    if (const double pixels = pixelsAlong(excerpt, view); pixels > 0)
        options.tolerance = std::max(options.tolerance, std::min(coarsestTolerance, finestShown / pixels));
    return options;
}

}  // namespace

struct PlainDrawing::Impl {
    const asset::View view;
    const LoweredScene picture;
    const std::vector<image::Bitmap> bitmaps;
    const std::shared_ptr<const asset::Images> images;
    const ViewChains chains;
    std::vector<std::string> warnings;

    /// With coarser chords where there are too many.
    static std::unique_ptr<Impl> lowered(const scene::Scene& scene, const Excerpt& excerpt,
                                         const asset::View& view, Options options) {
        const double pixels = pixelsAlong(excerpt, view) * options.tolerance;
        const double area = pixels > 0 ? misplacedArea / (pixels * pixels) : 0;
        if (options.tolerance * coarserChords <= coarsestTolerance) {
            try {
                return lowered(scene, excerpt, view, options, area, manyChords);
            } catch (const LimitError&) {
                options.tolerance *= coarserChords;
            }
        }
        return lowered(scene, excerpt, view, options, area, maxChords);
    }

    /// Null if there are patterns of many tiles, or materials. `area`: that of ErrorBudget's chords.
    static std::unique_ptr<Impl> lowered(const scene::Scene& scene, const Excerpt& excerpt,
                                         const asset::View& view, const Options& options, double area,
                                         std::size_t mostChords) {
        const Lattice lattice(excerpt.width, excerpt.height, latticeBits(options));
        PatternImages images(options, std::max(excerpt.width, excerpt.height), nullptr);
        TilePlan tiles;
        const ErrorBudget budget(options.tolerance, latticeBits(options), mostChords, area);
        LoweredScene picture =
            lower(scene, excerpt, lattice, budget, Sharing::All, nullptr, nullptr, &tiles, &images);
        if (!tiles.patterns.empty() || !picture.materials.empty())
            return nullptr;
        resolveClips(picture);
        ViewChains chains(picture, lattice, view);
        leaveOutHidden(picture, chains, view);
        std::vector<image::Bitmap> bitmaps = bitmapsOf(picture);
        auto fills = fillsOf(picture, bitmaps);
        std::vector<std::string> warnings = std::move(picture.warnings);
        return std::unique_ptr<Impl>(new Impl{view, std::move(picture), std::move(bitmaps), std::move(fills),
                                              std::move(chains), std::move(warnings)});
    }

    /// Calls drawBands(scanner, first band, chords of the bands from there on, paints) for bands first to end
    /// - 1, from several threads.
    template <class Draw>
    void draw(int first, int end, const Draw& drawBands) const {
        const limits::Stage stage("drawing");
        tbb::enumerable_thread_specific<ThreadState> workers(
            [&] { return ThreadState(picture, chains, bitmaps, images, view); });
        const int threads = isWorthThreads() ? tbb::this_task_arena::max_concurrency() : 1;
        const int strips = (end - first + stripBands - 1) / stripBands;
        const int grain = stripBands * std::max(1, threads == 1 ? strips : strips / (4 * threads));
        tbb::parallel_for(0, (end - first + grain - 1) / grain, [&, holding = limits::current()](int task) {
            const limits::Scope scope(holding);
            const int from = first + task * grain;
            drawSome(workers.local(), from, std::min(from + grain, end), drawBands);
        });
    }

    bool isWorthThreads() const {
        constexpr std::size_t chainInBand = 2000;  // pixels take as long, and more where chains are crowded
        const auto isProgram = [](const Source& source) { return source.op != asset::Op::Solid; };
        return asset::areThreadsWorthIt(asset::pixelsIn(view),
                                        std::ranges::any_of(picture.sources, isProgram),
                                        chainInBand * chains.inBands());
    }

    template <class Draw>
    void drawSome(ThreadState& worker, int first, int end, const Draw& drawBands) const {
        // Where a sweep begins anew must not depend on what the thread has drawn before: only on the strip.
        std::size_t chords = 0, inStrip = 0;
        worker.swept = 0;
        for (int band = first; band < end; ++band) {
            const bool beginsStrip = band % stripBands == 0,
                       endsStrip = (band + 1) % stripBands == 0 || band + 1 == end;
            if (beginsStrip)
                inStrip = 0;
            if (worker.swept == worker.bands.size())
                worker.bands.emplace_back();
            BandChords& made = worker.bands[worker.swept++];
            made.clear();
            worker.sweep.run(band, beginsStrip || worker.mustBegin, made);
            worker.mustBegin = false;
            inStrip += made.size();
            chords += made.size();
            const RegionState& state = worker.state;
            const bool isMuch =
                chords >= chordsAtOnce || state.colors().size() >= colorsAtOnce || !state.programs().empty();
            const bool forgets = inStrip >= mostStripChords;
            if (band + 1 < end && !forgets && !(endsStrip && isMuch))
                continue;
            drawPainted(worker, first, drawBands);
            first = band + 1;
            chords = 0;
            worker.swept = 0;
            if (forgets ||
                (endsStrip && (state.colors().size() >= keptColors || !state.programs().empty()))) {
                worker.state.forgetPaints();
                worker.mustBegin = true;
                inStrip = 0;
            }
        }
    }

    template <class Draw>
    void drawPainted(ThreadState& worker, int first, const Draw& drawBands) const {
        asset::Asset programs;
        programs.data = picture.data;
        for (const PaintProgram& program : worker.state.programs())
            programs.paints.push_back(encodePaint(program, programs.data));
        asset::AssetView paints(programs);
        paints.images = bitmaps;
        const auto programCount = std::uint32_t(programs.paints.size());
        const auto number = [&](RegionPaint paint) {
            return (paint & programBit) != 0 ? paint ^ programBit : programCount + paint;
        };
        const std::span bands = std::span(worker.bands).first(worker.swept);
        for (BandChords& chords : bands)
            for (asset::Chord& chord : chords) {
                chord.left = number(chord.left);
                chord.right = number(chord.right);
            }
        drawBands(worker.scanner, first, bands, asset::ChordPaints{paints, images, worker.state.colors()});
    }

    int bands() const { return chains.bands(); }
};

PlainDrawing::PlainDrawing(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
PlainDrawing::~PlainDrawing() = default;

std::unique_ptr<const PlainDrawing> PlainDrawing::make(const scene::Scene& scene, const Excerpt& excerpt,
                                                       const asset::View& view, Options options) {
    auto impl = Impl::lowered(scene, excerpt, view, forPixels(std::move(options), excerpt, view));
    return impl ? std::unique_ptr<const PlainDrawing>(new PlainDrawing(std::move(impl))) : nullptr;
}

const std::vector<std::string>& PlainDrawing::warnings() const { return impl_->warnings; }

void PlainDrawing::draw(const asset::ByteTarget& target) const {
    impl_->draw(0, impl_->bands(),
                [&](asset::ChordScanner& scanner, int first, std::span<BandChords> bands,
                    const asset::ChordPaints& paints) { scanner.draw(first, bands, paints, target); });
}

image::Raster PlainDrawing::draw() const {
    image::Raster raster(impl_->view.width, impl_->view.height);
    scan(0, impl_->view.height, [&](int y, const asset::ColorRun& run) {
        for (int x = run.first; x < run.end; ++x)
            for (int c = 0; c < 4; ++c)
                raster.pixel(x, y)[c] = run.color[c] > 0 ? std::min(run.color[c], 1.0f) : 0.0f;
    });
    return raster;
}

void PlainDrawing::scan(int first, int end,
                        const std::function<void(int, const asset::ColorRun&)>& take) const {
    const auto takeIfWanted = [&](int y, const asset::ColorRun& run) {
        if (y >= first && y < end)
            take(y, run);
    };
    const int firstBand = first / (bandRows * stripBands) * stripBands;
    impl_->draw(firstBand, (end + bandRows - 1) / bandRows,
                [&](asset::ChordScanner& scanner, int at, std::span<BandChords> bands,
                    const asset::ChordPaints& paints) { scanner.scan(at, bands, paints, takeIfWanted); });
}

void PlainDrawing::add(const asset::PixelsToAddTo& pixels) const {
    impl_->draw(0, impl_->bands(),
                [&](asset::ChordScanner& scanner, int first, std::span<BandChords> bands,
                    const asset::ChordPaints& paints) { scanner.add(first, bands, paints, pixels); });
}

void PlainDrawing::layOver(float opacity, const asset::PixelsToAddTo& pixels) const {
    impl_->draw(
        0, impl_->bands(),
        [&](asset::ChordScanner& scanner, int first, std::span<BandChords> bands,
            const asset::ChordPaints& paints) { scanner.layOver(first, bands, paints, opacity, pixels); });
}

}  // namespace vtm::compiler
