// Masks of the paper mode: the 16-tree, strict cells and the mip of the classification function.
// Requires: fetch.glsl, paper_hermite.glsl; SURFACE, MIPS defined as 1 or 0;
// constants paper*, kindNode, kindSolid. Positions are in single precision: a view may
// show a pixel of 2^-20 of the picture, no less.
// Twin of: paper/evaluate/cell.cpp, paper/evaluate/mask.cpp.
// Exports: maskCoverage, pixelNormals, pixelLonger, pictureSize.

// Picture gradients to pixel gradients, and the longer of the pixel's axes in picture units: the view's, or of each pixel
// of a surface.
#if SURFACE
mat2 pixelNormals;
float pixelLonger;
#else
uniform mat2 pixelNormals;
uniform float pixelLonger;
#endif
uniform vec2 pictureSize;
// First texel of the masks, of the nodes, from the start of the data.
uniform uvec2 paperSections;

uvec4 dataAt(uint texel) { return texelAt(sections.w + texel); }

struct Mask {
    vec2 corner;
    float side;
    uint root;
    uint nodes, cells, mip;  // first texels
    uint mipLog2;
};

Mask maskAt(uint index) {
    uvec4 a = dataAt(paperSections.x + 2u * index), b = dataAt(paperSections.x + 2u * index + 1u);
    vec3 place = uintBitsToFloat(a.xyz);
    return Mask(place.xy, place.z, a.w, b.x, b.y, b.z, b.w);
}

// ---- Cells (rows 1, 2, 6) -------------------------------------------------------------------------

// Signed distance in pixels, above zero outside; `scale` is the cell's side, margin included, in picture units.
float pieceDistance(uvec4 piece, vec2 point, float scale) {
    vec2 a = vec2(low(piece.x), high(piece.x)) / paperExtent;
    vec2 chord = vec2(low(piece.y), high(piece.y)) / paperExtent - a;
    vec2 slopes = vec2(int(piece.z << 16) >> 16, int(piece.z) >> 16) / paperSlopeScale;
    vec2 along = chord / dot(chord, chord), across = vec2(-along.y, along.x), p = point - a;
    vec2 t = hermite(slopes, dot(p, along));
    return -(dot(p, across) - t.x) * scale / length(pixelNormals * (across - t.y * along));
}

float cellCoverage(Mask mask, vec2 uv) {
    if (uv.x < 0.0 || uv.y < 0.0 || uv.x >= 1.0 || uv.y >= 1.0)
        return 0.0;
    uint entry = mask.root;
    float side = mask.side;
    while ((entry & 3u) == kindNode) {
        uv *= 4.0;
        uvec2 child = min(uvec2(uv), uvec2(3u));
        uv -= vec2(child);
        side *= 0.25;
        entry = dataAt(mask.nodes + 4u * (entry >> 2) + child.y)[child.x];
    }
    if ((entry & 3u) == kindSolid)  // early out, row 9
        return float(entry >> 2);
    uint cell = mask.cells + 2u * (entry >> 2);
    uvec4 first = dataAt(cell);
    float grown = 1.0 + 2.0 * paperMargin;
    vec2 point = (uv + paperMargin) / grown;
    float h = pieceDistance(first, point, side * grown);
    if (first.w != 0u) {
        float other = pieceDistance(dataAt(cell + 1u), point, side * grown);
        h = first.w == paperIntersection ? max(h, other) : -max(-h, -other);
    }
    return clamp(0.5 - h, 0.0, 1.0);
}

#if MIPS
// ---- The mip (row 7) ------------------------------------------------------------------------------

float mipTexel(uint first, uint index) {
    uint word = dataAt(first + (index >> 4))[(index >> 2) & 3u];
    return float((word >> (8u * (index & 3u))) & 0xFFu) / 255.0;
}

uint mipStart(uint sizeLog2, uint level) {
    return ((1u << (2u * (sizeLog2 + 1u))) - (1u << (2u * (sizeLog2 - level + 1u)))) / 3u;
}

float storedLevel(Mask mask, uint level, vec2 uv) {
    int size = 1 << (mask.mipLog2 - level);
    uint start = mipStart(mask.mipLog2, level);
    vec2 p = clamp(uv * float(size) - 0.5, vec2(-2.0), vec2(size + 1)), corner = floor(p);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 q = ivec2(corner) + ivec2(i & 1, i >> 1);
        if (q.x < 0 || q.y < 0 || q.x >= size || q.y >= size)
            continue;
        vec2 weight = 1.0 - abs(p - vec2(q));
        sum += weight.x * weight.y * mipTexel(mask.mip, start + uint(q.y * size + q.x));
    }
    return sum;
}

float mipLevel(Mask mask, uint k, vec2 uv) {
    if (k - 1u <= mask.mipLog2)
        return storedLevel(mask, k - 1u, uv);
    float shrink = exp2(-float(k - 1u - mask.mipLog2));
    vec2 weight = max(vec2(0.0), 1.0 - abs(uv - 0.5) * shrink);
    return weight.x * weight.y * shrink * shrink * mipTexel(mask.mip, mipStart(mask.mipLog2, mask.mipLog2));
}

#endif
// ---- Both -----------------------------------------------------------------------------------------

// Of one picture.
float singleCoverage(Mask mask, vec2 point) {
    vec2 uv = (point - mask.corner) / mask.side;
    float longer = pixelLonger / mask.side;
    vec2 away = abs(uv - 0.5);
    if (max(away.x, away.y) >= 0.5 + 2.0 * longer)
        return 0.0;
#if !MIPS
    return cellCoverage(mask, uv);
#else
    float lod = min(log2(longer) + float(mask.mipLog2) + 1.0, paperMaxLod);
    if (lod <= 0.0)
        return cellCoverage(mask, uv);
    float base = floor(lod);
    float finer = base == 0.0 ? cellCoverage(mask, uv) : mipLevel(mask, uint(base), uv);
    return mix(finer, mipLevel(mask, uint(base) + 1u, uv), lod - base);
#endif
}

float maskCoverage(uint index, vec2 point) {
    Mask mask = maskAt(index);
#if SURFACE
    // Of a picture that repeats: its share of a period takes over as a pixel grows from half of one to all of it.
    vec2 share = mask.side / pictureSize;
    float mean = share.x * share.y * mipTexel(mask.mip, mipStart(mask.mipLog2, mask.mipLog2));
    float periods = pixelLonger / min(pictureSize.x, pictureSize.y);
    return mix(singleCoverage(mask, point), mean, clamp(log2(periods) + 1.0, 0.0, 1.0));
#else
    return singleCoverage(mask, point);
#endif
}
