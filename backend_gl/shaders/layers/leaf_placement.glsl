// Where this fragment's pixel lies in the leaf.
// Requires: coverage.glsl, leaf_vertex.glsl's outputs. Twin of: raster/src/draw_map.cpp.
// Exports: leafFrame, Overlap, overlapOf, picturePixel.

flat in vec4 leafLinear;
flat in vec4 leafInverse;
flat in vec3 leafOrigin;
flat in vec3 leafPicture;
flat in uint leafEntry;
flat in vec4 leafColor;

Frame leafFrame() {
    return Frame(mat2(leafLinear.xy, leafLinear.zw), leafOrigin.xy - floor(gl_FragCoord.xy));
}

// The part of the leaf that the bounding box (in leaf coordinates) of the pixel's box meets.
struct Overlap {
    vec2 least, most;
    bool empty;  // the pixel does not meet the leaf
    bool whole;  // the pixel lies inside the leaf
};

Overlap overlapOf(Frame frame) {
    mat2 inverse2 = mat2(leafInverse.xy, leafInverse.zw);
    vec2 centre = inverse2 * (vec2(0.5) - frame.origin);
    vec2 halfSize = (abs(leafInverse.xy) + abs(leafInverse.zw)) * 0.5;
    vec2 least = centre - halfSize, most = centre + halfSize;
    bool whole = all(greaterThanEqual(least, vec2(0.0))) && all(lessThanEqual(most, vec2(leafExtent)));
    least = max(least, vec2(0.0));
    most = min(most, vec2(leafExtent));
    return Overlap(least, most, any(greaterThanEqual(least, most)), whole);
}

// The sides, in the picture, and the centre of a square of the pixel: the middle is a point of it in [0, 1]².
mat3x2 picturePixel(Frame frame, vec2 middle, float side) {
    vec2 centre = mat2(leafInverse.xy, leafInverse.zw) * (middle - frame.origin);
    float scale = side * leafPicture.z;
    return mat3x2(scale * leafInverse.xy, scale * leafInverse.zw, leafPicture.xy + leafPicture.z * centre);
}
