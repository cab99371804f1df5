// A square of the tree added up: the integral of its colour over the pixel's box.
// Requires: fetch.glsl, coverage.glsl, paint.glsl, placed_paints.glsl; LINEAR, RADIAL, IMAGE, GROUPS, MATERIAL.
// Exports: PROGRAMS, Square, squareArea; where PROGRAMS is 0: leafIntegral, else LeafSum, noLeaf, leafOf, isFinished, addAreas,
// addColors, needsProgram, addProgram.

#define PROGRAMS (LINEAR || RADIAL || IMAGE || GROUPS || MATERIAL)

// Of a tree, over the pixel's box [0, 1]².
struct Square {
    Frame frame;
    uvec4 leaf;   // its record; a solid square has one without pieces
    vec2 point;   // of the picture, where programs are evaluated: in the middle of what the box has of the square
    float turn;   // -1 if the frame mirrors
};

// Of what a square has of the pixel's box; by corner, each with the side to the next.
vec4 cornerAreas(Frame frame) {
    vec2 a = cornerOf(frame, 0), b = cornerOf(frame, 1), c = cornerOf(frame, 2), d = cornerOf(frame, 3);
    return vec4(seg(a, b), seg(b, c), seg(c, d), seg(d, a));
}
float squareArea(Frame frame) { return dot(cornerAreas(frame), vec4(1.0)); }

// ---- Chains of pieces ------------------------------------------------------------------------------------

// A leaf is all of its first corner's paint, with what pieces change: each has its loop closed along the leaf's sides up to
// the first corner, which gives the same sum as the four corners' paints with loops up to the next corner. The pieces of a
// chain, each of which starts where the one before ends, have the same paints, so their loops are closed, and their colours
// looked up, once.
struct Pieces {
    uint next, end;
    vec4 behind;  // areas along the sides that follow each side, up to the first corner
};

Pieces piecesOf(uvec4 leaf, vec4 corners) {
    return Pieces(leaf.x, leaf.x + low(leaf.y), vec4(corners.y + corners.z + corners.w, corners.zw + vec2(corners.w, 0.0), 0.0));
}

// From a point on a side to the first corner; 0 inside.
float toFirstCorner(Frame frame, vec4 behind, uint point) {
    int side = sideOf(point);
    float sides = mix(mix(mix(0.0, behind.z, side == 2), behind.y, side == 1), behind.x, side == 0);
    return alongSide(frame, point) + sides;
}

// Of curveSum()'s loop, at most: straight pieces are one chord.
float pieceTurns(uvec4 piece) { return piece.z == 0u ? 3.0 : float(chordCount) + 4.0; }

// ---- Paints that are solid -------------------------------------------------------------------------------

#if !PROGRAMS

// On the left of a chain, whose first piece has been read; the first piece of the next one takes its place.
float chainArea(ASSET_IN Frame frame, inout Pieces pieces, inout uvec4 piece) {
    uvec4 last = piece;
    float area = -toFirstCorner(frame, pieces.behind, piece.x);
    while (spend(1.0)) {
        last = piece;
        area += spend(pieceTurns(piece)) ? curveSum(frame, piece) : 0.0;
        ++pieces.next;
        piece = texelAt(ASSET SECTIONS.y + pieces.next);
        if (pieces.next == pieces.end || piece.x != last.y || piece.w != last.w)
            break;
    }
    return area + toFirstCorner(frame, pieces.behind, last.y);
}

vec4 numberColor(ASSET_IN uint number) {
    return onPage ? pageColor(number) : solidColor(ASSET paintOf(ASSET number));
}

vec4 leafIntegral(Vtm vtm, Square square) {
    uvec4 leaf = square.leaf;
    vec4 corners = cornerAreas(square.frame), ground = groundOf(vtm);
    vec4 sum = dot(corners, vec4(1.0)) * (numberColor(ASSET low(leaf.z)) - ground);
    Pieces pieces = piecesOf(leaf, corners);
    uvec4 piece = texelAt(ASSET SECTIONS.y + pieces.next);
    while (pieces.next < pieces.end && spend(1.0)) {
        uint paints = piece.w;
        float area = chainArea(ASSET square.frame, pieces, piece);
        sum += area * (numberColor(ASSET low(paints)) - numberColor(ASSET high(paints)));
        if (pieces.next == pieces.end)
            break;
    }
    return square.turn * sum;
}

#else

// ---- Paint programs --------------------------------------------------------------------------------------

// Some drivers run both sides of every branch, so what stands in the loop over pieces is done for each of them. Where a colour
// takes long, areas are added up for two paints at a time, as most leaves have no more, and their colours are looked up when
// others take their places.

const uint noPaint = 0xFFFFFFFFu;

// A number of a paint and its area so far.
struct Share {
    uint paint;
    float area;
};

struct LeafSum {
    Square square;
    Pieces pieces;
    float whole;        // area of the first corner's paint that is not yet added
    float ground;       // the same of what is under a placed map
    uvec2 waiting;      // paints of the piece that comes next, if it waits for a place
    Share one, other;
};

LeafSum noLeaf() {
    Share none = Share(noPaint, 0.0);
    Square square = Square(Frame(mat2(0.0), vec2(0.0)), uvec4(0u), vec2(0.0), 1.0);
    return LeafSum(square, Pieces(0u, 0u, vec4(0.0)), 0.0, 0.0, uvec2(noPaint), none, none);
}

// `color` loses what lies under the leaf: the ground of the picture's own map is solid.
LeafSum leafOf(Square square, inout vec4 color) {
    LeafSum sum = noLeaf();
    vec4 corners = cornerAreas(square.frame);
    sum.square = square;
    sum.pieces = piecesOf(square.leaf, corners);
    sum.whole = square.turn * dot(corners, vec4(1.0));
    sum.ground = isPlaced() ? -sum.whole : 0.0;
    color -= isPlaced() ? vec4(0.0) : sum.whole * groundColor;
    return sum;
}

bool isFinished(LeafSum sum) {
    return sum.pieces.next == sum.pieces.end && sum.whole == 0.0 && sum.ground == 0.0 && sum.one.paint == noPaint &&
           sum.other.paint == noPaint;
}

// Whether a paint is one of the two, or becomes one where there is room.
bool hasPlace(inout LeafSum sum, uint paint) {
    if (sum.one.paint == noPaint && sum.other.paint != paint)
        sum.one.paint = paint;
    else if (sum.other.paint == noPaint && sum.one.paint != paint)
        sum.other.paint = paint;
    return sum.one.paint == paint || sum.other.paint == paint;
}

void addArea(inout LeafSum sum, uint paint, float area) {
    sum.one.area += sum.one.paint == paint ? area : 0.0;
    sum.other.area += sum.other.paint == paint ? area : 0.0;
}

float withoutPlace(inout LeafSum sum, uint paint, float area) {
    if (area != 0.0 && !hasPlace(sum, paint))
        return area;
    addArea(sum, paint, area);
    return 0.0;
}

float pieceArea(Frame frame, Pieces pieces, uvec4 piece) {
    return curveSum(frame, piece) + toFirstCorner(frame, pieces.behind, piece.y) -
           toFirstCorner(frame, pieces.behind, piece.x);
}

// Up to a piece for whose paints there is no place. Chains would save nothing here, where colours are not looked up piece by
// piece.
void addAreas(ASSET_IN inout LeafSum sum) {
    sum.whole = withoutPlace(sum, low(sum.square.leaf.z), sum.whole);
    sum.ground = withoutPlace(sum, 0u, sum.ground);
    sum.waiting = uvec2(noPaint);
    while (sum.pieces.next < sum.pieces.end && spend(1.0)) {
        uvec4 piece = texelAt(ASSET SECTIONS.y + sum.pieces.next);
        uvec2 sides = uvec2(low(piece.w), high(piece.w));
        if (!hasPlace(sum, sides.x) || !hasPlace(sum, sides.y)) {
            sum.waiting = sides;
            break;
        }
        float area = spend(pieceTurns(piece)) ? sum.square.turn * pieceArea(sum.square.frame, sum.pieces, piece) : 0.0;
        addArea(sum, sides.x, area);
        addArea(sum, sides.y, -area);
        ++sum.pieces.next;
        if (sum.pieces.next == sum.pieces.end)
            break;
    }
}

bool makesRoom(LeafSum sum, Share share) { return share.paint != noPaint && all(notEqual(uvec2(share.paint), sum.waiting)); }

// Programs keep their places: addProgram.
void addColor(ASSET_IN LeafSum sum, inout Share share, inout vec4 color) {
    if (makesRoom(sum, share)) {
        uvec4 texel = onPage ? floatBitsToUint(pageColor(share.paint)) : paintTexel(ASSET paintOf(ASSET share.paint));
        bool solid = !isProgram(texel);
        if (solid)
            color += share.area * uintBitsToFloat(texel);
        if (solid || share.area == 0.0)
            share = Share(noPaint, 0.0);
    }
}

// Of paints that are no longer needed, or take another one's place.
void addColors(ASSET_IN inout LeafSum sum, inout vec4 color) {
    addColor(ASSET sum, sum.one, color);
    addColor(ASSET sum, sum.other, color);
}

bool needsProgram(LeafSum sum) { return makesRoom(sum, sum.one) || makesRoom(sum, sum.other); }

void addProgram(ASSET_IN inout LeafSum sum, mat3x2 pixel, inout vec4 color) {
    bool first = makesRoom(sum, sum.one);
    Share share = sum.other;
    if (first)
        share = sum.one;
    color += share.area * paintColor(ASSET paintOf(ASSET share.paint), sum.square.point, pixel);
    if (first)
        sum.one = Share(noPaint, 0.0);
    else
        sum.other = Share(noPaint, 0.0);
}

#endif
