#include "compiler/paint/editable.hpp"

#include <algorithm>

#include "compiler/session/changes.hpp"

namespace vtm::compiler {

EditablePainter::EditablePainter(const LoweredScene& picture, const std::vector<std::uint32_t>& names)
    : PicturePainter(picture),
      picture_(picture),
      names_(names),
      groupHides_(groupsThatHide(picture)),
      clipped_(picture.groups.size()) {
    for (std::uint32_t g = 0; g < clipped_.size(); ++g) {  // parents come first
        const LoweredGroup& group = picture.groups[g];
        clipped_[g] = group.clip != noIndex || (group.parent != noIndex && clipped_[group.parent]);
    }
}

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
