#include "compiler/src/painters.hpp"

#include <algorithm>
#include <bit>

namespace vtm::compiler {

PicturePainter::PicturePainter(const Picture& picture, asset::Asset& asset)
    : picture_(picture), asset_(asset), palette_(asset), wanted_(picture.layers.size()) {}

std::uint16_t PicturePainter::paint(std::span<const std::uint32_t> layers,
                                    const std::vector<std::uint8_t>& inside) {
    items_.clear();
    for (std::uint32_t layer : layers)
        if (picture_.itemOfLayer[layer] != none)
            items_.push_back(picture_.itemOfLayer[layer]);
    return composite(picture_, items_, inside, palette_);
}

namespace {

Cover termCover(const ClipExpression::Term& term, const std::vector<Cover>& covers) {
    const Cover cover = covers[term.layer];
    if (!term.inverted || cover == Cover::Edge)
        return cover;
    return cover == Cover::In ? Cover::Out : Cover::In;
}

}  // namespace

// Cover is ordered Out < Edge < In: a union covers like its best term, an intersection like its worst.
Cover PicturePainter::clipCover(std::uint32_t clip, const std::vector<Cover>& covers) const {
    if (clip == none)
        return Cover::In;
    const ClipExpression& e = picture_.clips[clip];
    Cover any = Cover::Out;
    for (const ClipExpression::Term& term : e.terms)
        any = std::max(any, std::min(termCover(term, covers), clipCover(term.clip, covers)));
    return std::min(any, clipCover(e.outer, covers));
}

Cover PicturePainter::groupCover(std::uint32_t group, const std::vector<Cover>& covers) const {
    Cover cover = Cover::In;
    for (; group != none; group = picture_.groups[group].parent)
        cover = std::min(cover, clipCover(picture_.groups[group].clip, covers));
    return cover;
}

bool PicturePainter::hidesAllBelow(const PictureItem& item, const std::vector<Cover>& covers) const {
    if (covers[item.layer] != Cover::In || !picture_.sources[item.source].opaque || item.opacity < 1)
        return false;
    for (std::uint32_t g = item.group; g != none; g = picture_.groups[g].parent) {
        const PictureGroup& group = picture_.groups[g];
        if (group.role != GroupRole::Plain || group.opacity < 1 || group.blend != scene::BlendMode::Normal ||
            group.mask != none || clipCover(group.clip, covers) != Cover::In)
            return false;
    }
    return true;
}

void PicturePainter::want(std::uint32_t layer) {
    wanted_[layer] = true;
    marked_.push_back(layer);
}

void PicturePainter::markClips(std::uint32_t group) {
    for (; group != none; group = picture_.groups[group].parent)
        markClip(picture_.groups[group].clip);
}

void PicturePainter::markClip(std::uint32_t clip) {
    if (clip == none)
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
        if (index == none)
            continue;
        const PictureItem& item = picture_.items[index];
        if (hidden || covers[item.layer] == Cover::Out || groupCover(item.group, covers) == Cover::Out)
            continue;
        want(item.layer);
        markClips(item.group);
        hidden = hidesAllBelow(item, covers);
    }
    for (std::size_t i = 0; i < layers.size(); ++i)
        keep[i] = wanted_[layers[i]];
    for (std::uint32_t layer : marked_)
        wanted_[layer] = false;
    marked_.clear();
}

std::uint16_t PicturePainter::mean(std::span<const std::uint16_t> paints) {
    std::array<float, 4> sum{};
    for (std::uint16_t index : paints) {
        const asset::Paint& paint = asset_.paints[index];
        if (paint[3] == asset::programTag)
            return paints[paints.size() / 2];
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += std::bit_cast<float>(paint[c]) / static_cast<float>(paints.size());
    }
    return palette_.solid(sum);
}

std::uint16_t MaskPainter::paint(std::span<const std::uint32_t>, const std::vector<std::uint8_t>& inside) {
    const auto in = [&](std::uint32_t layer) { return inside[layer] != 0; };
    return layer_ != none ? in(layer_) : insideClip(picture_, clip_, in);
}

std::uint16_t MaskPainter::mean(std::span<const std::uint16_t> paints) {
    const auto covered = std::count(paints.begin(), paints.end(), 1);
    return 2 * static_cast<std::size_t>(covered) >= paints.size();
}

}  // namespace vtm::compiler
