// Where this fragment's pixel lies in the leaf.
// Requires: coverage.glsl, leaf_vertex.glsl's outputs. Twin of: raster/src/draw_map.cpp.
// Exports: leafFrame, Overlap, overlapOf.

flat in vec4 leafLinear;
flat in vec4 leafInverse;
flat in vec3 leafOrigin;
flat in uint leafEntry;

Frame leafFrame() {
    return Frame(mat2(leafLinear.xy, leafLinear.zw), leafOrigin.xy - floor(gl_FragCoord.xy));
}

struct Overlap {
    bool empty;  // the bounding box, in leaf coordinates, of the pixel's box does not meet the leaf
    bool whole;  // it lies inside the leaf
};

Overlap overlapOf(Frame frame) {
    vec2 centre = mat2(leafInverse.xy, leafInverse.zw) * (vec2(0.5) - frame.origin);
    vec2 halfSize = (abs(leafInverse.xy) + abs(leafInverse.zw)) * 0.5;
    vec2 lower = centre - halfSize, upper = centre + halfSize;
    bool empty = any(lessThanEqual(upper, vec2(0.0))) || any(greaterThanEqual(lower, vec2(leafExtent)));
    bool whole = all(greaterThanEqual(lower, vec2(0.0))) && all(lessThanEqual(upper, vec2(leafExtent)));
    return Overlap(empty, whole);
}
