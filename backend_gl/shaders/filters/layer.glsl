// Layers that a filter's operation reads: transparent beyond their boxes. Requires: constant layerSteps.
// Twin of: raster/filter/layer.hpp.
// Exports: firstAt, secondAt, firstBetween.

uniform usampler2D first, second;
uniform ivec4 firstBox, secondBox;  // xy: from the result's pixel to the input's; zw: the input's size

vec4 layerAt(usampler2D layer, ivec4 box, ivec2 at) {
    ivec2 texel = at + box.xy;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, box.zw)))
        return vec4(0.0);
    return vec4(texelFetch(layer, texel, 0)) / layerSteps;
}

vec4 firstAt(ivec2 at) { return layerAt(first, firstBox, at); }
vec4 secondAt(ivec2 at) { return layerAt(second, secondBox, at); }

// Interpolated between the centres of four pixels.
vec4 firstBetween(vec2 point) {
    if (any(greaterThan(abs(point), vec2(1.0e8))))
        return vec4(0.0);
    vec2 corner = floor(point - 0.5), share = point - 0.5 - corner;
    ivec2 p = ivec2(corner);
    return mix(mix(firstAt(p), firstAt(p + ivec2(1, 0)), share.x),
               mix(firstAt(p + ivec2(0, 1)), firstAt(p + ivec2(1, 1)), share.x), share.y);
}
