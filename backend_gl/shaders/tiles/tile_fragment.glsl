// Blocks whose regions all have solid colours. Requires: cell.glsl, fetch.glsl, output.glsl; TWO_COLORS defined as 1 where there
// are but two, else 0; LONG_LISTS as 1 where cells have many pieces, else 0.

// What pieces change: times 65535; of two colours, in units of what the first pair's do.
#if TWO_COLORS
flat in uvec4 blockMore;  // the first pair, which is a tile's first texel; the other one is its reverse
#define Change float
#else
#define Change vec4
#endif

out vec4 color;

vec4 changeOf(uvec4 pair) {
    return regionValueIn(65535.0, unpackColor(pair.xy)) - regionValueIn(65535.0, unpackColor(pair.zw));
}

// Two colours need not be fetched with each piece. llvmpipe takes a tenth longer if others are fetched behind the weight.
struct Piece {
    uvec4 bits, colors;
};

Piece pieceAt(uint texel) {
    uvec4 bits = tileTexel(texel);
#if TWO_COLORS
    return Piece(bits, uvec4(0u));
#else
    return Piece(bits, tileTexel(bits.w >> 2));
#endif
}

Change changeBy(Piece piece, Cell cell) {
    float weight = pieceWeight(tilePiece(piece.bits.xyz, cell.o), cell.way, piece.bits.w, tileToBox);
#if TWO_COLORS
    return piece.bits.w >> 2 == 0u ? weight : -weight;
#else
    return weight * changeOf(piece.colors);
#endif
}

// Some drivers run a loop's body once more to find that it has ended, unless the condition stands at the bottom. Of long lists
// two pieces are met in a turn, so that one need not wait for the other: llvmpipe takes a seventh less time, but more where
// lists are short or empty.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    List list = listOf(cell);
    Change change = Change(0.0);
    uint met = 0u, all = list.left;
    do {
        if (list.left != 0u) {
#if LONG_LISTS
            uint here = min(list.left, 2u);
            Piece first = pieceAt(list.next), second = pieceAt(list.next + here - 1u);
            change += changeBy(first, cell) + float(here - 1u) * changeBy(second, cell);
#else
            const uint here = 1u;
            change += changeBy(pieceAt(list.next), cell);
#endif
            list.next += here;
            list.left -= here;
            met += here;
        }
    } while (list.left != 0u);
#if TWO_COLORS
    vec4 changes = change * changeOf(blockMore);
#else
    vec4 changes = change;
#endif
    vec4 sum = regionValueIn(65535.0, unpackColor(cell.texel.yz)) + changes;
    color = outputColor(finishedSum(cell, sum / 65535.0, met == all));
}
