// Section 7.2 in a recording: masks of shapes.

#include <algorithm>

#include "api/openvg/record/record.hpp"
#include "api/openvg/record/record_shapes.hpp"
#include "api/openvg/state/matrix.hpp"

namespace vtm::openvg {

bool Recorder::covers(const CopyArea& area) const {
    return area.dx == 0 && area.dy == 0 && area.sx == 0 && area.sy == 0 && area.width >= width_ &&
           area.height >= height_;
}

void Recorder::combine(VGMaskOperation operation, const RecordedMask& other) {
    if (operation == VG_SET_MASK) {
        mask_ = other;
    } else if (operation == VG_UNION_MASK) {
        mask_ = unionOf(mask_, other, picture_);
    } else if (operation == VG_INTERSECT_MASK) {
        mask_ = intersectionOf(mask_, other, picture_);
    } else {
        const std::optional<RecordedMask> difference = differenceOf(mask_, other, picture_);
        if (!difference)
            refuse("VG_SUBTRACT_MASK of more than one shape");
        mask_ = *difference;
    }
}

void Recorder::renderToMask(const State& state, const Path& path, VGbitfield modes,
                            VGMaskOperation operation) {
    ++calls_;
    if (operation == VG_CLEAR_MASK || operation == VG_FILL_MASK) {
        mask_ = operation == VG_FILL_MASK ? RecordedMask() : emptyMask();
        return;
    }
    const glm::mat3& toSurface = state.matrix(VG_MATRIX_PATH_USER_TO_SURFACE);
    for (const VGPaintMode mode : {VG_FILL_PATH, VG_STROKE_PATH}) {
        if (!(modes & VGbitfield(mode)))
            continue;
        const scene::Shape shape = shapeOf(state, path, mode, toPicture(toSurface));
        RecordedMask drawn = emptyMask();
        if (!shape.path->empty() && inverseOf(toSurface))
            drawn = maskOf({shape.path, shape.transform, std::get<scene::FillRule>(shape.geometry), nullptr});
        if (state.scissoring)
            drawn = intersectionOf(drawn,
                                   maskOf({std::make_shared<scene::Path>(outlineOf(rectanglesOf(state))),
                                           flip_, scene::FillRule::NonZero, nullptr}),
                                   picture_);
        combine(operation, drawn);
    }
}

void Recorder::mask(const MaskLayer* layer, VGMaskOperation operation, const CopyArea& area) {
    ++calls_;
    if (layer) {
        if (!covers(area) || !covers({0, 0, 0, 0, layer->mask.width, layer->mask.height}))
            refuse("a part of a mask layer");
        return combine(operation, maskOfLayer(*layer));
    }
    const RecordedMask rectangle =
        maskOf({std::make_shared<scene::Path>(rectangleOf(area.dx, area.dy, area.width, area.height)), flip_,
                scene::FillRule::NonZero, nullptr});
    if (covers(area))
        mask_ = operation == VG_FILL_MASK ? RecordedMask() : emptyMask();
    else
        combine(operation == VG_FILL_MASK ? VG_UNION_MASK : VG_SUBTRACT_MASK, rectangle);
}

RecordedMask Recorder::maskOfLayer(const MaskLayer& layer) {
    if (const auto written = layers_.find(layer.handle); written != layers_.end())
        return written->second;
    const auto isAll = [&](std::uint8_t value) {
        return std::ranges::all_of(layer.mask.values, [&](std::uint8_t v) { return v == value; });
    };
    if (isAll(255))
        return {};
    if (!isAll(0))
        refuse("a mask layer of pixels from before the recording");
    return emptyMask();
}

void Recorder::fillMaskLayer(const MaskLayer& layer, const CopyArea& area, float value) {
    ++calls_;
    if (!covers(area) || (value != 0 && value != 1))
        refuse("a mask layer filled in part");
    layers_[layer.handle] = value == 1 ? RecordedMask() : emptyMask();
}

void Recorder::copyMask(const MaskLayer& layer, const CopyArea& area) {
    ++calls_;
    if (!covers(area) || !covers({0, 0, 0, 0, layer.mask.width, layer.mask.height}))
        refuse("a part of the mask");
    layers_[layer.handle] = mask_;
}

}  // namespace vtm::openvg
