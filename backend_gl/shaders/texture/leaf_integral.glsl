// The integral of a leaf's colour over the pixel's box, but for the sign of the frame.
// Requires: fetch.glsl, coverage.glsl, region_color.glsl, placed_paints.glsl; LINEAR, RADIAL, IMAGE, GROUPS, MATERIAL.
// Exports: leafIntegral.

// Of pieceSum()'s loop, at most: straight pieces are one chord.
float pieceTurns(uvec4 piece) { return piece.z == 0u ? 4.0 : float(chordCount) + 5.0; }

// Of what a square has of the pixel's box.
float squareArea(Frame frame) {
    vec2 a = cornerOf(frame, 0), b = cornerOf(frame, 1), c = cornerOf(frame, 2), d = cornerOf(frame, 3);
    return seg(a, b) + seg(b, c) + seg(c, d) + seg(d, a);
}

#if LINEAR || RADIAL || IMAGE || GROUPS || MATERIAL

vec4 numberColor(ASSET_IN inout Recent recent, uint number, vec2 point, mat3x2 pixel) {
    if (onPage)
        return pageColor(number);
    return regionColor(ASSET recent, paintOf(ASSET number), point, pixel);
}

// One loop over the four corners and both sides of every piece, so that the paint interpreter, which
// compilers inline, stands in the program once.
vec4 leafIntegral(ASSET_IN Frame frame, uvec4 leaf, vec2 point, mat3x2 pixel) {
    Recent recent = nothingRecent();
    uvec4 piece = uvec4(0u);
    vec4 sum = vec4(0.0);
    float weight = 0.0;
    uint terms = 4u + 2u * low(leaf.y);
    for (uint i = 0u; i < terms && spend(1.0); ++i) {
        uint paint = high(piece.w);
        if (i < 4u) {
            weight = seg(cornerOf(frame, int(i)), cornerOf(frame, int((i + 1u) & 3u)));
            uint word = i < 2u ? leaf.z : leaf.w;
            paint = (i & 1u) == 0u ? low(word) : high(word);
        } else if ((i & 1u) == 0u) {
            piece = texelAt(ASSET ASSET_PART(sections).y + leaf.x + (i - 4u) / 2u);
            weight = spend(pieceTurns(piece)) ? pieceSum(frame, piece) : 0.0;
            paint = low(piece.w);
        } else {
            weight = -weight;
        }
        if (weight != 0.0)
            sum += weight * numberColor(ASSET recent, paint, point, pixel);
        if (i + 1u == terms)
            break;
    }
    if (isPlaced())
        sum -= squareArea(frame) * numberColor(ASSET recent, 0u, point, pixel);
    return sum;
}

#else

vec4 numberColor(ASSET_IN uint number) {
    return onPage ? pageColor(number) : solidColor(ASSET paintOf(ASSET number));
}

// Twin of pieces_fragment.glsl.
vec4 leafIntegral(ASSET_IN Frame frame, uvec4 leaf, vec2 point, mat3x2 pixel) {
    vec2 a = cornerOf(frame, 0), b = cornerOf(frame, 1), c = cornerOf(frame, 2), d = cornerOf(frame, 3);
    vec4 sum = seg(a, b) * numberColor(ASSET low(leaf.z)) + seg(b, c) * numberColor(ASSET high(leaf.z)) +
               seg(c, d) * numberColor(ASSET low(leaf.w)) + seg(d, a) * numberColor(ASSET high(leaf.w));
    if (isPlaced())
        sum -= squareArea(frame) * numberColor(ASSET 0u);
    uint end = leaf.x + low(leaf.y);
    for (uint i = leaf.x; i < end && spend(1.0); ++i) {
        uvec4 piece = texelAt(ASSET ASSET_PART(sections).y + i);
        float weight = spend(pieceTurns(piece)) ? pieceSum(frame, piece) : 0.0;
        if (weight != 0.0)
            sum += weight * (numberColor(ASSET low(piece.w)) - numberColor(ASSET high(piece.w)));
        if (i + 1u == end)
            break;
    }
    return sum;
}

#endif
