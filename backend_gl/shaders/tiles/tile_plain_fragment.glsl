// A tile of plain paints that change little over a pixel: in its middle they have about their mean over it.
// Requires: cell.glsl, plain_paint.glsl, shadow.glsl, shares.glsl, output.glsl.

out vec4 color;

// Colours are added to the sum at once, plain programs to the shares.
void addPaint(inout Shares shares, inout vec4 sum, uvec2 paint, float weight) {
    if (paint.y == plainTag)
        add(shares, Share(paint.x, weight, true));
    else
        sum += weight / 65535.0 * regionValueIn(65535.0, unpackColor(paint));
}

// The inner loop adds up weights until a share has to be shaded, the outer one shades it, as in tile_programs_fragment.glsl.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    List list = listOf(cell);
    // Each turn but the last shades a share: at most two of a piece, and the two that are kept at the end.
    uint turns = 2u * list.left + 2u;
    Shares shares = Shares(noShare, noShare, noShare, noShare);
    vec4 sum = vec4(0.0);
    addPaint(shares, sum, cell.texel.yz, 1.0);
    bool complete = false;
    do {
        do {
            if (list.left != 0u && shares.waiting.paint == noPaint) {
                uvec4 bits = nextPiece(list), pair = tileTexel(bits.w >> 2);
                float weight = pieceWeight(tilePiece(bits.xyz, cell.o), cell.way, bits.w, tileToBox);
                if (weight != 0.0) {
                    addPaint(shares, sum, pair.xy, weight);
                    addPaint(shares, sum, pair.zw, -weight);
                }
            }
        } while (list.left != 0u && shares.waiting.paint == noPaint);
        if (shares.waiting.paint == noPaint)
            evictAll(shares);
        if (shares.waiting.paint != noPaint)
            sum += shares.waiting.weight * regionValue(plainColor(shares.waiting.paint, cell.o));
        shares.waiting = shares.last;
        shares.last = noShare;
        complete = list.left == 0u && shares.waiting.paint == noPaint && shares.newer.paint == noPaint;
    } while (!complete && --turns != 0u);
    color = outputColor(finishedSum(cell, sum, complete));
}
