// The layer that a filter's operation makes: premultiplied colours in steps of 1/65535. Requires: constant layerSteps.
// Exports: pixel, which counts from the layer's first; store.

uniform vec4 cut;  // in the layer's pixels: min, max of what stays

out uvec4 result;

ivec2 pixel() { return ivec2(gl_FragCoord.xy); }

// The share of a pixel that lies in `cut`.
float shareOf(vec2 at) {
    vec2 sides = clamp(min(at + 1.0, cut.zw) - max(at, cut.xy), 0.0, 1.0);
    return sides.x * sides.y;
}

void store(vec4 color) {
    result = uvec4(clamp(color, 0.0, 1.0) * shareOf(floor(gl_FragCoord.xy)) * layerSteps + 0.5);
}
