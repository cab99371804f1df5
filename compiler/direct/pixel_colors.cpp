#include "compiler/direct/pixel_colors.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <glm/common.hpp>

#include "compiler/lower/walk_items.hpp"
#include "compiler/paint/composite.hpp"
#include "raster/blend.hpp"

namespace vtm::compiler {
namespace {

using Float4 = float __attribute__((vector_size(16)));

glm::vec4 vectorOf(Float4 color) { return std::bit_cast<glm::vec4>(color); }

Float4 over(Float4 source, Float4 backdrop) { return source + (1 - source[3]) * backdrop; }

/// A group, or a mask.
Float4 laidOver(const LoweredGroup& group, Float4 source, Float4 below) {
    if (group.role != GroupRole::Plain)
        return maskFactor(group.role, vectorOf(source)) * below;
    if (group.blend == scene::BlendMode::Normal)
        return over(group.opacity * source, below);
    return std::bit_cast<Float4>(
        asset::blend(blendOf(group.blend), group.opacity * vectorOf(source), vectorOf(below)));
}

}  // namespace

/// Composites parts from the bottom, with their groups round them.
template <std::size_t quarters>
class PixelColors::Groups {
public:
    explicit Groups(const LoweredScene& picture) : picture_(picture), walk_(picture, *this), open_(1) {}

    void add(const LoweredItem& item, const Quarters& colors) {
        colors_ = &colors;
        walk_.item(item);
    }
    Quarters finish() {
        walk_.finish();
        return open_.front();
    }

    void open(std::uint32_t) { open_.emplace_back(); }
    void item(const LoweredItem&) {
        Quarters& below = open_.back();
        for (std::size_t i = 0; i < quarters; ++i)
            below[i] = over((*colors_)[i], below[i]);
    }
    void emptyMask(std::uint32_t) { open_.back() = {}; }
    void close(std::uint32_t group) {
        const Quarters source = open_.back();
        open_.pop_back();
        for (std::size_t i = 0; i < quarters; ++i)
            open_.back()[i] = laidOver(picture_.groups[group], source[i], open_.back()[i]);
    }

private:
    const LoweredScene& picture_;
    ItemWalk<Groups> walk_;
    std::vector<Quarters> open_;
    const Quarters* colors_ = nullptr;
};

void PixelColors::beginRow(int row) {
    if (!sources_)
        make();
    row_ = row;
    for (Pixel& pixel : pixels_) {
        pixel.layers.clear();
        pixel.parts.clear();
        pixel.below = {};
        pixel.isSteep = false;
        pixel.isLaidOver = true;
        pixel.known.fill({});
    }
}

void PixelColors::add(const RegionState& state, std::uint32_t layer, std::int32_t first, std::int32_t end,
                      bool inParts) {
    if (state.isOfClip(layer))
        return;
    const LayerCover& cover = state.cover(layer);
    const Source& source = sourceOf(layer);
    const bool isSteep = source.op != asset::Op::Solid && sources_->isSteep[source.data] != 0;
    inParts = inParts || state.isClipped(layer);
    end = std::min(end, std::int32_t(pixels_.size()));
    for (std::int32_t x = std::max(first, 0); x < end; ++x) {
        Pixel& pixel = pixels_[std::size_t(x)];
        if (cover.mayBeHidden && pixel.below.light() <= unseen)
            continue;
        pixel.layers.push_back({layer, inParts});
        pixel.isSteep = pixel.isSteep || isSteep;
        pixel.isLaidOver = pixel.isLaidOver && state.isLaidOver(layer);
        if (!inParts)
            pixel.below.add(cover);
    }
}

glm::vec4 PixelColors::color(const RegionState& state, const PixelPlace& place) {
    Pixel& pixel = pixels_[std::size_t(place.x)];
    Known& known = pixel.known[state.key() % pixel.known.size()];
    if (known.key != state.key()) {
        if (pixel.parts.empty())
            divide(state, pixel);
        known = {state.key(),
                 pixel.isSteep ? composite<4>(state, pixel, place.x) : composite<1>(state, pixel, place.x)};
    }
    const Quarters& quarters = known.quarters;
    if (!pixel.isSteep)
        return vectorOf(quarters[0]);
    const glm::vec2 middle = glm::clamp(2.0f * place.middle - 0.5f, 0.0f, 1.0f);
    const Float4 upper = quarters[0] + middle.x * (quarters[1] - quarters[0]),
                 lower = quarters[2] + middle.x * (quarters[3] - quarters[2]);
    return vectorOf(upper + middle.y * (lower - upper));
}

void PixelColors::divide(const RegionState& state, Pixel& pixel) const {
    bool goesOn = false;
    for (std::uint32_t i = 0; i < pixel.layers.size(); ++i) {
        const auto [layer, inParts] = pixel.layers[i];
        const bool isPlain = !inParts && state.isLaidOver(layer);
        if (goesOn && isPlain)
            pixel.parts.back().end = i + 1;
        else
            pixel.parts.push_back({i, i + 1, false, {}});
        goesOn = isPlain;
    }
}

template <std::size_t quarters, class Next>
PixelColors::Quarters PixelColors::stacked(Next next) {
    Quarters sum{};
    std::array<float, quarters> light;
    light.fill(1);
    for (float most = 1; most > unseen;) {
        const Quarters* const colors = next();
        if (!colors)
            break;
        most = 0;
        for (std::size_t i = 0; i < quarters; ++i) {
            sum[i] += light[i] * (*colors)[i];
            light[i] *= 1 - (*colors)[i][3];
            most = std::max(most, light[i]);
        }
    }
    return sum;
}

template <std::size_t quarters>
PixelColors::Quarters PixelColors::composite(const RegionState& state, Pixel& pixel, int x) const {
    const auto shows = [&](const Part& part) {
        const Listed& first = pixel.layers[part.first];
        return !first.inParts || state.isShown(first.layer);
    };
    if (pixel.isLaidOver)
        return stacked<quarters>([&, at = std::size_t{0}]() mutable -> const Quarters* {
            while (at < pixel.parts.size() && !shows(pixel.parts[at]))
                ++at;
            return at < pixel.parts.size() ? &colorsOf<quarters>(pixel, pixel.parts[at++], x) : nullptr;
        });
    Groups<quarters> groups(picture_);
    for (std::size_t i = pixel.parts.size(); i-- > 0;)
        if (Part& part = pixel.parts[i]; shows(part))
            groups.add(picture_.items[picture_.itemOfLayer[pixel.layers[part.first].layer]],
                       colorsOf<quarters>(pixel, part, x));
    return groups.finish();
}

template <std::size_t quarters>
const PixelColors::Quarters& PixelColors::colorsOf(Pixel& pixel, Part& part, int x) const {
    if (!std::exchange(part.isKnown, true))
        part.colors =
            stacked<quarters>([&, at = part.first, colors = Quarters{}]() mutable -> const Quarters* {
                if (at == part.end)
                    return nullptr;
                colors = colorsOf(pixel.layers[at++].layer, x, quarters > 1);
                return &colors;
            });
    return part.colors;
}

PixelColors::Quarters PixelColors::colorsOf(std::uint32_t layer, int x, bool inQuarters) const {
    const Source& source = sourceOf(layer);
    Quarters colors;
    if (source.op == asset::Op::Solid) {
        colors.fill(std::bit_cast<Float4>(source.color));
    } else {
        const asset::PixelPaints& pixels = *sources_->pixels;
        const std::uint32_t paint = sources_->paints[source.data];
        if (inQuarters && sources_->isSteep[source.data] != 0)
            colors = std::bit_cast<Quarters>(pixels.quarters(paint, x, row_));
        else
            colors.fill(std::bit_cast<Float4>(pixels.color(paint, x, row_)));
    }
    const float opacity = picture_.items[picture_.itemOfLayer[layer]].opacity;
    for (Float4& color : colors)
        color *= opacity;
    return colors;
}

void PixelColors::make() {
    sources_ = std::make_unique<Sources>();
    asset::Asset& asset = sources_->asset;
    asset.data = picture_.data;
    sources_->paints.resize(picture_.data.size(), noIndex);
    for (const Source& source : picture_.sources)
        if (source.op != asset::Op::Solid && sources_->paints[source.data] == noIndex) {
            sources_->paints[source.data] = std::uint32_t(asset.paints.size());
            asset.paints.push_back(
                encodePaint({{{source.op, asset::Blend::Normal, 1, source.data}, {}}}, asset.data));
        }
    asset::AssetView view(asset);
    view.images = bitmaps_;
    sources_->pixels.emplace(view, images_, view_);
    sources_->isSteep.resize(picture_.data.size());
    for (const Source& source : picture_.sources)
        if (source.op != asset::Op::Solid)
            sources_->isSteep[source.data] = sources_->pixels->isSteep(sources_->paints[source.data]);
    pixels_.resize(std::size_t(view_.width));
}

}  // namespace vtm::compiler
