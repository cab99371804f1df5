// A tile with paint programs. Requires: cell.glsl, fetch.glsl, paint.glsl, output.glsl, shadow.glsl, shares.glsl.

uniform float minSteepness;  // paints above it are evaluated in the quarters of pixels, too

out vec4 color;

// A piece whose weight is not an integer cuts the pixel.
bool isFraction(float weight) { return abs(weight - floor(weight + 0.5)) > minWeight; }

// ---- The pixel and its quarters -------------------------------------------------------------------

// Part 0 is the whole pixel, parts 1 to 4 are its quarters.
const uint quarterCount = 4u;

// Centre of a part, tile sides.
vec2 centreOf(uint part) {
    uint quarter = part - 1u;
    return tilePoint(gl_FragCoord.xy + (part == 0u ? vec2(0.0) : vec2(quarter & 1u, quarter >> 1) * 0.5 - 0.25));
}

// Weight of a piece in the whole pixel; in a quarter, a fourth of what it weighs more there than in the whole. The
// pixel's centre is the quarter's reference point.
float weightIn(uint part, TilePiece piece, uvec4 bits, Cell cell) {
    bool whole = part == 0u;
    uint sides = sidesOf(piece);
    float weight = pieceWeight(piece, whole ? cell.way : vec2(0.0), whole ? bits.w : sides, tileToBox);
    if (whole)
        return weight;
    vec2 centre = centreOf(part);
    return 0.25 * (pieceWeight(tilePiece(bits.xyz, centre), centre - cell.o, sides, 2.0 * tileToBox) - weight);
}

// What a share adds to the sum.
vec4 valueOf(Share share, uint part) {
    if (share.paint == noPaint)
        return vec4(0.0);
    vec2 point = picturePoint(centreOf(part));
    vec4 sides = (part == 0u ? 1.0 : 0.5) * tileSide * pixelToTile;
    return share.weight * regionValue(paintColor(share.paint, point, mat3x2(sides.xy, sides.zw, point)));
}

// First the whole pixel. Then, if a piece beside a steep paint cuts it, the quarters: steep paints have other colours
// and other weights there, and shares of others do not count. The inner loop adds up weights until a share has to be
// shaded, the outer one shades it: so the paint interpreter, which compilers inline, stands in the program once, and
// outside of the loop over pieces. That matters to drivers that run both sides of every branch. Such drivers also run a
// loop's body once more to find that it has ended, unless the condition stands at the bottom.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    uint paint = low(cell.texel.x);
    List all = listOf(cell), list = all;
    // Each turn but the last of a part shades a share: at most two of a piece, and the two that are kept at the end.
    uint turns = (1u + quarterCount) * (2u * all.left + 2u);
    Shares shares = Shares(Share(paint, 1.0, true), noShare, noShare, noShare);
    uint part = 0u;
    bool cut = false, complete = false;
    vec4 sum = vec4(0.0);
    do {
        do {
            if (list.left != 0u && shares.waiting.paint == noPaint) {
                uvec4 bits = nextPiece(list);
                TilePiece piece = tilePiece(bits.xyz, cell.o);
                uvec4 pair = tileTexel((bits.w >> 2) + 1u);
                bvec2 steep = greaterThan(uintBitsToFloat(pair.yz), vec2(minSteepness));
                float weight = weightIn(part, piece, bits, cell);
                if (part == 0u)
                    cut = cut || isFraction(weight) && any(steep);
                if (part == 0u ? weight != 0.0 : mayMeetPixel(piece)) {
                    add(shares, Share(low(pair.x), weight, part == 0u || steep.x));
                    add(shares, Share(high(pair.x), -weight, part == 0u || steep.y));
                }
            }
        } while (list.left != 0u && shares.waiting.paint == noPaint);
        if (shares.waiting.paint == noPaint)
            evictAll(shares);
        sum += valueOf(shares.waiting, part);
        shares.waiting = shares.last;
        shares.last = noShare;
        if (list.left == 0u && shares.waiting.paint == noPaint && shares.newer.paint == noPaint) {
            complete = part == (cut ? quarterCount : 0u);
            ++part;
            list = all;
            shares.newer = Share(paint, 0.0, false);
        }
    } while (!complete && --turns != 0u);
    color = outputColor(finishedSum(cell, sum, complete));
}
