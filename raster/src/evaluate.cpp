#include <vtm/raster/evaluate.hpp>

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "raster/blend.hpp"
#include "raster/drawing_threads.hpp"
#include "raster/filter/run_filter.hpp"
#include "raster/src/canvas.hpp"
#include "raster/src/command_stack.hpp"
#include "raster/src/draw_map.hpp"
#include "raster/src/filter_results.hpp"
#include "raster/src/map_scanner.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/rough.hpp"

namespace vtm::asset {

namespace {

using glm::vec2;
using image::Raster;

/// Share of each pixel of a box that a map covers.
struct Mask {
    PixelBox box;
    Raster coverage;

    /// Of a pixel of the box.
    float at(int x, int y) const { return unit(coverage.pixel(x - box.min.x, y - box.min.y)[0]); }
    /// From the first to the last pixel of a row that is covered.
    PixelRun covered(int y) const {
        if (y < box.min.y || y >= box.max.y)
            return {};
        PixelRun run{box.min.x, box.max.x};
        while (!run.empty() && at(run.first, y) == 0)
            ++run.first;
        while (!run.empty() && at(run.end - 1, y) == 0)
            --run.end;
        return run;
    }
};

Mask coverageOf(const Paints& paints, const Map& map, const View& view) {
    const PixelBox box = pixelsOf(view, placeOf(map));
    const View cropped = crop(view, box);
    Mask mask{box, Raster(cropped.width, cropped.height)};
    addCoverage(paints, map, cropped, mask.coverage);
    return mask;
}

/// Pixels to places of the picture.
class PixelCentres {
public:
    explicit PixelCentres(const View& view)
        : linear_(view.toPixels[0], view.toPixels[1]), origin_(view.toPixels[2]) {
        linear_ = glm::inverse(linear_);
    }
    PaintPlace operator()(int x, int y) const {
        return {vec2(linear_ * (glm::dvec2(x + 0.5, y + 0.5) - origin_)), glm::mat2(linear_)};
    }

private:
    glm::dmat2 linear_;
    glm::dvec2 origin_;
};

void fillMask(const Paints& paints, const Command& command, const MaterialFunction& materials, Canvas& top) {
    const Mask mask = coverageOf(paints, paints.asset().maps[command.map], top.view());
    if (mask.box.empty())
        return;
    const PixelCentres centre(top.view());
    top.reserve(mask.box);
    for (int y = mask.box.min.y; y < mask.box.max.y; ++y) {
        const PixelRun run = mask.covered(y);
        if (run.empty())
            continue;
        Float4* pixel = top.extend(y, run);
        for (int x = run.first; x < run.end; ++x, ++pixel)
            if (const float coverage = mask.at(x, y); coverage > 0)
                *pixel =
                    over(coverage * float4(paints.color(command.paint, centre(x, y), materials)), *pixel);
    }
}

void clipMask(const Paints& paints, const Command& command, Canvas& top) {
    const Mask mask = coverageOf(paints, paints.asset().maps[command.map], top.view());
    top.restrict([&](int y, const PixelRun& run) {
        const PixelRun kept = run.intersection(mask.covered(y));
        for (int x = kept.first; x < kept.end; ++x)
            *top.at(y, x) *= mask.at(x, y);
        return kept;
    });
}

Op maskOp(Command::Kind kind) {
    switch (kind) {
        case Command::Kind::PopMaskLuminance:
            return Op::PopMaskLuminance;
        case Command::Kind::PopMaskLinear:
            return Op::PopMaskLinear;
        default:
            return Op::PopMaskAlpha;
    }
}

void composite(Canvas&& source, const Command& command, Canvas& top) {
    // On nothing, every blend mode shows the source.
    if (top.empty() && command.opacity == 1)
        top = std::move(source);
    else if (command.blend == Blend::Normal)
        combine(source, top, [&](Float4 b, Float4 s) { return over(command.opacity * s, b); });
    else
        combine(source, top, [&](Float4 b, Float4 s) {
            return float4(blend(command.blend, command.opacity * toVec4(s), toVec4(b)));
        });
}

/// Where the mask has no pixels, nothing is left.
void applyMask(const Canvas& mask, Op op, Canvas& top) {
    top.restrict([&](int y, const PixelRun& run) {
        const PixelRun kept = run.intersection(mask.run(y));
        for (int x = kept.first; x < kept.end; ++x) {
            const Float4 factor = *mask.at(y, x);
            *top.at(y, x) *= op == Op::PopMaskAlpha ? factor[3] : maskFactor(op, toVec4(factor));
        }
        return kept;
    });
}

/// Where results of filters are kept.
struct Keeping {
    FilterResults* results = nullptr;
    PixelBox box{};          ///< what is drawn of their view
    bool usesKnown = false;  ///< else all are made anew
};

/// The pictures that commands draw into.
class PictureStack {
public:
    /// `maps`: draws them; without it their leaves are added up.
    PictureStack(const Paints& paints, const View& view, const MaterialFunction& materials, int levels,
                 const MapDrawer* maps, const Keeping& keeping)
        : paints_(paints), materials_(materials), levels_(levels), maps_(maps), keeping_(keeping) {
        push(view);
    }

    /// What is pushed does not depend on what is below: several such pictures are drawn at once, and then
    /// popped in their order.
    void execute(std::span<const Command> commands) {
        PushedPictures ahead;
        while (!commands.empty()) {
            limits::check();
            std::size_t done = 1;
            if (maps_ && laysMap(commands)) {
                layMap(commands[1], commands[2].opacity);
                done = 3;
            } else if (mayDrawAhead() && countToPop(commands) > 0) {
                if (ahead.empty())
                    ahead = drawAhead(commands);
                pictures_.push_back({std::move(ahead.front().canvas)});
                pop(ahead.front().pop());
                done = ahead.front().commands.size();
                ahead.pop_front();
            } else if (keeping_.results && commands[0].kind == Command::Kind::PushInput && isAtRoot()) {
                done = keepFiltered(commands);
            } else {
                execute(commands[0]);
            }
            commands = commands.subspan(done);
        }
    }
    Canvas take() { return std::move(top().canvas); }

private:
    struct Picture {
        Canvas canvas;
        /// Of an input of a filter: where that works, and the input's number.
        std::shared_ptr<const FilterPlace> place = nullptr;
        std::uint32_t filter = 0, number = 0;
    };

    void execute(const Command& command) {
        switch (command.kind) {
            case Command::Kind::DrawMap:
                return drawMap(command);
            case Command::Kind::FillMask:
                return fillMask(paints_, command, materials_, top().canvas);
            case Command::Kind::ClipMask:
                return clipMask(paints_, command, top().canvas);
            case Command::Kind::Push:
                return push(top().canvas.view());
            case Command::Kind::PushInput:
                return pushInput(command.map);
            case Command::Kind::Filter:
                return filter(paints_.asset().filters[command.map]);
            default:
                return pop(command);
        }
    }
    Picture& top() { return pictures_.back(); }
    void push(const View& view) { pictures_.push_back({Canvas(view)}); }

    // ---- Several pictures at once ----

    /// From what pushes a picture, or the first input of a filter, to what pops it or the filter's result.
    struct PushedPicture {
        std::span<const Command> commands;
        Canvas canvas;

        const Command& pop() const { return commands.back(); }
        /// Those that make it, on a stack of its own.
        std::span<const Command> inner() const {
            const bool isFiltered = commands[0].kind == Command::Kind::PushInput;
            return commands.subspan(isFiltered ? 0 : 1, commands.size() - (isFiltered ? 1 : 2));
        }
    };
    using PushedPictures = std::deque<PushedPicture>;

    /// Of those that do not push: whether the same picture is on top afterwards.
    static bool staysOnTop(const Command& command) {
        switch (command.kind) {
            case Command::Kind::DrawMap:
            case Command::Kind::FillMask:
            case Command::Kind::ClipMask:
                return true;
            default:
                return false;
        }
    }
    /// How many commands there are from the first, if that pushes a picture by itself, to that which pops
    /// it; else 0.
    std::size_t countToPop(std::span<const Command> commands) const {
        const bool isInput = commands[0].kind == Command::Kind::PushInput;
        if (commands[0].kind != Command::Kind::Push && !(isInput && !pictures_.back().place))
            return 0;
        int pictures = 0;
        for (std::size_t i = 0; i < commands.size(); ++i)
            if (pictures += picturesPushed(paints_.asset(), commands[i]); pictures == 0)
                return i + 1;
        return 0;
    }

    /// Materials are the caller's functions, which may be made for one thread.
    bool mayDrawAhead() const { return !materials_ && tbb::this_task_arena::max_concurrency() > 1; }

    /// Of the inputs of that of the commands' filters which needs most.
    std::size_t inputPixels(std::span<const Command> commands, const View& below) const {
        const AssetView& asset = paints_.asset();
        std::size_t most = 0;
        for (const Command& command : commands) {
            if (command.kind != Command::Kind::Filter)
                continue;
            std::size_t pixels = 0;
            for (const PixelBox& picture : placeOf(asset, asset.filters[command.map], below).pictures)
                pixels += picture.area();
            most = std::max(most, pixels);
        }
        return most;
    }

    /// The next of those that are pushed on the top picture, each by a thread if they are large. Filters take
    /// a dozen times their inputs' memory: of several that are at work together no more than of one that has
    /// the whole picture.
    PushedPictures drawAhead(std::span<const Command> commands) const {
        const auto most = std::size_t(8 * tbb::this_task_arena::max_concurrency());
        const View& view = pictures_.back().canvas.view();
        PushedPictures pushed;
        std::size_t pixels = 0;
        while (!commands.empty() && pushed.size() < most) {
            std::size_t count = 1;
            if (maps_ && laysMap(commands)) {
                count = 3;
            } else if (const std::size_t toPop = countToPop(commands)) {
                count = toPop;
                pixels += inputPixels(commands.first(count), view);
                if (!pushed.empty() && pixels > pixelsIn(view))
                    break;
                pushed.push_back({commands.first(count), Canvas(view)});
            } else if (!staysOnTop(commands[0])) {
                break;
            }
            commands = commands.subspan(count);
        }
        const auto draw = [&, holding = limits::current()](std::size_t i) {
            const limits::Scope scope(holding);
            PictureStack stack(paints_, view, materials_, levels_, maps_, isAtRoot() ? keeping_ : Keeping{});
            stack.execute(pushed[i].inner());
            pushed[i].canvas = stack.take();
        };
        if (areThreadsWorthIt(pushed.size() * pixelsIn(view), true, 0))
            tbb::parallel_for(std::size_t{0}, pushed.size(), draw);
        else
            for (std::size_t i = 0; i < pushed.size(); ++i)
                draw(i);
        return pushed;
    }

    // ---- Maps ----

    /// Calls draw(view, pixels) for what of the top picture a map may cover.
    template <class Draw>
    void onTop(const Command& command, Draw&& draw) {
        Canvas& canvas = top().canvas;
        const PixelBox box = pixelsOf(canvas.view(), placeOf(paints_.asset().maps[command.map]));
        if (box.empty())
            return;
        canvas.reserve(box);
        draw(crop(canvas.view(), box), [&](int y, int first, int end) {
            return reinterpret_cast<float*>(
                canvas.extend(y + box.min.y, {first + box.min.x, end + box.min.x}));
        });
    }

    void drawMap(const Command& command) {
        onTop(command, [&](const View& view, const PixelsToAddTo& pixels) {
            if (maps_)
                maps_->add(command, view, pixels, materials_);
            else
                sum(command, view, pixels);
        });
    }

    /// Whether what comes is a map on a picture of its own, which needs none.
    static bool laysMap(std::span<const Command> commands) {
        return commands.size() >= 3 && commands[0].kind == Command::Kind::Push &&
               commands[1].kind == Command::Kind::DrawMap && commands[2].kind == Command::Kind::Pop &&
               commands[2].blend == Blend::Normal;
    }
    void layMap(const Command& command, float opacity) {
        onTop(command, [&](const View& view, const PixelsToAddTo& pixels) {
            maps_->layOver(command, opacity, view, pixels, materials_);
        });
    }

    void sum(const Command& command, const View& view, const PixelsToAddTo& pixels) {
        const Paints paints = paints_.from(command.paint);
        Raster drawn(view.width, view.height);
        addColors(paints, paints.asset().maps[command.map], view, materials_, levels_, drawn);
        for (int y = 0; y < view.height; ++y) {
            const float* from = drawn.pixel(0, y);
            float* to = pixels(y, 0, view.width);
            for (int i = 0; i < 4 * view.width; ++i)
                to[i] += from[i];
        }
    }

    // ---- Groups and filters ----

    void pop(const Command& command) {
        Canvas source = std::move(top().canvas);
        pictures_.pop_back();
        if (command.kind == Command::Kind::Pop)
            composite(std::move(source), command, top().canvas);
        else
            applyMask(source, maskOp(command.kind), top().canvas);
    }

    void pushInput(std::uint32_t index) {
        const AssetView& asset = paints_.asset();
        const Picture& last = top();
        const bool goesOn =
            last.place && last.filter == index && last.number + 1 < asset.filters[index].pictures;
        const auto place = goesOn ? last.place
                                  : std::make_shared<const FilterPlace>(
                                        placeOf(asset, asset.filters[index], last.canvas.view()));
        const std::uint32_t number = goesOn ? last.number + 1 : 0;
        push(place->viewOf(number));
        top().place = place;
        top().filter = index;
        top().number = number;
    }

    void filter(const Filter& filter) {
        const auto place = top().place;
        std::vector<Canvas> inputs;
        for (auto from = pictures_.end() - std::ptrdiff_t(filter.pictures); from != pictures_.end(); ++from)
            inputs.push_back(std::move(from->canvas));
        for (std::uint32_t i = 0; i < filter.pictures; ++i)
            pictures_.pop_back();
        pictures_.push_back(
            {runFilter(paints_.asset(), filter, *place, std::move(inputs), top().canvas.view())});
    }

    /// Whether what is pushed now is not for a filter: it has the view of what is drawn.
    bool isAtRoot() const {
        return std::ranges::none_of(pictures_, [](const Picture& picture) { return bool(picture.place); });
    }

    /// Pushes the result of the filter whose first input the commands push. Returns how many they are.
    std::size_t keepFiltered(std::span<const Command> commands) {
        const AssetView& asset = paints_.asset();
        const auto first = std::size_t(commands.data() - asset.commands.data());
        const std::span<const Command> all = filteredBy(asset, commands);
        const View below = top().canvas.view();
        if (keeping_.usesKnown)
            if (auto known = keeping_.results->find(first, keeping_.box, below)) {
                pictures_.push_back({std::move(*known)});
                return all.size();
            }
        execute(all[0]);
        execute(all.subspan(1));
        const View& view = keeping_.results->view();
        const FilterPlace place = placeOf(asset, asset.filters[all[0].map], view);
        keeping_.results->put(first, shownOf(place, view), keeping_.box, top().canvas);
        return all.size();
    }

    const Paints& paints_;
    const MaterialFunction& materials_;
    const int levels_;
    const MapDrawer* const maps_;
    const Keeping keeping_;
    std::vector<Picture> pictures_;
};

/// Rough pixels so many levels finer.
Canvas drawn(const Paints& paints, const View& view, const MaterialFunction& materials, int levels,
             const MapDrawer* maps = nullptr, const Keeping& keeping = {}) {
    validate(view);
    const BlocksOfDrawing blocks;
    PictureStack stack(paints, view, materials, levels, maps, keeping);
    stack.execute(paints.asset().commands);
    return stack.take();
}

}  // namespace

Raster evaluate(const AssetView& asset, const View& view, const MaterialFunction& materials) {
    return Evaluator(asset).draw(view, materials);
}

Raster evaluateAsShaders(const AssetView& asset, const View& view, const MaterialFunction& materials) {
    return drawn(Paints(asset), view, materials, 0).toRaster();
}

struct Evaluator::Impl {
    Impl(const AssetView& asset, const EvaluatorOptions& of) : options(of), paints(asset) {
        // Faster where maps are seen whole.
        if (!asset.filters.empty())
            scanner.emplace(paints);
    }
    Impl(const AssetView& asset, Impl&& last, const Difference& difference)
        : options(last.options),
          paints(difference.images
                     ? Paints(asset)
                     : Paints(asset, std::make_shared<const Images>(asset, last.paints.images()))) {
        if (asset.filters.empty())
            return;
        if (!last.scanner) {
            scanner.emplace(paints);
            return;
        }
        scanner.emplace(paints, std::move(*last.scanner), difference.maps);
        results = std::move(last.results);
        if (results)
            results->update(asset, difference);
    }

    Canvas draw(const View& view, const MaterialFunction& materials) const {
        if (!options.keepsFilterResults || !scanner || materials)
            return draw(view, materials, {});
        validate(view);
        auto made = std::make_shared<FilterResults>(paints.asset(), view);
        share(nullptr);  // first, so that there are never two
        Canvas canvas = draw(view, materials, {made.get(), {{0, 0}, {view.width, view.height}}, false});
        share(std::move(made));
        return canvas;
    }
    Canvas drawBox(const View& view, const PixelBox& box, const MaterialFunction& materials) const {
        const std::shared_ptr<FilterResults> known = sharedResults();
        const bool isOfView = known && !materials && known->isOf(view);
        return draw(crop(view, box), materials, isOfView ? Keeping{known.get(), box, true} : Keeping{});
    }

private:
    Canvas draw(const View& view, const MaterialFunction& materials, const Keeping& keeping) const {
        return drawn(paints, view, materials, finerLevels(paints.asset(), view),
                     scanner ? &*scanner : nullptr, keeping);
    }
    void share(std::shared_ptr<FilterResults> made) const {
        const std::lock_guard lock(mutex);
        results.swap(made);
    }
    std::shared_ptr<FilterResults> sharedResults() const {
        const std::lock_guard lock(mutex);
        return results;
    }

    const EvaluatorOptions options;
    const Paints paints;
    std::optional<MapScanner> scanner;               ///< where there are filters
    mutable std::mutex mutex;                        ///< guards `results`
    mutable std::shared_ptr<FilterResults> results;  ///< of the view that was drawn last
};

Evaluator::Evaluator(const AssetView& asset) : Evaluator(asset, {}) {}
Evaluator::Evaluator(const AssetView& asset, const EvaluatorOptions& options)
    : impl_(std::make_unique<Impl>(asset, options)) {}
Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

void Evaluator::update(const AssetView& asset, const Difference& difference) {
    impl_ = std::make_unique<Impl>(asset, std::move(*impl_), difference);
}

Raster Evaluator::draw(const View& view, const MaterialFunction& materials) const {
    return impl_->draw(view, materials).toRaster();
}

void Evaluator::draw(const View& view, const ByteTarget& target, const MaterialFunction& materials) const {
    impl_->draw(view, materials).toBytes(target);
}

void Evaluator::drawBox(const View& view, const PixelBox& box, const ByteTarget& target,
                        const MaterialFunction& materials) const {
    validate(view);
    const PixelBox seen = box.intersection({{0, 0}, {view.width, view.height}});
    if (!seen.empty())
        impl_->drawBox(view, seen, materials).toBytes(partOf(target, seen));
}

void Evaluator::scan(const View& view, const std::function<void(std::span<const float>)>& take,
                     const MaterialFunction& materials) const {
    impl_->draw(view, materials).giveRows(0, view.height, take);
}

struct CommandPicture::Impl {
    const Canvas canvas;
};

CommandPicture::CommandPicture(const AssetView& asset, const View& view, const MapDrawer& maps)
    : impl_(new Impl{drawn(Paints(asset), view, {}, finerLevels(asset, view), &maps)}) {}
CommandPicture::~CommandPicture() = default;
CommandPicture::CommandPicture(CommandPicture&&) noexcept = default;
CommandPicture& CommandPicture::operator=(CommandPicture&&) noexcept = default;

void CommandPicture::draw(const ByteTarget& target) const { impl_->canvas.toBytes(target); }

Raster CommandPicture::draw() const { return impl_->canvas.toRaster(); }

void CommandPicture::giveRows(int first, int end,
                              const std::function<void(std::span<const float>)>& take) const {
    impl_->canvas.giveRows(first, end, take);
}

}  // namespace vtm::asset
