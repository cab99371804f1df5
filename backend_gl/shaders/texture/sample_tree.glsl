// Squares of a tree that a footprint meets, found without recursion and without a stack. docs/texture.md.
// Requires: sample_asset.glsl, leaf_integral.glsl, placed_paints.glsl; constants kind*, maxLevel, leafExtent.
// Exports: CopyFootprint, picturePoint, lastPlace, Walk, walkFrom, descend, isDone, advance, setEntry, squareOf, wordAt,
// partOver, meetsMap, meetsBox.

// ---- One square of the tree -------------------------------------------------------------------------

// A footprint over one copy of the picture, or over a map that is placed in it. Lengths in sides of the map's square,
// which is [0, 1]².
struct CopyFootprint {
    vec2 centre, halfBox;  // of the footprint and its bounding box
    vec2 lower, upper;      // of that box, cut to the square
    mat2 toBox;            // the footprint becomes the pixel's box [0, 1]², its centre 0.5
};

vec2 picturePoint(Vtm vtm, vec2 p) { return vtm.square.xy + p * vtm.square.z; }

// `pixel`: the footprint's sides and centre, in the picture.
Square squareOf(Vtm vtm, CopyFootprint part, mat3x2 pixel, ivec2 cell, float side, uint entry) {
    vec2 corner = vec2(cell) * side;
    vec2 lower = max(part.centre - part.halfBox, corner), upper = min(part.centre + part.halfBox, corner + side);
    uint payload = entry >> 2;
    uvec4 leaf = uvec4(0u, 0u, uvec2(payload | payload << 16));
    if ((entry & 3u) != kindSolid)
        leaf = texelAt(vtm, SECTIONS.x + payload);
    Frame frame = Frame(part.toBox * (side / float(leafExtent)), part.toBox * (corner - part.centre) + 0.5);
    vec2 middle = 0.5 * (lower + upper), point = picturePoint(vtm, middle);
    if (isPlaced())
        point = pixel[2] + mat2(pixel[0], pixel[1]) * (part.toBox * (middle - part.centre));
    return Square(frame, leaf, point, cross2(part.toBox[0], part.toBox[1]) < 0.0 ? -1.0 : 1.0);
}

// The i-th word of records that begin at a texel.
uint wordAt(Vtm vtm, uint texel, uint i) { return texelAt(vtm, texel + (i >> 2))[i & 3u]; }

// ---- The tree -----------------------------------------------------------------------------------------

// 4^-level and 4^level, exactly.
float sideAt(int level) { return uintBitsToFloat(uint(127 - 2 * level) << 23); }
float perSideAt(int level) { return uintBitsToFloat(uint(127 + 2 * level) << 23); }

uint childTexel(uint node, ivec2 cell) { return nodesOf + 4u * node + uint(cell.y & 3); }

ivec2 firstCell(CopyFootprint part, int level) { return ivec2(floor(part.lower * perSideAt(level))); }
ivec2 lastCell(CopyFootprint part, int level) {
    return max(ivec2(ceil(part.upper * perSideAt(level))) - 1, firstCell(part, level));
}

// Whether a box meets the footprint, by its own box in the pixel's coordinates.
bool meetsBox(CopyFootprint part, vec2 middle, vec2 halfSize) {
    vec2 fromCentre = part.toBox * (middle - part.centre);
    vec2 reach = abs(part.toBox[0]) * halfSize.x + abs(part.toBox[1]) * halfSize.y + 0.5;
    return all(lessThan(abs(fromCentre), reach));
}

bool meets(CopyFootprint part, ivec2 cell, float side) {
    return meetsBox(part, (vec2(cell) + 0.5) * side, vec2(0.5 * side));
}

// Squares in the order of the tree, without recursion: a place in the tree is a cell, its level and the node that holds it.
// `top` is the level of the smallest square that holds the whole box, as far as is known.
struct Walk {
    uint entry;
    uvec4 nodes, deeper, deepest;  // that hold the cells of levels 1 to 4, 5 to 8 and 9 to 12
    ivec2 cell;
    int level, top;
    bool rising;
};

Walk walkFrom(uint root) { return Walk(root, uvec4(0u), uvec4(0u), uvec4(0u), ivec2(0), 0, 0, false); }

uvec4 withNode(uvec4 nodes, int i, uint node) {
    uint a = nodes.x, b = nodes.y, c = nodes.z, d = nodes.w;
    return uvec4(i == 0 ? node : a, i == 1 ? node : b, i == 2 ? node : c, i == 3 ? node : d);
}

// An index that is known only when the program runs would make some drivers store the lanes of a processor one by one.
uint nodeAt(Walk walk, int level) {
    uvec4 first = walk.nodes, next = walk.deeper, last = walk.deepest;
    uvec4 nodes = level <= 4 ? first : level <= 8 ? next : last;
    uint a = nodes.x, b = nodes.y, c = nodes.z, d = nodes.w;
    int i = (level - 1) & 3;
    return i == 0 ? a : i == 1 ? b : i == 2 ? c : d;
}

// Goes down to the smallest square that holds the whole box.
void descend(Vtm vtm, CopyFootprint part, inout Walk walk) {
    while ((walk.entry & 3u) == kindNode && spend(1.0)) {
        ivec2 cell = firstCell(part, walk.level + 1);
        bool fits = cell == lastCell(part, walk.level + 1);
        if (fits) {
            walk.entry = texelAt(vtm, childTexel(walk.entry >> 2, cell))[cell.x & 3];
            walk.cell = cell;
            ++walk.level;
        }
        if (!fits || (walk.entry & 3u) != kindNode)
            break;
    }
    walk.top = walk.level;
}

bool isDone(Walk walk) { return walk.level < walk.top; }

// Goes on by one step: down into a node, on to the next square of one, or up. True if it leaves behind a square that the
// footprint meets. `texel` has the next square's entry: setEntry().
bool advance(CopyFootprint part, inout Walk walk, out ivec2 cell, out float side, out uint entry, out uint texel) {
    cell = walk.cell;
    side = sideAt(walk.level);
    entry = walk.entry;
    bool met = !walk.rising && meets(part, cell, side), down = met && (entry & 3u) == kindNode;
    // The next cell of this node that the box meets.
    ivec2 upper = min(lastCell(part, walk.level), cell | 3);
    bool along = cell.x < upper.x, onward = walk.level > walk.top && (along || cell.y < upper.y);
    if (down) {
        ivec2 first = firstCell(part, walk.level + 1);
        walk.top += walk.level == walk.top && first == lastCell(part, walk.level + 1) ? 1 : 0;
        walk.nodes = withNode(walk.nodes, walk.level, entry >> 2);
        walk.deeper = withNode(walk.deeper, walk.level - 4, entry >> 2);
        walk.deepest = withNode(walk.deepest, walk.level - 8, entry >> 2);
        walk.cell = max(cell * 4, first);
        ++walk.level;
    } else if (onward) {
        ivec2 right = cell + ivec2(1, 0), below = ivec2(max(firstCell(part, walk.level).x, cell.x & ~3), cell.y + 1);
        walk.cell = along ? right : below;
    } else {
        --walk.level;
        walk.cell >>= 2;
    }
    walk.rising = !down && !onward;
    texel = childTexel(nodeAt(walk, walk.level), walk.cell);
    return met && !down;
}

// Going up, there is none.
void setEntry(inout Walk walk, uvec4 texel) { walk.entry = texel[walk.cell.x & 3]; }

// The largest float below 1: whatever a square's side, it lies in the tree's last cell.
const float lastPlace = 1.0 - 1.0 / 16777216.0;

// ---- A map that is placed -------------------------------------------------------------------------------

// The footprint over a map whose square's middle stands at `centre`; `linear` leads from the map's square.
CopyFootprint partOver(CopyFootprint around, mat2 linear, vec2 centre) {
    mat2 toInner = inverse(linear);
    CopyFootprint part = around;
    part.toBox = around.toBox * linear;
    part.centre = toInner * (around.centre - centre) + 0.5;
    mat2 sides = inverse(part.toBox);
    part.halfBox = 0.5 * (abs(sides[0]) + abs(sides[1]));
    vec2 lower = part.centre - part.halfBox, upper = part.centre + part.halfBox;
    part.lower = clamp(lower, 0.0, lastPlace);
    part.upper = clamp(upper, 0.0, 1.0);
    return part;
}

// Whether a footprint over a map meets its square.
bool meetsMap(CopyFootprint part) {
    return all(lessThan(part.centre - part.halfBox, vec2(1.0))) && all(greaterThan(part.centre + part.halfBox, vec2(0.0))) &&
           meetsBox(part, vec2(0.5), vec2(0.5));
}
