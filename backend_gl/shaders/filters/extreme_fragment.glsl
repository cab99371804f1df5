// One step of morphology: the extreme of two pixels; or windows between whole radii.
// Requires: layer.glsl, store.glsl. Twin of: raster/filter/neighbours.cpp.

uniform ivec2 before, after;  // from the pixel to those that are compared
uniform bool dilates;
uniform float between;  // above 0: so much of a window that is a pixel longer at each end

vec4 extreme(vec4 a, vec4 b) { return dilates ? max(a, b) : min(a, b); }

void main() {
    ivec2 p = pixel();
    vec4 ends = extreme(firstAt(p + before), firstAt(p + after));
    if (between > 0.0) {
        vec4 own = firstAt(p);
        ends = mix(own, extreme(ends, own), between);
    }
    store(ends);
}
