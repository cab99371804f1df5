// ConvolveMatrix. Requires: layer.glsl, store.glsl, colors.glsl, numbers.glsl; constants edge*.
// Twin of: raster/filter/neighbours.cpp.

uniform ivec4 region;  // of the input: min, max, in the result's pixels

int wrapped(int v, int low, int high) {
    int size = high - low;
    return v - size * int(floor((float(v - low) + 0.5) / float(size)));
}

vec4 edged(ivec2 p, uint edge) {
    if (any(lessThan(p, region.xy)) || any(greaterThanEqual(p, region.zw))) {
        if (edge == edgeNone)
            return vec4(0.0);
        p = edge == edgeWrap
                ? ivec2(wrapped(p.x, region.x, region.z), wrapped(p.y, region.y, region.w))
                : clamp(p, region.xy, region.zw - 1);
    }
    return firstAt(p);
}

void main() {
    ivec2 p = pixel();
    int columns = int(number(0u)), rows = int(number(1u));
    ivec2 corner = p - ivec2(int(number(2u)), int(number(3u)));
    uint edge = uint(number(6u));
    bool preservesAlpha = number(7u) != 0.0;
    vec4 sum = vec4(0.0), own = firstAt(p);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            vec4 color = edged(corner + ivec2(j, i), edge);
            sum += number(8u + uint((rows - 1 - i) * columns + (columns - 1 - j))) *
                   (preservesAlpha ? straightened(color) : color);
        }
    vec4 color = sum / number(4u) + number(5u) * (preservesAlpha ? 1.0 : own.a);
    if (preservesAlpha)
        color = premultiplied(clamp(vec4(color.rgb, own.a), 0.0, 1.0));
    else
        color = vec4(min(clamp(color.rgb, 0.0, 1.0), clamp(color.a, 0.0, 1.0)), color.a);
    store(color);
}
