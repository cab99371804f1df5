#include "api/openvg/record/record_shapes.hpp"

#include "api/openvg/draw/draw_path.hpp"
#include "api/openvg/draw/path_masks.hpp"

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

}  // namespace vtm::openvg
