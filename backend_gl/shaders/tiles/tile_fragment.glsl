// A tile whose regions all have solid colours. Requires: cell.glsl, fetch.glsl, output.glsl; TWO_COLORS defined as 1 where
// there are but two, else 0.

#if TWO_COLORS
flat in uvec4 tilePair;  // beside pieces of the first pair, which is the tile's first texel; the other one is its reverse
#endif

out vec4 color;

// What a pair's pieces change, times 65535.
vec4 changeOf(uvec4 pair) {
    return regionValueIn(65535.0, unpackColor(pair.xy)) - regionValueIn(65535.0, unpackColor(pair.zw));
}

// Some drivers run a loop's body once more to find that it has ended, unless the condition stands at the bottom. Two colours
// need not be fetched with each piece.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    List list = listOf(cell);
    vec4 sum = regionValueIn(65535.0, unpackColor(cell.texel.yz));
#if TWO_COLORS
    float first = 0.0;
#endif
    uint met = 0u, all = list.left;
    do {
        if (list.left != 0u) {
            uvec4 bits = nextPiece(list);
#if !TWO_COLORS
            uvec4 colors = tileTexel(bits.w >> 2);  // llvmpipe takes a tenth longer if it is fetched behind the weight
#endif
            float weight = pieceWeight(tilePiece(bits.xyz, cell.o), cell.way, bits.w, tileToBox);
#if TWO_COLORS
            first += bits.w >> 2 == 0u ? weight : -weight;
#else
            sum += weight * changeOf(colors);
#endif
            ++met;
        }
    } while (list.left != 0u);
#if TWO_COLORS
    sum += first * changeOf(tilePair);
#endif
    color = outputColor(finishedSum(cell, sum / 65535.0, met == all));
}
