#include "raster/filter/layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "raster/filter/curves.hpp"

namespace vtm::asset {

Float4 bilinear(const Layer& layer, float x, float y) {
    const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
    if (!(std::abs(left) < 1e8f && std::abs(top) < 1e8f))
        return Float4{};
    const float u = x - 0.5f - left, v = y - 0.5f - top;
    const int ix = int(left), iy = int(top);
    const Float4 above = (1 - u) * layer.at(ix, iy) + u * layer.at(ix + 1, iy);
    const Float4 below = (1 - u) * layer.at(ix, iy + 1) + u * layer.at(ix + 1, iy + 1);
    return (1 - v) * above + v * below;
}

Layer cropped(Layer layer, const PixelBox& box) {
    if (box.min == layer.box.min && box.max == layer.box.max)
        return layer;
    Layer result(box, layer.linear);
    const PixelBox both = box.intersection(layer.box);
    for (int y = both.min.y; y < both.max.y && !both.empty(); ++y)
        std::copy_n(layer.row(y) + (both.min.x - layer.box.min.x), both.width(),
                    result.row(y) + (both.min.x - box.min.x));
    return result;
}

Layer converted(Layer layer, bool linear) {
    if (layer.linear == linear)
        return layer;
    layer.linear = linear;
    const Curve& curve = linear ? decodingCurve() : encodingCurve();
    changePixels(layer, [&](Float4 c) {
        if (c[0] == 0 && c[1] == 0 && c[2] == 0)
            return c;
        const Float4 s = straightened(c);
        return premultiplied(Float4{curve(s[0]), curve(s[1]), curve(s[2]), s[3]});
    });
    return layer;
}

Layer alphaOf(Layer layer) {
    changePixels(layer, [](Float4 c) { return Float4{0, 0, 0, c[3]}; });
    return layer;
}

}  // namespace vtm::asset
