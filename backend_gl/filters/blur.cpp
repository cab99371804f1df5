#include <algorithm>
#include <utility>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/filters/operations.hpp"
#include "raster/filter_tables.hpp"

namespace vtm::gl {

namespace {

/// Coarse pixels are made of so many at once, so that no shader reads more.
constexpr int largestStep = 16;

/// Passes, each on what the one before it left.
class BlurPasses {
public:
    BlurPasses(FilterLayers& layers, const FilterLayer& input) : layers_(layers), last_(&input) {}
    ~BlurPasses() { layers_.giveBack(std::move(own_)); }
    BlurPasses(const BlurPasses&) = delete;
    BlurPasses& operator=(const BlurPasses&) = delete;

    const FilterLayer& last() const { return *last_; }

    /// To means of `step` pixels along an axis.
    void reduce(int axis, int step) {
        for (; step > 1; step /= std::min(step, largestStep)) {
            const int now = std::min(step, largestStep);
            glm::ivec2 steps(1);
            steps[axis] = now;
            draw(axis, asset::coarsened(last_->box, steps), BlurAction::Reduce,
                 [&](Pass& pass, const PixelBox& box) {
                     glUniform1i(pass.uniform("coarse"), now);
                     // The pixel that firstBox leads to is counted from the layer's own.
                     glUniform1i(pass.uniform("phase"), box.min[axis] * (now - 1));
                 });
        }
    }

    void convolve(int axis, const std::vector<float>& kernel, int first, int end) {
        if (kernel.empty())
            return;
        draw(axis, along(axis, first, end), BlurAction::Kernel, [&](Pass& pass, const PixelBox&) {
            glUniform1i(pass.uniform("reach"), int(kernel.size()) - 1);
            glUniform1fv(pass.uniform("weights"), GLsizei(kernel.size()), kernel.data());
        });
    }

    /// From coarse pixels.
    void enlarge(int axis, int step, int first, int end) {
        if (step == 1)
            return;
        draw(axis, along(axis, first, end), BlurAction::Enlarge, [&](Pass& pass, const PixelBox& box) {
            glm::ivec2 steps(1);
            steps[axis] = step;
            const int corner = asset::coarsened({box.min, box.min + 1}, steps).min[axis];
            glUniform1i(pass.uniform("coarse"), step);
            glUniform1i(pass.uniform("phase"), box.min[axis] - corner * step);
            // The shader counts coarse pixels from that corner.
            glm::ivec2 shift = box.min - last_->box.min;
            shift[axis] = corner - last_->box.min[axis];
            glUniform4i(pass.uniform("firstBox"), shift.x, shift.y, last_->box.width(), last_->box.height());
        });
    }

private:
    using Pass = FilterLayers::Pass;

    PixelBox along(int axis, int first, int end) const {
        PixelBox box = last_->box;
        box.min[axis] = first;
        box.max[axis] = end;
        return box;
    }

    template <class Set>
    void draw(int axis, const PixelBox& box, BlurAction action, Set&& set) {
        if (last_->empty())
            return;
        FilterLayer next = layers_.make(box, last_->linear);
        if (!next.empty()) {
            Pass pass = layers_.pass(FilterProgram::Blur, next, FilterVariant(action));
            pass.first(*last_);
            glUniform2i(pass.uniform("along"), axis == 0 ? 1 : 0, axis == 0 ? 0 : 1);
            set(pass, box);
            pass.draw();
        }
        layers_.giveBack(std::exchange(own_, std::move(next)));
        last_ = &own_;
    }

    FilterLayers& layers_;
    const FilterLayer* last_;
    FilterLayer own_;
};

}  // namespace

void drawBlurred(FilterLayers& layers, const FilterLayer& input, glm::dvec2 deviation,
                 const asset::PixelRect& cut, const FilterLayer& result) {
    const asset::AxisBlur x = asset::axisBlur(deviation.x), y = asset::axisBlur(deviation.y);
    const glm::ivec2 steps(x.step, y.step);
    const PixelBox& box = result.box;
    const PixelBox needed =
        asset::coarsened(box, steps)
            .grown({x.step > 1 ? asset::splineReach : 0, y.step > 1 ? asset::splineReach : 0});
    BlurPasses passes(layers, input);
    passes.reduce(0, x.step);
    passes.reduce(1, y.step);
    passes.convolve(0, x.kernel, needed.min.x, needed.max.x);
    passes.convolve(1, y.kernel, needed.min.y, needed.max.y);
    passes.enlarge(0, x.step, box.min.x, box.max.x);
    passes.enlarge(1, y.step, box.min.y, box.max.y);
    drawCopy(layers, passes.last(), cut, result);
}

}  // namespace vtm::gl
