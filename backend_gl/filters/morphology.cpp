#include <algorithm>
#include <cmath>
#include <utility>

#include "backend_gl/filters/operations.hpp"

namespace vtm::gl {

namespace {

/// Extremes along one axis. A window of 2^n pixels is one of two of half the length, so that the passes grow
/// with the logarithm of the radius.
class ExtremePasses {
public:
    ExtremePasses(FilterLayers& layers, bool dilates) : layers_(layers), dilates_(dilates) {}

    /// Along axis 0 or 1, over pixels [first, end). `radius` in pixels; between whole ones the result is
    /// interpolated.
    FilterLayer along(int axis, const FilterLayer& input, double radius, int first, int end) {
        const int low = int(std::floor(radius)), window = 2 * low + 1;
        const auto between = float(radius - std::floor(radius));
        const FilterLayer* last = &input;
        FilterLayer own;
        const auto next = [&](FilterLayer made) {
            layers_.giveBack(std::exchange(own, std::move(made)));
            last = &own;
        };
        // Windows of `length` pixels from each pixel on.
        int length = 1;
        for (; 2 * length <= window; length *= 2)
            next(drawn(axis, *last, first - low - 1, end + low + 1, 0, length, 0));
        // Round each pixel, and one pixel more at each end for what lies between.
        const int more = between > 0 ? 1 : 0;
        next(drawn(axis, *last, first - more, end + more, -low, low - length + 1, 0));
        if (between > 0)
            next(drawn(axis, *last, first, end, -1, 1, between));
        return own;
    }

private:
    FilterLayer drawn(int axis, const FilterLayer& from, int first, int end, int before, int after,
                      float between) {
        PixelBox box = from.box;
        box.min[axis] = first;
        box.max[axis] = end;
        FilterLayer to = layers_.make(box, from.linear);
        if (to.empty())
            return to;
        FilterLayers::Pass pass = layers_.pass(FilterProgram::Extreme, to);
        pass.first(from);
        const auto set = [&](const char* name, int by) {
            glUniform2i(pass.uniform(name), axis == 0 ? by : 0, axis == 0 ? 0 : by);
        };
        set("before", before);
        set("after", after);
        glUniform1i(pass.uniform("dilates"), dilates_);
        glUniform1f(pass.uniform("between"), between);
        pass.draw();
        return to;
    }

    FilterLayers& layers_;
    bool dilates_;
};

}  // namespace

void drawExtremes(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    const FilterLayer& input = *step.inputs[0];
    const PixelBox& box = result.box;
    // Nothing changes beyond windows that hold the whole picture.
    const double x = std::min(step.parameters[0] * step.place.scale.x,
                              double(input.box.width() + box.width())),
                 y = std::min(step.parameters[1] * step.place.scale.y,
                              double(input.box.height() + box.height()));
    if (input.empty() || (x == 0 && y == 0))
        return drawCopy(layers, input, step.own, result);
    ExtremePasses passes(layers, step.parameters[2] != 0);
    FilterLayer rows = passes.along(0, input, x, box.min.x, box.max.x);
    FilterLayer both = passes.along(1, rows, y, box.min.y, box.max.y);
    drawCopy(layers, both, step.own, result);
    layers.giveBack(std::move(rows));
    layers.giveBack(std::move(both));
}

}  // namespace vtm::gl
