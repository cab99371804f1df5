#include "api/src/place.hpp"

#include "api/src/level.hpp"

namespace vtm {

namespace {

using scene::Affine;
using scene::compose;

/// Maps copies of what it is given.
class Placer {
public:
    explicit Placer(const Affine& transform) : m_(transform) {}

    std::shared_ptr<const scene::Clip> clip(const std::shared_ptr<const scene::Clip>& part) {
        if (!part)
            return nullptr;
        const Level level(depth_);
        auto clip = std::make_shared<scene::Clip>(*part);
        for (scene::ClipShape& shape : clip->shapes) {
            shape.transform = compose(m_, shape.transform);
            shape.clip = this->clip(shape.clip);
        }
        clip->clip = this->clip(clip->clip);
        return clip;
    }

    std::shared_ptr<const scene::Mask> mask(const std::shared_ptr<const scene::Mask>& part) {
        if (!part)
            return nullptr;
        return std::make_shared<const scene::Mask>(
            scene::Mask{group(part->content), part->kind, part->linear});
    }

private:
    std::shared_ptr<const scene::Group> group(const std::shared_ptr<const scene::Group>& part) {
        if (!part)
            return nullptr;
        auto copy = std::make_shared<scene::Group>(*part);
        place(*copy);
        return copy;
    }

    void place(scene::Item& item) { item.transform = compose(m_, item.transform); }
    void place(scene::Group& group) {
        const Level level(depth_);
        for (scene::Node& child : group.children)
            std::visit([&](auto& value) { place(value); }, child.value);
        group.clip = clip(group.clip);
        group.mask = mask(group.mask);
    }
    void place(scene::Select& select) {
        const Level level(depth_);
        select.mask.transform = compose(m_, select.mask.transform);
        select.inside = group(select.inside);
        select.outside = group(select.outside);
    }

    const Affine m_;
    int depth_ = 0;
};

}  // namespace

std::shared_ptr<const scene::Clip> placed(const std::shared_ptr<const scene::Clip>& part, const Affine& m) {
    return m == scene::identity ? part : Placer(m).clip(part);
}

std::shared_ptr<const scene::Mask> placed(const std::shared_ptr<const scene::Mask>& part, const Affine& m) {
    return m == scene::identity ? part : Placer(m).mask(part);
}

}  // namespace vtm
