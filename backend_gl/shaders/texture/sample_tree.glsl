// What a footprint has of one map: its squares, found in the tree without recursion and without a stack. docs/texture.md.
// Requires: sample_asset.glsl, leaf_integral.glsl, placed_paints.glsl; constants kind*, maxLevel, leafExtent.
// Exports: CopyFootprint, picturePoint, lastPlace, Walk, walkFrom, nextSquare, addTree, findMap.

// ---- One square of the tree -------------------------------------------------------------------------

// A footprint over one copy of the picture, or over a map that is placed in it. Lengths in sides of the map's square,
// which is [0, 1]².
struct CopyFootprint {
    vec2 centre, halfBox;  // of the footprint and its bounding box
    vec2 lower, upper;      // of that box, cut to the square
    mat2 toBox;            // the footprint becomes the pixel's box [0, 1]², its centre 0.5
    mat3x2 pixel;          // its sides and centre, in the picture
    float turn;            // -1 if that mirrors
    float reach;           // squares count as wider by so much, each way
};

vec2 picturePoint(Vtm vtm, vec2 p) { return vtm.square.xy + p * vtm.square.z; }

// Paints are evaluated in the middle of what the footprint's box has of the square.
void addSquare(Vtm vtm, CopyFootprint part, ivec2 cell, float side, uint entry, inout vec4 sum) {
    vec2 corner = vec2(cell) * side;
    vec2 lower = max(part.centre - part.halfBox, corner), upper = min(part.centre + part.halfBox, corner + side);
    uint payload = entry >> 2;
    uvec4 leaf = uvec4(0u, 0u, uvec2(payload | payload << 16));
    if ((entry & 3u) != kindSolid)
        leaf = texelAt(vtm, vtm.sections.x + payload);
    else if (isPlaced() && payload == 0u)
        return;
    Frame frame = Frame(part.toBox * (side / float(leafExtent)), part.toBox * (corner - part.centre) + 0.5);
    vec2 middle = 0.5 * (lower + upper), point = picturePoint(vtm, middle);
    if (isPlaced())
        point = part.pixel[2] + mat2(part.pixel[0], part.pixel[1]) * (part.toBox * (middle - part.centre));
    sum += part.turn * leafIntegral(vtm, frame, leaf, point, part.pixel);
}

// ---- The tree -----------------------------------------------------------------------------------------

// 4^-level, exactly.
float sideAt(int level) { return uintBitsToFloat(uint(127 - 2 * level) << 23); }

uint childAt(Vtm vtm, uint node, ivec2 cell) {
    return texelAt(vtm, vtm.nodes + 4u * node + uint(cell.y & 3))[cell.x & 3];
}

// The node that holds `cell`, from the root.
uint nodeAround(Vtm vtm, uint root, ivec2 cell, int level) {
    uint node = root >> 2;
    for (int l = 1; l < level && spend(1.0); ++l) {
        node = childAt(vtm, node, cell >> (2 * (level - l))) >> 2;
        if (l + 1 == level)
            break;
    }
    return node;
}

ivec2 firstCell(CopyFootprint part, float side) { return ivec2(floor(part.lower / side)); }
ivec2 lastCell(CopyFootprint part, float side) { return max(ivec2(ceil(part.upper / side)) - 1, firstCell(part, side)); }

// Whether a square meets the footprint, by its box in the pixel's coordinates.
bool meets(CopyFootprint part, ivec2 cell, float side) {
    vec2 fromCentre = part.toBox * ((vec2(cell) + 0.5) * side - part.centre);
    vec2 reach = (abs(part.toBox[0]) + abs(part.toBox[1])) * (0.5 * side + part.reach) + 0.5;
    return all(lessThan(abs(fromCentre), reach));
}

// Squares in the order of the tree, with neither recursion nor a stack: a place in the tree is a cell, its level and
// the node that holds it.
struct Walk {
    uint root, entry, parent;
    ivec2 cell;
    int level, top;
    bool rising;
};

// At the smallest square that holds the whole box, which most often is a leaf.
Walk walkFrom(Vtm vtm, CopyFootprint part, uint root) {
    Walk walk = Walk(root, root, 0u, ivec2(0), 0, 0, false);
    while ((walk.entry & 3u) == kindNode && spend(1.0)) {
        float side = sideAt(walk.level + 1);
        ivec2 child = firstCell(part, side);
        if (child != lastCell(part, side))
            break;
        walk.parent = walk.entry >> 2;
        walk.entry = childAt(vtm, walk.parent, child);
        walk.cell = child;
        ++walk.level;
        if ((walk.entry & 3u) != kindNode)
            break;
    }
    walk.top = walk.level;
    return walk;
}

bool isDone(Walk walk) { return walk.level < walk.top; }

// Goes on to behind the next square that the footprint meets; false if there is none.
bool nextSquare(Vtm vtm, CopyFootprint part, inout Walk walk, out ivec2 cell, out float cellSide, out uint entry) {
    bool found = false;
    while (!isDone(walk) && !found && spend(1.0)) {
        float side = sideAt(walk.level);
        if (!walk.rising && meets(part, walk.cell, side)) {
            if ((walk.entry & 3u) == kindNode) {
                walk.parent = walk.entry >> 2;
                ++walk.level;
                walk.cell = max(walk.cell * 4, firstCell(part, side * 0.25));
                walk.entry = childAt(vtm, walk.parent, walk.cell);
                continue;
            }
            found = true;
            cell = walk.cell;
            cellSide = side;
            entry = walk.entry;
        }
        // On to the next cell of this node that the box meets, or up where there is none.
        ivec2 upper = min(lastCell(part, side), walk.cell | 3);
        bool along = walk.cell.x < upper.x, onward = walk.level > walk.top && (along || walk.cell.y < upper.y);
        if (onward) {
            walk.cell = along ? walk.cell + ivec2(1, 0)
                              : ivec2(max(firstCell(part, side).x, walk.cell.x & ~3), walk.cell.y + 1);
            if (walk.rising)
                walk.parent = nodeAround(vtm, walk.root, walk.cell, walk.level);
            walk.entry = childAt(vtm, walk.parent, walk.cell);
        } else {
            --walk.level;
            walk.cell >>= 2;
        }
        walk.rising = !onward;
        if (found || isDone(walk))
            break;
    }
    return found;
}

// Two loops, the inner one only to find the next square: lanes of a processor that find theirs at different times add
// them together.
void addTree(Vtm vtm, CopyFootprint part, uint root, inout vec4 sum) {
    Walk walk = walkFrom(vtm, part, root);
    while (!isDone(walk) && spend(1.0)) {
        ivec2 cell;
        float side;
        uint entry;
        if (nextSquare(vtm, part, walk, cell, side, entry))
            addSquare(vtm, part, cell, side, entry, sum);
        if (isDone(walk))
            break;
    }
}

// The largest float below 1: whatever a square's side, it lies in the tree's last cell.
const float lastPlace = 1.0 - 1.0 / 16777216.0;

// ---- A map that is placed -------------------------------------------------------------------------------

// The footprint over a map whose square's middle stands at `centre`; `linear` leads from the map's square. False if
// they do not meet.
bool findMap(CopyFootprint around, mat2 linear, vec2 centre, out CopyFootprint part) {
    mat2 toInner = inverse(linear);
    part = around;
    part.reach = 0.0;
    part.toBox = around.toBox * linear;
    part.centre = toInner * (around.centre - centre) + 0.5;
    mat2 sides = inverse(part.toBox);
    part.halfBox = 0.5 * (abs(sides[0]) + abs(sides[1]));
    vec2 lower = part.centre - part.halfBox, upper = part.centre + part.halfBox;
    part.lower = clamp(lower, 0.0, lastPlace);
    part.upper = clamp(upper, 0.0, 1.0);
    part.turn = cross2(part.toBox[0], part.toBox[1]) < 0.0 ? -1.0 : 1.0;
    vec2 fromCentre = part.toBox * (0.5 - part.centre);
    vec2 reach = (abs(part.toBox[0]) + abs(part.toBox[1])) * 0.5 + 0.5;
    return all(lessThan(lower, vec2(1.0))) && all(greaterThan(upper, vec2(0.0))) &&
           all(lessThan(abs(fromCentre), reach));
}
