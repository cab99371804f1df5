// A tile with paint programs. Requires: cell.glsl, fetch.glsl, paint.glsl, output.glsl.

uniform float leastSteep;  // the steepness from which on a paint is asked for quarters of pixels

out vec4 color;

bool isSteep(uint paint) { return isSteep(paint, leastSteep); }

// Weights nearer to 0 are roundings. A piece whose weight is no whole number cuts the pixel.
const float leastShare = 1e-5;

bool isPart(float weight) { return abs(weight - floor(weight + 0.5)) > leastShare; }

// Where a quarter's middle lies, tile sides.
vec2 quarterPoint(int k) { return tilePoint(gl_FragCoord.xy + vec2(k & 1, k >> 1) * 0.5 - 0.25); }

// A fourth of what a piece weighs more in each quarter than in the whole: R is the pixel's own middle here.
vec4 moreInQuarters(uvec3 bits, vec2 o) {
    TilePiece piece = tilePiece(bits, o);
    uint sides = sidesOf(piece);
    vec4 weights = vec4(0.0);
    for (int k = 0;; ++k) {
        vec2 quarter = quarterPoint(k);
        weights[k] = pieceWeight(tilePiece(bits, quarter), quarter - o, sides, 2.0 * tileToBox);
        if (k == 3)
            break;
    }
    return 0.25 * (weights - pieceWeight(piece, vec2(0.0), sides, tileToBox));
}

// A cell's references, one after the other.
struct List {
    uvec4 references;
    uint i;
    bool atEnd;
    uint met, all;
};

// 0 at the end.
uint nextReference(inout List list) {
    if (list.i == referenceCount(list.references) && (list.references.x & moreBit) != 0u) {
        list.references = tileTexel(list.references.w);
        list.i = 0u;
        list.all = max(list.all, referencesFrom(list.references));
    }
    list.atEnd = list.i == referenceCount(list.references);
    list.met += list.atEnd ? 0u : 1u;
    return list.atEnd ? 0u : referenceAt(list.references, list.i++);
}

// A paint and what pieces weigh that have it on their left, less those that have it on their right: in the pixel, or in
// its quarters.
struct Share {
    uint paint;
    vec4 weights;
};

const uint noPaint = 0xFFFFFFFFu;

bool isSomething(Share share) { return any(greaterThan(abs(share.weights), vec4(leastShare))); }

// Times the colours there, of the pixel or of its quarters.
vec4 valueOf(Share share, Cell cell, bool quarters) {
    vec4 sum = vec4(0.0);
    for (int k = 0;; ++k) {
        vec2 point = tilePicture.xy + tilePicture.z * (quarters ? quarterPoint(k) : cell.o);
        vec4 sides = (quarters ? 0.5 : 1.0) * tilePicture.z * pixelToTile;
        if (abs(share.weights[k]) > leastShare)
            sum += share.weights[k] * regionValue(paintColor(share.paint, point, mat3x2(sides.xy, sides.zw, point)));
        if (!quarters || k == 3)
            break;
    }
    return sum;
}

// First the whole pixel. Then, where a piece beside a steep paint cuts it, what its quarters make of that: steep paints
// have other colours and other shares there. The last two paints, mostly the two sides of a chain of pieces, are kept
// while they go on; one that is driven out is drawn, unless nothing is left of it. So the paint interpreter, which
// compilers inline, stands in the program once, and beside the loop over pieces: some drivers run both sides of every
// branch, and loops once after their end unless that is told at the bottom.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    bool cut = false, quarters = false;
    uint passes = 0u;
    vec4 sum = vec4(0.0);
    for (;;) {
        List list = List(firstReferences(cell), 0u, false, 0u, 0u);
        list.all = referencesFrom(list.references);
        Share recent = Share(isFlatTile() ? tileTexels.z - 1u : low(cell.texel.x), vec4(quarters ? 0.0 : 1.0));
        Share older = Share(noPaint, vec4(0.0));
        uvec2 paints = uvec2(noPaint);
        vec4 weights = vec4(0.0);
        uint side = 1u;
        for (;;) {
            Share drawn = Share(noPaint, vec4(0.0));
            for (;;) {
                side ^= 1u;
                if (side == 0u) {
                    uvec4 piece = uvec4(0u);
                    for (;;) {
                        bool matters = true;
                        uint reference = nextReference(list);
                        if (!list.atEnd) {
                            piece = tileTexel(reference >> 2 << 1);
                            TilePiece p = tilePiece(piece.xyz, cell.o);
                            float weight = quarters ? 0.0 : pieceWeight(p, cell.way, reference, tileToBox);
                            weights = vec4(weight);
                            cut = cut || isPart(weight) && (isSteep(low(piece.w)) || isSteep(high(piece.w)));
                            matters = quarters ? mayMeetPixel(p) : weight != 0.0;
                        }
                        if (matters)
                            break;
                    }
                    // After the last piece one of no paints drives out what is there.
                    paints = list.atEnd ? uvec2(noPaint, noPaint - 1u) : uvec2(low(piece.w), high(piece.w));
                    if (list.atEnd)
                        weights = vec4(0.0);
                    else if (quarters)
                        weights = moreInQuarters(piece.xyz, cell.o);
                }
                Share term = Share(paints[side], side == 0u ? weights : -weights), last = older;
                if (term.paint == recent.paint) {
                    recent.weights += term.weights;
                } else {
                    older = recent;
                    recent = term;
                    if (term.paint == last.paint)
                        recent.weights += last.weights;
                    else if (isSomething(last) && (!quarters || isSteep(last.paint)))
                        drawn = last;
                }
                if (drawn.paint != noPaint || list.atEnd && side == 1u)
                    break;
            }
            sum += valueOf(drawn, cell, quarters);
            if (list.atEnd && side == 1u)
                break;
        }
        passes += list.met == list.all ? 1u : 0u;
        if (quarters || !cut)
            break;
        quarters = true;
    }
    color = outputColor(finishedSum(cell, sum, passes == (cut ? 2u : 1u)));
}
