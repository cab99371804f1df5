// A filter's result on the raster of the picture below. Requires: layer.glsl, colors.glsl;
// constant variant, 1 where the result is interpolated, which takes encoded colours, else 0.
// Twin of: raster/filter/run_filter.cpp.

uniform vec4 toLayer;      // pixels of the picture below to the layer's, by columns
uniform vec2 layerOrigin;  // where the corner of the picture below lies in the layer
uniform bool isLight;

out vec4 color;

void main() {
    vec2 at = layerOrigin + toLayer.xy * gl_FragCoord.x + toLayer.zw * gl_FragCoord.y;
    vec4 there = variant == 0u ? firstAt(ivec2(floor(at))) : firstBetween(at);
    color = variant == 0u && isLight ? encoded(there) : there;
}
