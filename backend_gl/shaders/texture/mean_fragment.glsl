// The mean over a part of the picture, from its maps alone: what pyramids of means are made of. docs/prefilter.md.
// Requires: sample.glsl, whose names have prefixes here.

uniform Vtm vtm_picture;
uniform vec2 vtm_parts;  // how many the picture has, along each axis

out vec4 vtm_mean;

void main() {
    mat2 sides = mat2(vtm_picture.size.x / vtm_parts.x, 0.0, 0.0, vtm_picture.size.y / vtm_parts.y);
    vec4 sum = vec4(0.0);
    vtm_turnsLeft = vtm_turnsOfSample;
    vtm_addFootprint(vtm_picture, vtm_Footprint(gl_FragCoord.xy / vtm_parts, sides, vec2(1.0, 0.0), 1.0, 1.0, false), sum);
    vtm_mean = clamp(sum, 0.0, 1.0);
}
