#include "compiler/filters/compile_filtered.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluate.hpp>
#include "compiler/filters/append_asset.hpp"
#include "compiler/filters/bounds.hpp"
#include "compiler/filters/filter_records.hpp"
#include "compiler/filters/find_filters.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {
namespace {

using asset::Command;
using geometry::Box;
using scene::Group;
using scene::Node;
using scene::NodeList;

/// What is compiled beside a filter's region, as a share of its size: a pixel of an icon of 8.
constexpr double regionRoom = 1.0 / 8;
/// What is compiled beside the picture, as a share of its size: pixels at its border read beyond it.
constexpr double margin = 1.0 / 64;

/// Of the longer side of the picture, for what is drawn as an image where nothing else is said; and of the
/// image at most.
constexpr double usualBakedPixels = 2048, maxBakedSide = 8192;

void warn(std::string text, Result& result) {
    if (std::ranges::find(result.warnings, text) == result.warnings.end())
        result.warnings.push_back(std::move(text));
}

void checkCommands(std::size_t count) {
    if (count > asset::maxCommands)
        throw LimitError("the picture needs more than " + std::to_string(asset::maxCommands) + " commands");
}

class Planner {
public:
    Planner(const Excerpt& excerpt, const Options& options, const CompilePlain& compilePlain)
        : excerpt_(excerpt),
          options_(options),
          compilePlain_(compilePlain),
          frame_{{0, 0}, {excerpt.width, excerpt.height}} {
        asset::Asset& asset = plan_.commands.asset;
        asset.width = excerpt.width;
        asset.height = excerpt.height;
        asset.mode = options.mode;
        asset.paints.emplace_back();
        asset.finestPixel = 0;
    }

    FilterPlan run(const Group& root) {
        Picture ground{frame_, true};
        content(root, ground);
        return std::move(plan_);
    }

    /// Without filters: what they would make is drawn as images.
    Result runBaked(const Group& root) {
        scene::Scene part;
        part.width = part.height = 1;  // the excerpt says what is drawn
        if (isPlain(root))
            for (const Node& node : root.children)
                part.root.children.push_back(finder_.isIn(node) ? imageOf(node, frame_) : node);
        else
            part.root.children.push_back(imageOf({root}, frame_));
        Result result = compilePlain_(part, excerpt_, options_);
        result.asset.filterPixels = options_.filterPixels;
        result.warnings.push_back("what is filtered is an image, drawn with " +
                                  std::to_string(options_.filterPixels) +
                                  " pixels along the picture's longer side");
        return result;
    }

private:
    /// A picture on the stack, while commands draw on it.
    struct Picture {
        Box seen;                  ///< what of it is needed; in the space of the excerpt
        bool endsAtFrame = false;  ///< what is drawn on it ends where the picture does
        bool isBlank = true;       ///< nothing has been drawn on it
    };

    static bool isPlain(const Group& g) {
        return g.opacity == 1 && g.blend == scene::BlendMode::Normal && !g.clip && !g.mask && !g.filter;
    }
    /// Whether what it does depends on what was drawn on the same picture before.
    static bool blends(const Node& node) {
        const auto* g = std::get_if<Group>(&node.value);
        return g && g->blend != scene::BlendMode::Normal;
    }

    // ---- Commands ----

    Command& emit(Command::Kind kind) {
        auto& commands = plan_.commands.asset.commands;
        checkCommands(commands.size() + 1);
        commands.emplace_back().kind = kind;
        return commands.back();
    }
    void push(Command::Kind kind = Command::Kind::Push, std::uint32_t filter = 0) {
        ++depth_;
        emit(kind).map = filter;
    }
    void pop(Command::Kind kind) {
        --depth_;
        emit(kind);
    }

    // ---- Nodes ----

    void children(const NodeList& nodes, Picture& on) {
        NodeList run;
        for (const Node& node : nodes) {
            limits::check();
            if (finder_.isIn(node)) {
                draw(std::exchange(run, {}), on);
                filtered(node, on);
            } else if (blends(node) && !on.isBlank) {
                draw(std::exchange(run, {}), on);
                group(std::get<Group>(node.value), on);
            } else {
                run.push_back(node);
            }
        }
        draw(std::move(run), on);
    }

    asset::Mode mode() const { return options_.mode; }

    void filtered(const Node& node, Picture& on) {
        if (const auto* g = std::get_if<Group>(&node.value))
            return group(*g, on);
        draw({baked(node, on.seen)}, on);
    }

    /// On the stack while a group is drawn, without the groups in it: its own, its filter's inputs, a factor
    /// and a map that is laid over others.
    static unsigned picturesOf(const Group& g) {
        const auto isPicture = [](const scene::FilterPrimitive& primitive) {
            return std::holds_alternative<scene::PictureFilter>(primitive.operation);
        };
        const auto inputs = g.filter ? 1 + std::ranges::count_if(g.filter->primitives, isPicture) : 0;
        return unsigned(3 + inputs);
    }

    /// What a group shows by itself.
    void content(const Group& g, Picture& on) {
        if (isPlain(g))
            children(g.children, on);
        else
            group(g, on);
    }

    void group(const Group& g, Picture& on) {
        if (depth_ + picturesOf(g) > asset::maxPictures) {
            warn("groups with filters are nested too deep; what would need more than " +
                     std::to_string(asset::maxPictures) + " pictures at once is left out",
                 plan_.commands);
            return;
        }
        push();
        Picture inner{on.seen, on.endsAtFrame};
        if (g.filter)
            filter(*g.filter, g.children, inner);
        else
            children(g.children, inner);
        if (g.clip)
            clip(g.clip, inner);
        if (g.mask)
            mask(*g.mask, inner);
        pop(Command::Kind::Pop);
        Command& last = plan_.commands.asset.commands.back();
        last.opacity = g.opacity;
        last.blend = static_cast<asset::Blend>(g.blend);
        on.isBlank = false;
    }

    /// What a filter makes of nodes, on a blank picture.
    void filter(const scene::Filter& f, const NodeList& nodes, Picture& on) {
        const std::uint32_t index = appendFilter(f, excerpt_.fromScene, plan_.commands.asset);
        push(Command::Kind::PushInput, index);
        Picture source{readBy(f, on.seen)};
        children(nodes, source);
        std::uint32_t inputs = 1;
        for (const scene::FilterPrimitive& primitive : f.primitives)
            if (const auto* picture = std::get_if<scene::PictureFilter>(&primitive.operation)) {
                push(Command::Kind::PushInput, index);
                Picture input{readBy(f, on.seen)};
                content(*picture->content, input);
                ++inputs;
            }
        emit(Command::Kind::Filter).map = index;
        depth_ -= inputs - 1;
        pop(Command::Kind::Pop);
        const scene::Affine toExcerpt = scene::compose(excerpt_.fromScene, f.transform);
        if (on.endsAtFrame && !frame_.contains(geometry::mapped({f.min, f.max}, toExcerpt)))
            cutToFrame();
        on.isBlank = false;
    }

    /// What a filter reads to find what is seen of its result.
    Box readBy(const scene::Filter& f, const Box& seen) const {
        const scene::Affine toExcerpt = scene::compose(excerpt_.fromScene, f.transform);
        // The filter cuts its region's border pixels off itself; they are whole here, however large they are.
        const scene::Point room = regionRoom * (f.max - f.min);
        const Box region = geometry::mapped({f.min - room, f.max + room}, toExcerpt);
        const scene::Point reach = reachOf(f);
        if (!(std::isfinite(reach.x) && std::isfinite(reach.y)))
            return region;
        const scene::Point across = glm::abs(toExcerpt[0]) * reach.x + glm::abs(toExcerpt[1]) * reach.y;
        const scene::Point more = across + margin * (seen.max - seen.min);
        return region.intersection({seen.min - more, seen.max + more});
    }

    void clip(const scene::Link<scene::Clip>& shapes, const Picture& of) {
        Group white;
        white.children.push_back(whiteBox(around(of.seen)));
        white.clip = shapes;
        push();
        Picture factor{around(of.seen)};
        draw({Node{std::move(white)}}, factor);
        pop(Command::Kind::PopMaskAlpha);
    }

    void mask(const scene::Mask& m, const Picture& of) {
        push();
        Picture factor{around(of.seen)};
        content(*m.content, factor);
        pop(m.kind == scene::MaskKind::Alpha ? Command::Kind::PopMaskAlpha
            : m.linear                       ? Command::Kind::PopMaskLinear
                                             : Command::Kind::PopMaskLuminance);
    }

    /// Factors are whole where what they multiply ends.
    static Box around(const Box& seen) {
        const scene::Point more = margin * (seen.max - seen.min);
        return {seen.min - more, seen.max + more};
    }

    /// What a filter draws beyond the picture is not part of it.
    void cutToFrame() {
        push();
        Picture factor{frame_};
        draw({whiteBox(frame_)}, factor);
        pop(Command::Kind::PopMaskAlpha);
    }

    /// A box of the excerpt's space.
    Node whiteBox(const Box& box) const {
        const scene::Affine toScene = *scene::inverse(excerpt_.fromScene);
        return {scene::Item{std::make_shared<const scene::Path>(scene::rectangle(box.min, box.max)), toScene,
                            scene::FillRule::NonZero, scene::Color{1, 1, 1, 1}}};
    }

    // ---- Pictures without filters ----

    void draw(NodeList nodes, Picture& on) {
        if (nodes.empty())
            return;
        PlainPart part{std::move(nodes), {}, on.seen, {}};
        part.content = boundsOf(part.nodes, excerpt_.fromScene).intersection(on.seen);
        const std::optional<Box> frame = frameOf(part.content, on.seen);
        if (!frame)
            return;
        part.frame = *frame;
        const bool onTop = mode() == asset::Mode::Compat || on.isBlank;
        if (!onTop)
            push();
        emit(Command::Kind::DrawMap).map = static_cast<std::uint32_t>(plan_.parts.size());
        if (!onTop)
            pop(Command::Kind::Pop);
        plan_.parts.push_back(std::move(part));
        on.isBlank = false;
    }

    /// Nothing if that is no picture.
    static std::optional<Box> frameOf(const Box& content, const Box& seen) {
        if (content.empty() || !std::isfinite(content.width()) || !std::isfinite(content.height()))
            return std::nullopt;
        // Some room, so that no outline lies on the border of its map.
        const scene::Point room(std::max({content.width(), content.height(), 64 * scene::minSide}) / 64);
        const Box frame = Box{content.min - room, content.max + room}.intersection(seen);
        const bool isPicture = std::max(frame.width(), frame.height()) <= scene::maxSide &&
                               std::min(frame.width(), frame.height()) >= scene::minSide;
        return isPicture ? std::optional(frame) : std::nullopt;
    }

    // ---- Where a filter cannot be a command ----

    /// Patterns and selections are drawn in many places, or by a rule of their own: what is filtered in them
    /// is drawn once, as an image.
    Node baked(const Node& node, const Box& seen) {
        Node copy = node;
        if (auto* item = std::get_if<scene::Item>(&copy.value)) {
            auto& pattern = std::get<scene::Pattern>(item->paint);
            const scene::Affine toExcerpt =
                scene::compose(excerpt_.fromScene, scene::compose(item->transform, pattern.transform));
            pattern.content = baked(*pattern.content, {pattern.min, pattern.max}, toExcerpt);
        }
        if (auto* select = std::get_if<scene::Select>(&copy.value)) {
            const Box box = geometry::mapped(seen, *scene::inverse(excerpt_.fromScene));
            for (scene::Link<Group>* side : {&select->inside, &select->outside})
                if (*side && finder_.isIn(**side))
                    *side = baked(**side, box, excerpt_.fromScene);
        }
        return copy;
    }

    /// A node that is an image of what of another lies in the box, blended as that.
    Node imageOf(const Node& node, const Box& seen) {
        Node copy = node;
        scene::BlendMode blend = scene::BlendMode::Normal;
        if (auto* group = std::get_if<Group>(&copy.value))
            blend = std::exchange(group->blend, scene::BlendMode::Normal);
        Group content;
        content.children.push_back(std::move(copy));
        const Box drawn = boundsOf(content.children, excerpt_.fromScene).intersection(seen);
        Group image;
        image.blend = blend;
        if (!drawn.empty())
            image.children = baked(content, geometry::mapped(drawn, *scene::inverse(excerpt_.fromScene)),
                                   excerpt_.fromScene)
                                 ->children;
        return {std::move(image)};
    }

    /// An image of what of a group lies in the box. `toExcerpt`: from the space of the group.
    scene::Link<Group> baked(const Group& content, const Box& box, const scene::Affine& toExcerpt) {
        const auto lengthOf = [](scene::Point v) { return std::hypot(v.x, v.y); };
        const double baked = options_.filterPixels > 0 ? options_.filterPixels : usualBakedPixels;
        const double pixels = baked / std::max(excerpt_.width, excerpt_.height);
        const auto side = [&](double length, scene::Point axis) {
            return std::clamp(std::ceil(length * lengthOf(axis) * pixels), 1.0, maxBakedSide);
        };
        const scene::Point size(side(box.width(), toExcerpt[0]), side(box.height(), toExcerpt[1]));
        scene::Scene part;
        part.width = part.height = 1;
        part.root.children.push_back({content});
        const Excerpt excerpt = inPixels(box.min, box.max, size);
        Options options = options_;
        options.filterPixels = 0;
        const Result drawn = compileFiltered(part, excerpt, options, compilePlain_);
        scene::ImagePaint paint;
        paint.bitmap = std::make_shared<const image::Bitmap>(
            image::toBitmap(asset::evaluate(drawn.asset, {int(size.x), int(size.y)})));
        auto image = std::make_shared<Group>();
        image->children.push_back(
            {scene::Item{std::make_shared<const scene::Path>(scene::rectangle({0, 0}, size)),
                         *scene::inverse(excerpt.fromScene), scene::FillRule::NonZero, std::move(paint)}});
        return image;
    }

    const Excerpt& excerpt_;
    const Options& options_;
    const CompilePlain& compilePlain_;
    FilterPlan plan_;
    FilterFinder finder_;
    const Box frame_;
    unsigned depth_ = 1;  ///< pictures on the stack
};

/// Puts the pictures of parts where commands draw them.
class Joiner {
public:
    Joiner(Result commands, std::span<const PlainPart> parts, const Excerpt& excerpt)
        : commands_(std::exchange(commands.asset.commands, {})),
          parts_(parts),
          longerSide_(std::max(excerpt.width, excerpt.height)),
          result_(std::move(commands)) {}

    Result run(const std::function<const Result&(std::size_t)>& pictureOf) {
        for (const Command& command : commands_)
            if (command.kind == Command::Kind::DrawMap)
                add(pictureOf(command.map), parts_[command.map].frame.min);
            else
                result_.asset.commands.push_back(command);
        checkCommands(result_.asset.commands.size());
        return std::move(result_);
    }

private:
    void add(const Result& drawn, scene::Point by) {
        const double longer = std::max(drawn.asset.width, drawn.asset.height);
        result_.provenError = std::max(result_.provenError, drawn.provenError * longer / longerSide_);
        result_.asset.finestPixel = std::max(*result_.asset.finestPixel, drawn.asset.finestPixel.value_or(0));
        result_.asset.fallbackLeaves += drawn.asset.fallbackLeaves;
        result_.sampledStrokes += drawn.sampledStrokes;
        for (const UnprovenSquare& square : drawn.unproven)
            result_.unproven.push_back({square.x + by.x, square.y + by.y, square.side});
        for (const std::string& warning : drawn.warnings)
            warn(warning, result_);
        addTimes(drawn.stages);
        appendAsset(drawn.asset, by, result_.asset);
    }

    void addTimes(const std::vector<StageTime>& stages) {
        if (result_.stages.empty())
            result_.stages = stages;
        else
            for (std::size_t i = 0; i < stages.size(); ++i)
                result_.stages[i].milliseconds += stages[i].milliseconds;
    }

    const std::vector<Command> commands_;
    const std::span<const PlainPart> parts_;
    const double longerSide_;  ///< of the excerpt
    Result result_;
};

/// Parts are compiled several at a time, by all processors.
class PartsAhead {
public:
    PartsAhead(std::span<const PlainPart> parts, const Excerpt& excerpt, const Options& options,
               const CompilePlain& compilePlain)
        : parts_(parts), excerpt_(excerpt), options_(options), compilePlain_(compilePlain) {}

    /// Once each, in their order.
    const Result& take(std::size_t part) {
        if (part >= first_ + made_.size())
            makeFrom(part);
        return made_[part - first_];
    }

private:
    void makeFrom(std::size_t first) {
        const auto most = std::size_t(4 * tbb::this_task_arena::max_concurrency());
        first_ = first;
        made_ = std::vector<Result>(std::min(most, parts_.size() - first));
        tbb::parallel_for(std::size_t{0}, made_.size(), [&, holding = limits::current()](std::size_t i) {
            const limits::Scope scope(holding);
            const PartPicture picture = pictureOf(parts_[first_ + i], excerpt_, options_);
            made_[i] = compilePlain_(picture.scene, picture.excerpt, picture.options);
        });
    }

    const std::span<const PlainPart> parts_;
    const Excerpt& excerpt_;
    const Options& options_;
    const CompilePlain& compilePlain_;
    std::size_t first_ = 0;
    std::vector<Result> made_;  ///< of the parts from the first on
};

}  // namespace

bool hasFilters(const scene::Scene& scene) { return FilterFinder().isIn(scene.root); }

FilterPlan planFiltered(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                        const CompilePlain& compilePlain) {
    return Planner(excerpt, options, compilePlain).run(scene.root);
}

PartPicture pictureOf(const PlainPart& part, const Excerpt& excerpt, const Options& options) {
    PartPicture picture{{1, 1, {}}, excerpt, options};
    picture.scene.root.children = part.nodes;
    picture.excerpt.fromScene[2] -= part.frame.min;
    picture.excerpt.width = part.frame.width();
    picture.excerpt.height = part.frame.height();
    const double longer = std::max(picture.excerpt.width, picture.excerpt.height);
    picture.options.tolerance =
        std::clamp(options.tolerance * std::max(excerpt.width, excerpt.height) / longer, std::ldexp(1.0, -26),
                   std::ldexp(1.0, -6));
    return picture;
}

Result joinParts(Result commands, std::span<const PlainPart> parts, const Excerpt& excerpt,
                 const std::function<const Result&(std::size_t)>& pictureOf) {
    return Joiner(std::move(commands), parts, excerpt).run(pictureOf);
}

Result compileFiltered(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                       const CompilePlain& compilePlain) {
    if (options.filterPixels > 0)
        return Planner(excerpt, options, compilePlain).runBaked(scene.root);
    FilterPlan plan = planFiltered(scene, excerpt, options, compilePlain);
    PartsAhead pictures(plan.parts, excerpt, options, compilePlain);
    return joinParts(std::move(plan.commands), plan.parts, excerpt,
                     [&](std::size_t part) -> const Result& { return pictures.take(part); });
}

}  // namespace vtm::compiler
