#include "scene/place.hpp"

namespace vtm::scene {

namespace {

/// Maps copies of what it is given.
class Placer {
public:
    explicit Placer(const Affine& transform) : m_(transform) {}

    std::shared_ptr<const Clip> clip(const std::shared_ptr<const Clip>& part) {
        if (!part)
            return nullptr;
        const Level level(depth_);
        auto clip = std::make_shared<Clip>(*part);
        for (ClipShape& shape : clip->shapes) {
            shape.transform = compose(m_, shape.transform);
            shape.clip = this->clip(shape.clip);
        }
        clip->clip = this->clip(clip->clip);
        return clip;
    }

    std::shared_ptr<const Mask> mask(const std::shared_ptr<const Mask>& part) {
        if (!part)
            return nullptr;
        return std::make_shared<const Mask>(Mask{group(part->content), part->kind, part->linear});
    }

    std::shared_ptr<const Filter> filter(const std::shared_ptr<const Filter>& part) {
        if (!part)
            return nullptr;
        auto filter = std::make_shared<Filter>(*part);
        filter->transform = compose(m_, filter->transform);
        for (FilterPrimitive& primitive : filter->primitives)
            if (auto* picture = std::get_if<PictureFilter>(&primitive.operation))
                picture->content = group(picture->content);
        return filter;
    }

    void group(Group& part) { place(part); }

private:
    std::shared_ptr<const Group> group(const std::shared_ptr<const Group>& part) {
        if (!part)
            return nullptr;
        auto copy = std::make_shared<Group>(*part);
        place(*copy);
        return copy;
    }

    void place(Item& item) { item.transform = compose(m_, item.transform); }
    void place(Group& group) {
        const Level level(depth_);
        for (Node& child : group.children)
            std::visit([&](auto& value) { place(value); }, child.value);
        group.clip = clip(group.clip);
        group.mask = mask(group.mask);
        group.filter = filter(group.filter);
    }
    void place(Select& select) {
        const Level level(depth_);
        select.mask.transform = compose(m_, select.mask.transform);
        select.inside = group(select.inside);
        select.outside = group(select.outside);
    }

    const Affine m_;
    int depth_ = 0;
};

}  // namespace

std::shared_ptr<const Clip> placed(const std::shared_ptr<const Clip>& part, const Affine& m) {
    return m == identity ? part : Placer(m).clip(part);
}

std::shared_ptr<const Mask> placed(const std::shared_ptr<const Mask>& part, const Affine& m) {
    return m == identity ? part : Placer(m).mask(part);
}

std::shared_ptr<const Filter> placed(const std::shared_ptr<const Filter>& part, const Affine& m) {
    return m == identity ? part : Placer(m).filter(part);
}

Group placed(Group part, const Affine& transform) {
    if (transform != identity)
        Placer(transform).group(part);
    return part;
}

}  // namespace vtm::scene
