// One quad an instance: the pixels that a square of a map's tree can meet.
// Requires: fetch.glsl; constants maxLevel, leafExtent, placementColumns.
// Exports: the placement of the leaf under the view, flat, to leaf_placement.glsl.

layout(location = 0) in uvec4 cell;  // x, y, level | map << 4, entry

uniform highp sampler2D placements;  // of maps, four texels each: see core/placement.hpp
uniform vec2 targetSize;

flat out vec4 leafLinear;   // leaf steps to pixels, by columns
flat out vec4 leafInverse;  // pixels to leaf steps
flat out vec3 leafOrigin;   // pixels; z: sign of the determinant
flat out uint leafEntry;

vec4 placement(uint map, uint texel) {
    uint index = map * 4u + texel;
    return texelFetch(placements, ivec2(index & (placementColumns - 1u), index / placementColumns), 0);
}

void main() {
    uint map = cell.z >> 4, level = cell.z & 15u;
    vec4 linear = placement(map, 0u), base = placement(map, 1u), box = placement(map, 2u);

    // Squares of the deepest level are the unit: 2^24 a side, so floats hold them exactly, and only
    // differences from a base near the view meet the matrix.
    uint units = 1u << (2u * (maxLevel - level));
    vec2 fromBase = vec2(ivec2(cell.xy * units) - ivec2(base.zw));
    float steps = float(units) / float(leafExtent);
    mat2 toPixels = mat2(linear.xy, linear.zw);
    vec2 origin = base.xy + toPixels * fromBase;
    vec2 x = linear.xy * float(units), y = linear.zw * float(units);

    mat2 m = toPixels * steps;
    float determinant = m[0].x * m[1].y - m[1].x * m[0].y;
    leafLinear = vec4(m[0], m[1]);
    leafInverse = vec4(m[1].y, -m[0].y, -m[1].x, m[0].x) / determinant;
    leafOrigin = vec3(origin, sign(determinant));
    leafEntry = cell.w;

    // Whole pixels, so that every pixel whose box meets the leaf has its centre inside the quad.
    vec2 lower = floor(origin + min(x, vec2(0.0)) + min(y, vec2(0.0)));
    vec2 upper = ceil(origin + max(x, vec2(0.0)) + max(y, vec2(0.0)));
    vec2 corner = mix(lower, upper, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    gl_Position = vec4(clamp(corner, box.xy, box.zw) / targetSize * 2.0 - 1.0, 0.0, 1.0);
}
