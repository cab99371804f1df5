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
    const PixelBox& box = layer.box;
    const auto mean = [&](Float4 a, Float4 b, Float4 c, Float4 d) {
        return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
    };
    if (box.contains(ix, iy) && box.contains(ix + 1, iy + 1)) {
        const Float4* const above = layer.row(iy) + (ix - box.min.x);
        const Float4* const below = above + box.width();
        return mean(above[0], above[1], below[0], below[1]);
    }
    return mean(layer.at(ix, iy), layer.at(ix + 1, iy), layer.at(ix, iy + 1), layer.at(ix + 1, iy + 1));
}

Layer cropped(const Layer& layer, const PixelBox& box) {
    return changed(layer, box, layer.linear, [](Float4 c) { return c; });
}

Layer cropped(Layer&& layer, const PixelBox& box) {
    if (box.min == layer.box.min && box.max == layer.box.max)
        return std::move(layer);
    return cropped(layer, box);
}

Layer converted(const Layer& layer, bool linear) {
    const Curve& curve = linear ? decodingCurve() : encodingCurve();
    return changed(layer, layer.box, linear, [&](Float4 c) {
        if (layer.linear == linear || (c[0] == 0 && c[1] == 0 && c[2] == 0))
            return c;
        const Float4 s = straightened(c);
        return premultiplied(Float4{curve(s[0]), curve(s[1]), curve(s[2]), s[3]});
    });
}

Layer converted(Layer&& layer, bool linear) {
    if (layer.linear == linear)
        return std::move(layer);
    return converted(layer, linear);
}

Layer alphaOf(const Layer& layer) {
    return changed(layer, layer.box, layer.linear, [](Float4 c) { return Float4{0, 0, 0, c[3]}; });
}

}  // namespace vtm::asset
