#include "compiler/paint/region_paints.hpp"

namespace vtm::compiler {

void RegionPaints::enter(std::span<const Layer> layers) {
    states_.clear();
    cornerSum_ = cornerKey_ = 0;
    for (const Layer& layer : layers) {
        const State state{layer.corner, layer.corner, layer.rule == scene::FillRule::NonZero ? ~0 : 1,
                          layer.name};
        states_.push_back(state);
        cornerSum_ += static_cast<std::uint64_t>(std::int64_t{layer.corner}) * layer.name;
        cornerKey_ ^= layer.name & -std::uint64_t{state.isInside()};
    }
    sum_ = cornerSum_;
    key_ = cornerKey_;
    find();
}

void RegionPaints::toCorner() {
    for (State& s : states_)
        s.winding = s.corner;
    sum_ = cornerSum_;
    key_ = cornerKey_;
}

void RegionPaints::find() {
    lastKey_ = key_;
    PaintId& paint = known_[key_];
    if (paint == NumberMap::unknown)
        paint = compute();
    last_ = paint;
}

}  // namespace vtm::compiler
