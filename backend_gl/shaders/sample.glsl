// An asset as a texture: the mean colour over a parallelogram of the picture. docs/texture.md.
// Requires: sample_asset.glsl, coverage.glsl, paint.glsl, sample_prefilter.glsl; constants kind*, wrap*, maxLevel,
// walkBudget, FEATURES.
// Exports: vtm_sample, vtm_sample_grad.

// ---- One square of the tree -------------------------------------------------------------------------

// A footprint over one copy of the picture. Lengths in sides of the tree's square, which is [0, 1]².
struct Tile {
    vec2 centre, halfBox;  // of the footprint and its bounding box
    vec2 least, most;      // of that box, cut to the picture
    mat2 toBox;            // the footprint is the pixel's box [0, 1]², its centre at 0.5
};

const uint noPaint = 0xFFFFFFFFu;

struct Sum {
    vec4 color;
    float cost;     // squares and pieces met so far
    float allowed;  // ... at most
    // The last two paints evaluated in this square: the two sides of a chain of pieces.
    uint recentPaint, olderPaint;
    vec4 recentColor, olderColor;
};

void addRegion(Vtm vtm, inout Sum sum, float weight, uint paint, vec2 point) {
    if (weight == 0.0)
        return;
    if (paint != sum.recentPaint) {
        vec4 color = sum.olderColor;
        if (paint != sum.olderPaint)
            color = paintColor(vtm, paint, point);
        sum.olderPaint = sum.recentPaint;
        sum.olderColor = sum.recentColor;
        sum.recentPaint = paint;
        sum.recentColor = color;
    }
    sum.color += weight * sum.recentColor;
}

// 4^-level, exactly.
float sideAt(int level) { return uintBitsToFloat(uint(127 - 2 * level) << 23); }

// Whether a square meets the footprint, by its box in the pixel's coordinates.
bool meets(Tile tile, ivec2 cell, float side) {
    vec2 fromCentre = tile.toBox * ((vec2(cell) + 0.5) * side - tile.centre);
    vec2 reach = (abs(tile.toBox[0]) + abs(tile.toBox[1])) * (0.5 * side) + 0.5;
    return all(lessThan(abs(fromCentre), reach));
}

// One loop over the four corners and both sides of every piece, so that the paint interpreter, which
// compilers inline, stands in the program once. Twin of general_fragment.glsl.
void addSquare(Vtm vtm, Tile tile, ivec2 cell, float side, uint entry, inout Sum sum) {
    vec2 corner = vec2(cell) * side;
    vec2 least = tile.centre - tile.halfBox, most = tile.centre + tile.halfBox;
    vec2 point = 0.5 * (max(least, corner) + min(most, corner + side));
    point = vtm.square.xy + point * vtm.square.z;
    sum.recentPaint = sum.olderPaint = noPaint;
    uint payload = entry >> 2;
    uvec4 leaf = uvec4(0u, 0u, uvec2(payload | payload << 16)), piece = uvec4(0u);
    if ((entry & 3u) == kindSolid) {
        if (all(lessThanEqual(corner, least)) && all(lessThanEqual(most, corner + side))) {
            addRegion(vtm, sum, 1.0, payload, point);
            return;
        }
    } else {
        leaf = texelAt(vtm, vtm.sections.x + payload);
        sum.cost += float(low(leaf.y));
        if (sum.cost > sum.allowed)
            return;
    }
    Frame frame = Frame(tile.toBox * (side / float(leafExtent)), tile.toBox * (corner - tile.centre) + 0.5);
    float turn = tile.toBox[0].x * tile.toBox[1].y < tile.toBox[1].x * tile.toBox[0].y ? -1.0 : 1.0;
    float weight = 0.0;
    uint terms = 4u + 2u * low(leaf.y);
    for (uint i = 0u; i < terms; ++i) {
        uint paint = high(piece.w);
        if (i < 4u) {
            weight = turn * seg(cornerOf(frame, int(i)), cornerOf(frame, int((i + 1u) & 3u)));
            uint word = i < 2u ? leaf.z : leaf.w;
            paint = (i & 1u) == 0u ? low(word) : high(word);
        } else if ((i & 1u) == 0u) {
            piece = texelAt(vtm, vtm.sections.y + leaf.x + (i - 4u) / 2u);
            weight = turn * pieceSum(frame, piece);
            paint = low(piece.w);
        } else {
            weight = -weight;
        }
        addRegion(vtm, sum, weight, paint, point);
    }
}

// ---- The tree -----------------------------------------------------------------------------------------

uint childAt(Vtm vtm, uint node, ivec2 cell) {
    return texelAt(vtm, vtm.nodes + 4u * node + uint(cell.y & 3))[cell.x & 3];
}

// The node whose children are the squares of a level round `cell`, from the root.
uint nodeAround(Vtm vtm, ivec2 cell, int level) {
    uint node = vtm.root >> 2;
    for (int l = 1; l < level; ++l)
        node = childAt(vtm, node, cell >> (2 * (level - l))) >> 2;
    return node;
}

ivec2 firstCell(Tile tile, float side) { return ivec2(floor(tile.least / side)); }
ivec2 lastCell(Tile tile, float side) { return max(ivec2(ceil(tile.most / side)) - 1, firstCell(tile, side)); }

// Squares in the order of the tree, with neither recursion nor a stack: a place in the tree is a cell and its level.
void addTile(Vtm vtm, Tile tile, inout Sum sum) {
    int level = 0;
    ivec2 cell = ivec2(0);
    uint entry = vtm.root, parent = 0u;
    while (sum.cost <= sum.allowed) {
        float side = sideAt(level);
        bool met = meets(tile, cell, side);
        if (met && (entry & 3u) == kindNode && level < int(maxLevel)) {
            parent = entry >> 2;
            ++level;
            cell = max(cell * 4, firstCell(tile, side * 0.25));
            entry = childAt(vtm, parent, cell);
            sum.cost += 0.25;
            continue;
        }
        sum.cost += 0.25;
        if (met) {
            sum.cost += 1.0;
            addSquare(vtm, tile, cell, side, entry, sum);
        }
        // On to the next cell of this node that the box meets, or up while there is none.
        bool rose = false;
        for (;;) {
            if (level == 0)
                return;
            ivec2 most = min(lastCell(tile, sideAt(level)), cell | 3);
            if (cell.x < most.x) {
                ++cell.x;
                break;
            }
            if (cell.y < most.y) {
                cell = ivec2(max(firstCell(tile, sideAt(level)).x, cell.x & ~3), cell.y + 1);
                break;
            }
            --level;
            cell >>= 2;
            rose = true;
        }
        if (rose)
            parent = nodeAround(vtm, cell, level);
        entry = childAt(vtm, parent, cell);
    }
}

// ---- The footprint ------------------------------------------------------------------------------------

bool repeats(int wrapping) { return wrapping == wrapRepeat || wrapping == wrapMirror; }

// Copies of the picture that a footprint of this half width meets, as (first, last).
vec2 copies(int wrapping, float at, float halfWidth) {
    return repeats(wrapping) ? vec2(floor(at - halfWidth), max(ceil(at + halfWidth) - 1.0, floor(at - halfWidth)))
                             : vec2(0.0);
}

bool isMirrored(int wrapping, float copy) {
    return wrapping == wrapMirror && abs(copy - 2.0 * floor(copy * 0.5)) > 0.5;
}

// Adds what the tree has of the footprint; over `allowed`, gives up.
void addFootprint(Vtm vtm, Footprint footprint, inout Sum sum) {
    vec2 scale = vtm.size / vtm.square.z, offset = -vtm.square.xy / vtm.square.z;
    mat2 toBox = inverse(footprint.sides) * vtm.square.z;
    vec2 halfBox = 0.5 * (abs(footprint.sides[0]) + abs(footprint.sides[1])) / vtm.size;
    vec2 s = copies(vtm.wrapping.x, footprint.st.x, halfBox.x);
    vec2 t = copies(vtm.wrapping.y, footprint.st.y, halfBox.y);
    for (float y = t.x; y <= t.y && sum.cost <= sum.allowed; ++y)
        for (float x = s.x; x <= s.y && sum.cost <= sum.allowed; ++x) {
            bvec2 mirrored = bvec2(isMirrored(vtm.wrapping.x, x), isMirrored(vtm.wrapping.y, y));
            vec2 st = footprint.st - vec2(x, y);
            st = mix(st, 1.0 - st, mirrored);
            vec2 turned = mix(vec2(1.0), vec2(-1.0), mirrored);
            vec2 least = max(st - halfBox, 0.0), most = min(st + halfBox, 1.0);
            if (any(greaterThan(least, most)))
                continue;
            addTile(vtm, Tile(st * scale + offset, halfBox * scale, least * scale + offset, most * scale + offset,
                              mat2(toBox[0] * turned.x, toBox[1] * turned.y)), sum);
        }
}

vec4 vtm_sample_grad(Vtm vtm, vec2 st, vec2 dx, vec2 dy) {
    if ((vtm.features & ~FEATURES) != 0u)
        return vec4(1.0, 0.0, 1.0, 1.0);  // the include was made for other assets
    Footprint footprint = footprintOf(vtm, st, dx, dy);
    float share = prefilterShare(footprint);
    vec4 color = vec4(0.0);
    if (share < 1.0) {
        float freedom = max(1.0, fadeTo / footprint.longer);
        Sum sum = Sum(vec4(0.0), 0.0, walkBudget * freedom * freedom, noPaint, noPaint, vec4(0.0), vec4(0.0));
        addFootprint(vtm, footprint, sum);
        color = clamp(sum.color, 0.0, 1.0);
        share = max(share, clamp(2.0 * sum.cost / sum.allowed - 1.0, 0.0, 1.0));
    }
    if (share > 0.0)
        color = mix(color, prefiltered(vtm, footprint), share);
    return color;
}

vec4 vtm_sample(Vtm vtm, vec2 st) { return vtm_sample_grad(vtm, st, dFdx(st), dFdy(st)); }
