#include "api/src/place.hpp"

namespace vtm {

namespace {

using scene::Affine;
using scene::compose;

scene::Group placed(scene::Group group, const Affine& m);

std::shared_ptr<const scene::Group> placed(const std::shared_ptr<const scene::Group>& part, const Affine& m) {
    return part ? std::make_shared<const scene::Group>(placed(*part, m)) : nullptr;
}

void place(scene::Item& item, const Affine& m) { item.transform = compose(m, item.transform); }
void place(scene::Group& group, const Affine& m) { group = placed(std::move(group), m); }
void place(scene::Select& select, const Affine& m) {
    select.mask.transform = compose(m, select.mask.transform);
    select.inside = placed(select.inside, m);
    select.outside = placed(select.outside, m);
}

scene::Group placed(scene::Group group, const Affine& m) {
    for (scene::Node& child : group.children)
        std::visit([&](auto& value) { place(value, m); }, child.value);
    group.clip = vtm::placed(group.clip, m);
    group.mask = vtm::placed(group.mask, m);
    return group;
}

}  // namespace

std::shared_ptr<const scene::Clip> placed(const std::shared_ptr<const scene::Clip>& part, const Affine& m) {
    if (!part || m == scene::identity)
        return part;
    scene::Clip clip = *part;
    for (scene::ClipShape& shape : clip.shapes) {
        shape.transform = compose(m, shape.transform);
        shape.clip = placed(shape.clip, m);
    }
    clip.clip = placed(clip.clip, m);
    return std::make_shared<const scene::Clip>(std::move(clip));
}

std::shared_ptr<const scene::Mask> placed(const std::shared_ptr<const scene::Mask>& part, const Affine& m) {
    if (!part || m == scene::identity)
        return part;
    return std::make_shared<const scene::Mask>(
        scene::Mask{placed(part->content, m), part->kind, part->linear});
}

}  // namespace vtm
