// Paper mode: painter's order, clips and the opacity of groups folded into a graph of nodes.

#include "paper/compile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <vtm/asset/container.hpp>
#include "compiler/lower/paints.hpp"
#include "compiler/tree/tree.hpp"
#include "paper/compile/mask.hpp"

namespace vtm::paper {

namespace {

MaskOptions maskOptions(const Asset& asset, const CompileOptions& o) {
    return {{asset.width, asset.height},
            o.tolerance * std::max(asset.width, asset.height),
            o.maxDepth,
            o.mipLog2};
}

/// Of the masks [first, end): their squares lie within.
Bounds boundsOf(const Asset& asset, std::uint32_t first, std::uint32_t end) {
    constexpr double steps = 0xFFFF;
    glm::dvec2 min(1), max(0);
    const glm::dvec2 size(asset.width, asset.height);
    for (std::uint32_t i = first; i < end; ++i) {
        const Mask& mask = asset.masks[i];
        min = glm::min(min, glm::dvec2(mask.x, mask.y) / size);
        max = glm::max(max, (glm::dvec2(mask.x, mask.y) + mask.side) / size);
    }
    const auto stored = [&](double place) { return std::uint16_t(std::clamp(place, 0.0, steps)); };
    return {{stored(std::floor(min.x * steps)), stored(std::floor(min.y * steps))},
            {stored(std::ceil(max.x * steps)), stored(std::ceil(max.y * steps))}};
}

/// The scene's paints as the palette of an asset.
class Palette {
public:
    Palette(asset::Asset& palette, double side)
        : palette_(palette), table_(picture_, {scene::identity, side, side, false}) {
        palette_.paints.push_back({});
    }

    /// A paint of the palette, 0 where nothing can be painted, and whether it hides what lies below.
    struct Added {
        std::uint32_t index = 0;
        bool opaque = false;
    };
    Added add(const scene::Paint& paint, const scene::Affine& transform) {
        const auto index = table_.add(paint, transform);
        if (!index)
            return {};
        const compiler::Source& source = picture_.sources[*index];
        if (source.op == asset::Op::Solid)
            palette_.paints.push_back(std::bit_cast<asset::Paint>(source.color));
        else
            programs_.push_back({std::uint32_t(palette_.paints.size()), source}),
                palette_.paints.push_back({});
        return {std::uint32_t(palette_.paints.size() - 1), source.opaque};
    }

    /// What the programs refer to first, then a program of one instruction for each.
    void finish() {
        palette_.data = std::move(picture_.data);
        palette_.images = compiler::bitmapsOf(picture_);
        palette_.materials = std::move(picture_.materials);
        for (const auto& [paint, source] : programs_) {
            palette_.paints[paint] = {std::uint32_t(palette_.data.size()), 1, 0, asset::programTag};
            const asset::Instruction layer{source.op, asset::Blend::Normal, 1, source.data};
            palette_.data.push_back(std::bit_cast<asset::Texel>(layer));
        }
    }

private:
    asset::Asset& palette_;
    compiler::LoweredScene picture_;
    compiler::PaintTable table_;
    std::vector<std::pair<std::uint32_t, compiler::Source>> programs_;
};

/// What the model cannot say, and what is done instead.
struct Missing {
    std::string what, instead;
    auto operator<=>(const Missing&) const = default;
};

/// Each function returns what shows something over `rest`, or `rest` where nothing is to show.
class Folding {
public:
    explicit Folding(CompileResult& result)
        : result_(result),
          palette_(result.asset.palette, std::max(result.asset.width, result.asset.height)) {}

    void run(const scene::Scene& scene) {
        result_.asset.root = nodeOf(group(scene.root, {}));
        palette_.finish();
        for (const auto& [missing, times] : missing_)
            result_.warnings.push_back(std::string("the paper's model has no ") + missing.what + " (" +
                                       std::to_string(times) + "): " + missing.instead);
    }

private:
    Side group(const scene::Group& g, const Side& rest) {
        if (g.blend != scene::BlendMode::Normal)
            ++missing_[{"blend modes", "drawn as normal"}];
        if (g.filter)
            ++missing_[{"filters", "drawn without"}];
        if (g.mask)
            ++missing_[{"masks by luminance or alpha", "drawn without"}];
        Side inside = sequence(g.children, rest);
        if (inside == rest)
            return rest;
        // A group with normal blending is as if its children stood in its place, so o G + (1 - o) T.
        if (g.opacity < 1)
            inside = push({noIndex, g.opacity, inside, rest});
        return g.clip ? clipped(*g.clip, inside, rest) : inside;
    }

    /// Painter's order. A part of a long sequence stands behind a node that knows its bounds, and so on down.
    Side sequence(std::span<const scene::Node> nodes, Side rest) {
        constexpr std::size_t parts = 4;
        if (nodes.size() <= parts || !result_.options.balanced) {
            for (const scene::Node& node : nodes)
                rest = shown(node, rest);
            return rest;
        }
        for (std::size_t i = 0; i < parts; ++i) {
            const std::size_t first = nodes.size() * i / parts, end = nodes.size() * (i + 1) / parts;
            const auto firstMask = std::uint32_t(result_.asset.masks.size());
            const std::size_t unbounded = withoutMask_;
            const Side inside = sequence(nodes.subspan(first, end - first), rest);
            if (end - first > 1 && inside != rest && unbounded == withoutMask_)
                rest = bounded(inside, rest, firstMask);
            else
                rest = inside;
        }
        return rest;
    }

    Side bounded(const Side& inside, const Side& rest, std::uint32_t firstMask) {
        Node node{noIndex, 1, inside, rest};
        const auto endMask = std::uint32_t(result_.asset.masks.size());
        node.bounds = boundsOf(result_.asset, firstMask, endMask);
        const Side made = push(node);
        result_.bounded.push_back({made.rest, firstMask, endMask});
        return made;
    }

    Side shown(const scene::Node& node, const Side& rest) {
        limits::check();
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return this->item(*item, rest);
        if (const auto* chosen = std::get_if<scene::Select>(&node.value))
            return select(*chosen, rest);
        return group(std::get<scene::Group>(node.value), rest);
    }

    /// The model itself: a mask and two sides.
    Side select(const scene::Select& s, const Side& rest) {
        const Side inside = s.inside ? group(*s.inside, rest) : rest;
        const Side outside = s.outside ? group(*s.outside, rest) : rest;
        if (inside == outside)
            return inside;
        return push({add(maskOf(*s.mask.path, s.mask.transform, s.mask.geometry)), 1, inside, outside});
    }

    /// One that covers the picture needs no mask and, opaque as it is, no node either.
    Side item(const scene::Item& item, const Side& rest) {
        const limits::Stage stage("making the mask of", item.place);
        if (std::holds_alternative<scene::Pattern>(item.paint))
            ++missing_[{"patterns", "not drawn"}];
        const Palette::Added paint = palette_.add(item.paint, item.transform);
        MaskResult made = maskOf(*item.path, item.transform, item.geometry);
        const bool covers = made.coversPicture;
        const std::uint32_t mask = covers ? noIndex : add(std::move(made));
        result_.maskOfItem.push_back(mask);
        withoutMask_ += covers;
        const Side inside = over(paint, rest);
        return covers && item.opacity == 1 ? inside : push({mask, item.opacity, inside, rest});
    }

    /// A paint over what a side shows.
    Side over(const Palette::Added& paint, const Side& rest) {
        if (paint.index == 0)
            return rest;
        return {paint.index, paint.opaque ? noIndex : nodeOf(rest), false};
    }

    /// What a side shows, as a node.
    std::uint32_t nodeOf(const Side& side) {
        return side.paint == 0 ? side.rest : push({noIndex, 1, side, {}}).rest;
    }

    /// Union of the shapes: inside one of them `inside`, otherwise the next one decides.
    Side clipped(const scene::Clip& clip, const Side& inside, const Side& rest) {
        Side result = rest;
        for (const scene::ClipShape& shape : clip.shapes) {
            const Side within = shape.clip ? clipped(*shape.clip, inside, result) : inside;
            result = push({add(maskOf(*shape.path, shape.transform, shape.rule)), 1, within, result});
        }
        return clip.clip && result != rest ? clipped(*clip.clip, result, rest) : result;
    }

    MaskResult maskOf(const scene::Path& path, const scene::Affine& transform,
                      const std::variant<scene::FillRule, scene::StrokeStyle>& geometry) const {
        return makeMask(path, transform, geometry, maskOptions(result_.asset, result_.options));
    }

    std::uint32_t add(MaskResult made) {
        if (result_.asset.masks.size() >= maxMasks)
            throw compiler::LimitError("the picture needs more than " + std::to_string(maxMasks) + " masks");
        cells_ += made.mask.cells.size();
        if (cells_ > maxCells)
            throw compiler::LimitError("the picture needs more than " + std::to_string(maxCells) + " cells");
        result_.asset.masks.push_back(std::move(made.mask));
        result_.approximated.push_back(made.approximated);
        return std::uint32_t(result_.asset.masks.size() - 1);
    }

    Side push(const Node& node) {
        limits::check();
        result_.asset.nodes.push_back(node);
        return {0, std::uint32_t(result_.asset.nodes.size() - 1), false};
    }

    CompileResult& result_;
    Palette palette_;
    std::size_t cells_ = 0;
    std::size_t withoutMask_ = 0;  ///< items that cover the picture
    std::map<Missing, std::size_t> missing_;
};

void checkOptions(const CompileOptions& o) {
    if (!(o.tolerance >= std::ldexp(1.0, -26) && o.tolerance <= std::ldexp(1.0, -6)))
        throw std::invalid_argument(fmt::format("tolerance is {}, not in [2^-26, 2^-6]", o.tolerance));
    if (o.maxDepth > 8)
        throw std::invalid_argument(fmt::format("maxDepth is {}, not in [0, 8]", o.maxDepth));
    if (o.mipLog2 > 10)
        throw std::invalid_argument(fmt::format("mipLog2 is {}, not in [0, 10]", o.mipLog2));
}

}  // namespace

std::size_t CompileResult::approximatedCells() const {
    return std::accumulate(approximated.begin(), approximated.end(), std::size_t(0));
}

CompileResult compile(const scene::Scene& scene, const CompileOptions& options) {
    checkOptions(options);
    scene::validate(scene);
    const auto start = compiler::Clock::now();
    CompileResult result;
    result.options = options;
    result.asset.width = scene.width;
    result.asset.height = scene.height;
    Folding(result).run(scene);
    try {
        validate(result.asset);
    } catch (const asset::FormatError& error) {
        // Trees let more nodes wait than a sequence does.
        if (!result.bounded.empty()) {
            CompileOptions plain = options;
            plain.balanced = false;
            return compile(scene, plain);
        }
        throw compiler::LimitError(std::string("paper mode cannot represent this picture: ") + error.what());
    }
    if (const std::size_t cells = result.approximatedCells(); cells > 0)
        result.warnings.push_back(std::to_string(cells) +
                                  " cells would need more than two pieces and one operator; the best two "
                                  "were kept");
    result.stages = {{"masks", compiler::milliseconds(start, compiler::Clock::now())}};
    return result;
}

void rebuildMask(CompileResult& result, std::size_t item, const scene::Item& changed) {
    const std::uint32_t index = result.maskOfItem.at(item);
    if (index == noIndex)
        throw std::invalid_argument("the item covered the picture, so it has no mask to be made again");
    auto made = makeMask(*changed.path, changed.transform, changed.geometry,
                         maskOptions(result.asset, result.options));
    result.asset.masks[index] = std::move(made.mask);
    result.approximated[index] = made.approximated;
    for (const CompileResult::BoundedNode& b : result.bounded)
        if (index >= b.firstMask && index < b.endMask)
            result.asset.nodes[b.node].bounds = boundsOf(result.asset, b.firstMask, b.endMask);
}

}  // namespace vtm::paper
