// A square of the tree added up: the integral of its colour over the pixel's box.
// Requires: fetch.glsl, coverage.glsl, paint.glsl, placed_paints.glsl; LINEAR, RADIAL, IMAGE, GROUPS, MATERIAL, INNER_MAPS.
// Exports: PROGRAMS, SHARES, Square, squareArea; where SHARES is 0: leafIntegral, else LeafSum, noLeaf, leafOf, isFinished,
// addAreas, addColors; where PROGRAMS is 1: needsProgram, addProgram.

// Some drivers run both sides of every branch, so what stands in the loop over pieces is done for each of them. Where a colour
// takes long, areas are added up for two paints at a time, as most leaves have no more, and their colours are looked up when
// others take their places.
#define PROGRAMS (LINEAR || RADIAL || IMAGE || GROUPS || MATERIAL)
#define SHARES (PROGRAMS || INNER_MAPS)

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

// Of pieceSum()'s loop, at most: straight pieces are one chord.
float pieceTurns(uvec4 piece) { return piece.z == 0u ? 4.0 : float(chordCount) + 5.0; }

#if SHARES

const uint noPaint = 0xFFFFFFFFu;

// A number of a paint and its area so far.
struct Share {
    uint paint;
    float area;
};

struct LeafSum {
    Square square;
    vec4 corners;       // areas that are not yet added
    float ground;       // the same of what is under a map that is placed
    uint next, end;     // pieces
    uvec2 waiting;      // paints of the piece that comes next, if it waits for a place
    Share one, other;
};

LeafSum noLeaf() {
    Share none = Share(noPaint, 0.0);
    Square square = Square(Frame(mat2(0.0), vec2(0.0)), uvec4(0u), vec2(0.0), 1.0);
    return LeafSum(square, vec4(0.0), 0.0, 0u, 0u, uvec2(noPaint), none, none);
}

LeafSum leafOf(Square square) {
    LeafSum sum = noLeaf();
    sum.square = square;
    sum.corners = square.turn * cornerAreas(square.frame);
    sum.ground = isPlaced() ? -dot(sum.corners, vec4(1.0)) : 0.0;
    sum.next = square.leaf.x;
    sum.end = square.leaf.x + low(square.leaf.y);
    return sum;
}

bool isFinished(LeafSum sum) {
    return sum.next == sum.end && sum.corners == vec4(0.0) && sum.ground == 0.0 && sum.one.paint == noPaint &&
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

// Up to a piece for whose paints there is no place.
void addAreas(ASSET_IN inout LeafSum sum) {
    uvec4 leaf = sum.square.leaf;
    sum.corners.x = withoutPlace(sum, low(leaf.z), sum.corners.x);
    sum.corners.y = withoutPlace(sum, high(leaf.z), sum.corners.y);
    sum.corners.z = withoutPlace(sum, low(leaf.w), sum.corners.z);
    sum.corners.w = withoutPlace(sum, high(leaf.w), sum.corners.w);
    sum.ground = withoutPlace(sum, 0u, sum.ground);
    sum.waiting = uvec2(noPaint);
    while (sum.next < sum.end && spend(1.0)) {
        uvec4 piece = texelAt(ASSET ASSET_PART(sections).y + sum.next);
        uvec2 sides = uvec2(low(piece.w), high(piece.w));
        if (!hasPlace(sum, sides.x) || !hasPlace(sum, sides.y)) {
            sum.waiting = sides;
            break;
        }
        float area = spend(pieceTurns(piece)) ? sum.square.turn * pieceSum(sum.square.frame, piece) : 0.0;
        addArea(sum, sides.x, area);
        addArea(sum, sides.y, -area);
        ++sum.next;
        if (sum.next == sum.end)
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

#if PROGRAMS

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

#else

vec4 numberColor(ASSET_IN uint number) {
    return onPage ? pageColor(number) : solidColor(ASSET paintOf(ASSET number));
}

// Twin of pieces_fragment.glsl.
vec4 leafIntegral(ASSET_IN Square square) {
    uvec4 leaf = square.leaf;
    vec4 corners = cornerAreas(square.frame);
    vec4 sum = corners.x * numberColor(ASSET low(leaf.z)) + corners.y * numberColor(ASSET high(leaf.z)) +
               corners.z * numberColor(ASSET low(leaf.w)) + corners.w * numberColor(ASSET high(leaf.w));
    if (isPlaced())
        sum -= dot(corners, vec4(1.0)) * numberColor(ASSET 0u);
    uint end = leaf.x + low(leaf.y);
    for (uint i = leaf.x; i < end && spend(1.0); ++i) {
        uvec4 piece = texelAt(ASSET ASSET_PART(sections).y + i);
        float weight = spend(pieceTurns(piece)) ? pieceSum(square.frame, piece) : 0.0;
        if (weight != 0.0)
            sum += weight * (numberColor(ASSET low(piece.w)) - numberColor(ASSET high(piece.w)));
        if (i + 1u == end)
            break;
    }
    return square.turn * sum;
}

#endif
