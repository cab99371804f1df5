#include "api/openvg/record/record_mask.hpp"

#include <utility>

#include "api/openvg/draw/draw_path.hpp"
#include "api/openvg/draw/path_masks.hpp"
#include "api/openvg/record/record_paint.hpp"

namespace vtm::openvg {

scene::Path rectangleOf(double x, double y, double width, double height) {
    return scene::rectangle({x, y}, {x + width, y + height});
}

std::vector<VGint> rectanglesOf(const State& state) {
    std::vector<VGint> result;
    const std::vector<VGint>& r = state.scissorRects;
    for (std::size_t i = 0; i + 4 <= r.size(); i += 4)
        if (r[i + 2] > 0 && r[i + 3] > 0)
            result.insert(result.end(), r.begin() + std::ptrdiff_t(i), r.begin() + std::ptrdiff_t(i) + 4);
    return result;
}

scene::Path outlineOf(const std::vector<VGint>& rectangles) {
    scene::Path path;
    for (std::size_t i = 0; i < rectangles.size(); i += 4) {
        const scene::Path one =
            rectangleOf(rectangles[i], rectangles[i + 1], rectangles[i + 2], rectangles[i + 3]);
        path.insert(path.end(), one.begin(), one.end());
    }
    return path;
}

scene::Shape shapeOf(const State& state, const Path& path, VGPaintMode mode, const scene::Affine& transform) {
    if (mode == VG_STROKE_PATH && !hasStroke(state))
        return {std::make_shared<scene::Path>(), transform, scene::FillRule::NonZero};
    if (mode == VG_STROKE_PATH)
        return {std::make_shared<scene::Path>(strokeOutline(path.data, strokeParameters(state))), transform,
                scene::FillRule::NonZero};
    return {std::make_shared<scene::Path>(outline(path.data.segments())), transform,
            state.fillRule == VG_EVEN_ODD ? scene::FillRule::EvenOdd : scene::FillRule::NonZero};
}

namespace {

using PicturePath = std::shared_ptr<const scene::Path>;

bool isEverything(const RecordedMask& mask) { return !mask.clip && !mask.alpha; }

scene::Node white(const PicturePath& picture) {
    scene::Item item;
    item.path = picture;
    item.geometry = scene::FillRule::NonZero;
    item.paint = scene::Color{1, 1, 1, 1};
    return {std::move(item)};
}

/// A group whose alpha is the mask's value.
scene::Node alphaOf(const RecordedMask& mask, const PicturePath& picture) {
    scene::Group group;
    if (mask.alpha)
        group.children = mask.alpha->children;
    else
        group.children.push_back(white(picture));
    group.clip = mask.clip;
    return {std::move(group)};
}

void append(scene::Clip& result, const std::shared_ptr<const scene::Clip>& clip, const PicturePath& picture) {
    if (clip->clip)
        result.shapes.push_back({picture, scene::identity, scene::FillRule::NonZero, clip});
    else
        result.shapes.insert(result.shapes.end(), clip->shapes.begin(), clip->shapes.end());
}

}  // namespace

RecordedMask emptyMask() { return {std::make_shared<scene::Clip>(), nullptr}; }

RecordedMask maskOf(scene::ClipShape shape) {
    scene::Clip clip;
    clip.shapes.push_back(std::move(shape));
    return {std::make_shared<scene::Clip>(std::move(clip)), nullptr};
}

RecordedMask unionOf(const RecordedMask& a, const RecordedMask& b, const PicturePath& picture) {
    if (isEverything(a) || isEverything(b))
        return {};
    if (a.alpha || b.alpha) {
        // 1 - (1 - a)(1 - b) is what one alpha over another is.
        scene::Group both;
        both.children.push_back(alphaOf(a, picture));
        both.children.push_back(alphaOf(b, picture));
        return {nullptr, std::make_shared<scene::Group>(std::move(both)), a.isShare || b.isShare};
    }
    scene::Clip clip;
    append(clip, a.clip, picture);
    append(clip, b.clip, picture);
    return {std::make_shared<scene::Clip>(std::move(clip)), nullptr};
}

RecordedMask intersectionOf(const RecordedMask& a, const RecordedMask& b, const PicturePath& picture) {
    RecordedMask result = a;
    result.isShare = a.isShare || b.isShare;
    if (!a.clip) {
        result.clip = b.clip;
    } else if (b.clip) {
        scene::Clip clip;
        append(clip, a.clip, picture);
        clip.clip = b.clip;
        result.clip = std::make_shared<scene::Clip>(std::move(clip));
    }
    if (!a.alpha) {
        result.alpha = b.alpha;
    } else if (b.alpha) {
        scene::Group both = *a.alpha;
        both.mask = std::make_shared<scene::Mask>(scene::Mask{b.alpha, scene::MaskKind::Alpha});
        result.alpha = groupOf({std::move(both)});
    }
    return result;
}

std::optional<RecordedMask> differenceOf(const RecordedMask& a, const RecordedMask& b,
                                         const PicturePath& picture) {
    if (isEverything(b))
        return emptyMask();
    if (b.alpha || b.clip->clip)
        return std::nullopt;
    if (b.clip->shapes.empty())
        return a;
    const scene::ClipShape& shape = b.clip->shapes.front();
    if (b.clip->shapes.size() > 1 || shape.clip)
        return std::nullopt;
    const scene::Select outside{
        {shape.path, shape.transform, shape.rule}, nullptr, groupOf(alphaOf({nullptr, a.alpha}, picture))};
    return RecordedMask{a.clip, groupOf({outside}), a.isShare};
}

RecordedMask combinedWith(const RecordedMask& mask, VGMaskOperation operation, const scene::Item& inside,
                          const PicturePath& picture) {
    const auto elsewhere = [&](scene::Node outside) {
        const scene::Shape shape{inside.path, inside.transform, inside.geometry};
        return RecordedMask{
            nullptr, groupOf({scene::Select{shape, groupOf({inside}), groupOf(std::move(outside))}}), true};
    };
    if (operation == VG_SET_MASK)
        return elsewhere(alphaOf(mask, picture));
    if (operation == VG_UNION_MASK)
        return unionOf(mask, {nullptr, groupOf({inside}), true}, picture);
    return intersectionOf(mask, elsewhere(white(picture)), picture);
}

}  // namespace vtm::openvg
