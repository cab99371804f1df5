// A filter's result on the raster of the picture below. Requires: layer.glsl, colors.glsl.
// Twin of: raster/filter/run_filter.cpp.

uniform vec4 toLayer;      // pixels of the picture below to the layer's, by columns
uniform vec2 layerOrigin;  // where the corner of the picture below lies in the layer
uniform bool interpolates, isLight;

out vec4 color;

vec4 encodedAt(ivec2 p) { return isLight ? encoded(firstAt(p)) : firstAt(p); }

void main() {
    vec2 at = layerOrigin + toLayer.xy * gl_FragCoord.x + toLayer.zw * gl_FragCoord.y;
    if (!interpolates) {
        color = encodedAt(ivec2(floor(at)));
        return;
    }
    vec2 corner = floor(at - 0.5), share = at - 0.5 - corner;
    ivec2 p = ivec2(corner);
    color = mix(mix(encodedAt(p), encodedAt(p + ivec2(1, 0)), share.x),
                mix(encodedAt(p + ivec2(0, 1)), encodedAt(p + ivec2(1, 1)), share.x), share.y);
}
