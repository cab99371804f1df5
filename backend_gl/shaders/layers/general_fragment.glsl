// Any entry whose paints include programs. Requires: leaf_placement.glsl, fetch.glsl, leaf_integral.glsl.

uniform float leastSteep;  // the steepness from which on a paint is asked for quarters of pixels
uniform float steepest;    // that of the asset's steepest paint

out vec4 color;

uvec4 leafTexel() {
    uint payload = leafEntry >> 2;
    if ((leafEntry & 3u) == kindSolid)
        return uvec4(0u, 0u, uvec2(payload | payload << 16));
    return texelAt(sections.x + payload);
}

// The whole pixel, and what its quarters make of it where a paint is steep, as the evaluator does: what the leaf has of
// each, less what it has of the whole, in the quarter's colours. One loop, so that the paint interpreter stands in the
// program once.
void main() {
    Frame frame = leafFrame();
    Overlap overlap = overlapOf(frame);
    if (overlap.empty)
        discard;
    uvec4 leaf = leafTexel();
    bool cut = !overlap.whole || low(leaf.y) != 0u;
    vec4 sum = vec4(0.0);
    for (int i = 0;; ++i) {
        int k = (i - 1) >> 1;
        vec2 corner = vec2(k & 1, k >> 1);
        mat3x2 pixel = i == 0 ? picturePixel(frame, vec2(0.5), 1.0) : picturePixel(frame, 0.25 + 0.5 * corner, 0.5);
        bool isQuarter = i > 0 && (i & 1) == 0;
        Frame box = frame;
        if (isQuarter)
            box = Frame(2.0 * frame.linear, 2.0 * frame.origin - corner);
        float weight = i == 0 ? 1.0 : isQuarter ? 0.25 : -0.25;
        sum += weight * leafIntegral(box, leaf, pixel[2], pixel, i == 0 ? -1.0 : leastSteep);
        if (i == 8 || !cut || steepest <= leastSteep)
            break;
    }
    color = leafOrigin.z * sum;
}
