#include "compiler/paint/painters.hpp"

#include <algorithm>

#include "compiler/session/changes.hpp"

namespace vtm::compiler {

PicturePainter::PicturePainter(const LoweredScene& picture)
    : picture_(picture), plain_(picture.groups.size()), wanted_(picture.layers.size()) {
    for (std::uint32_t g = 0; g < plain_.size(); ++g)  // parents come first
        plain_[g] = isPlain(g);
    std::vector<Shade> shades(picture.layers.size());
    for (const LoweredItem& item : picture.items) {
        const Source& source = picture.sources[item.source];
        Shade& shade = shades[item.layer];
        shade.kind = plain_[item.group] && source.op == asset::Op::Solid ? Shade::Solid : Shade::Other;
        for (std::size_t c = 0; c < 4; ++c)
            shade.color[c] = source.color[c] * item.opacity;
    }
    shades_ = std::make_shared<const std::vector<Shade>>(std::move(shades));
}

std::unique_ptr<Painter> PicturePainter::clone() const { return std::make_unique<PicturePainter>(*this); }

bool PicturePainter::isPlain(std::uint32_t index) const {
    const LoweredGroup& g = picture_.groups[index];
    return g.role == GroupRole::Plain && g.opacity >= 1 && g.blend == scene::BlendMode::Normal &&
           g.clip == noIndex && g.mask == noIndex && (g.parent == noIndex || plain_[g.parent]);
}

PaintId PicturePainter::paint(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                              Palette& palette) {
    if (Color color; stackSolids(layers, inside, color))
        return palette.solid(color);
    items_.clear();
    for (std::uint32_t layer : layers)
        if (picture_.itemOfLayer[layer] != noIndex)
            items_.push_back(picture_.itemOfLayer[layer]);
    return composite(picture_, items_, inside, palette);
}

/// The usual case: what shows is solid colours in groups that change nothing.
bool PicturePainter::stackSolids(std::span<const std::uint32_t> layers,
                                 const std::vector<std::uint8_t>& inside, Color& color) const {
    const std::vector<Shade>& shades = *shades_;
    std::size_t bottom = layers.size();  // down to the first that hides the rest
    for (bool hidden = false; bottom > 0 && !hidden;) {
        const std::uint32_t layer = layers[--bottom];
        const Shade& shade = shades[layer];
        if (!inside[layer] || shade.kind == Shade::None)
            continue;
        if (shade.kind == Shade::Other)
            return false;
        hidden = shade.color[3] >= 1;
    }
    color = {};
    for (std::size_t i = bottom; i < layers.size(); ++i)
        if (inside[layers[i]] && shades[layers[i]].kind == Shade::Solid)
            color = over(shades[layers[i]].color, color);
    return true;
}

Cover PicturePainter::clipCover(std::uint32_t clip, const std::vector<Cover>& covers) const {
    return compiler::clipCover(picture_, clip, [&](std::uint32_t layer) { return covers[layer]; });
}

Cover PicturePainter::groupCover(std::uint32_t group, const std::vector<Cover>& covers) const {
    Cover cover = Cover::In;
    for (; group != noIndex; group = picture_.groups[group].parent)
        cover = std::min(cover, clipCover(picture_.groups[group].clip, covers));
    return cover;
}

bool PicturePainter::hidesAllBelow(const LoweredItem& item, const std::vector<Cover>& covers) const {
    if (covers[item.layer] != Cover::In || !picture_.sources[item.source].opaque || item.opacity < 1)
        return false;
    if (plain_[item.group])
        return true;
    for (std::uint32_t g = item.group; g != noIndex; g = picture_.groups[g].parent) {
        const LoweredGroup& group = picture_.groups[g];
        if (group.role != GroupRole::Plain || group.opacity < 1 || group.blend != scene::BlendMode::Normal ||
            group.mask != noIndex || clipCover(group.clip, covers) != Cover::In)
            return false;
    }
    return true;
}

void PicturePainter::want(std::uint32_t layer) {
    wanted_[layer] = true;
    marked_.push_back(layer);
}

void PicturePainter::markClips(std::uint32_t group) {
    for (; group != noIndex; group = picture_.groups[group].parent)
        markClip(picture_.groups[group].clip);
}

void PicturePainter::markClip(std::uint32_t clip) {
    if (clip == noIndex)
        return;
    const ClipExpression& e = picture_.clips[clip];
    for (const ClipExpression::Term& term : e.terms) {
        want(term.layer);
        markClip(term.clip);
    }
    markClip(e.outer);
}

void PicturePainter::cull(std::span<const std::uint32_t> layers, const std::vector<Cover>& covers,
                          std::vector<std::uint8_t>& keep) {
    bool hidden = false;
    for (std::size_t i = layers.size(); i-- > 0;) {
        const std::uint32_t index = picture_.itemOfLayer[layers[i]];
        if (index == noIndex)
            continue;
        const LoweredItem& item = picture_.items[index];
        const bool clipped = !plain_[item.group];
        if (hidden || covers[item.layer] == Cover::Out ||
            (clipped && groupCover(item.group, covers) == Cover::Out))
            continue;
        want(item.layer);
        if (clipped)
            markClips(item.group);
        hidden = hidesAllBelow(item, covers);
    }
    for (std::size_t i = 0; i < layers.size(); ++i)
        keep[i] = wanted_[layers[i]];
    for (std::uint32_t layer : marked_)
        wanted_[layer] = false;
    marked_.clear();
}

PaintId PicturePainter::mean(std::span<const PaintId> paints, Palette& palette) {
    Color sum{};
    for (PaintId id : paints) {
        if (!Palette::isConstant(palette[id]))
            return paints[paints.size() / 2];
        const Color color = Palette::colorOf(palette[id]);
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += color[c] / static_cast<float>(paints.size());
    }
    return palette.solid(sum);
}

PaintId MaskPainter::paint(std::span<const std::uint32_t>, const std::vector<std::uint8_t>& inside,
                           Palette&) {
    const auto in = [&](std::uint32_t layer) { return inside[layer] != 0; };
    return layer_ != noIndex ? in(layer_) : insideClip(picture_, clip_, in);
}

PaintId MaskPainter::mean(std::span<const PaintId> paints, Palette&) {
    const auto covered = std::count(paints.begin(), paints.end(), 1u);
    return 2 * static_cast<std::size_t>(covered) >= paints.size();
}

EditablePainter::EditablePainter(const LoweredScene& picture, const std::vector<std::uint32_t>& names)
    : PicturePainter(picture),
      picture_(picture),
      names_(names),
      groupHides_(groupsThatHide(picture)),
      clipped_(clippedGroups(picture)) {}

PaintId EditablePainter::paint(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                               Palette& palette) {
    const auto in = [&](std::uint32_t layer) { return inside[layer] != 0; };
    stack_.clear();
    for (std::size_t i = layers.size(); i-- > 0;) {
        const std::uint32_t index = picture_.itemOfLayer[layers[i]];
        if (index == noIndex || !in(layers[i]))
            continue;
        const LoweredItem& item = picture_.items[index];
        if (clipped_[item.group] && !insideClips(picture_, item.group, in))
            continue;
        stack_.push_back(names_[item.layer]);
        if (hides(picture_, item, groupHides_[item.group]))
            break;
    }
    std::reverse(stack_.begin(), stack_.end());
    return palette.stacks.add(stack_);
}

PaintId EditablePainter::mean(std::span<const PaintId> paints, Palette& palette) {
    if (std::all_of(paints.begin(), paints.end(), [&](PaintId id) { return id == paints[0]; }))
        return paints[0];
    stack_.clear();
    for (std::size_t i = 0; i < paints.size(); ++i) {
        if (i > 0)
            stack_.push_back(noIndex);
        const Stack& sample = palette.stacks[paints[i]];
        stack_.insert(stack_.end(), sample.begin(), sample.end());
    }
    return palette.stacks.add(stack_);
}

}  // namespace vtm::compiler
