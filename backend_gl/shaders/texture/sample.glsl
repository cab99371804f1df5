// An asset as a texture: the mean colour over a parallelogram of the picture. docs/texture.md.
// Requires: sample_asset.glsl, leaf_integral.glsl, placed_paints.glsl, sample_prefilter.glsl; INNER_MAPS; constants kind*, wrap*, maxLevel,
// turnsPerPixel, prefilterTurns, FEATURES, VTM_SAMPLES.
// Exports: vtm_sample, vtm_sample_proj, vtm_sample_grad.

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
    for (int l = 1; l < level && spend(1.0); ++l)
        node = childAt(vtm, node, cell >> (2 * (level - l))) >> 2;
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
    }
}

// The largest float below 1: whatever a square's side, it lies in the tree's last cell.
const float lastPlace = 1.0 - 1.0 / 16777216.0;

// ---- Maps in maps ---------------------------------------------------------------------------------------

#if INNER_MAPS

// A footprint as one of the cells that hold the centres of instances is asked for.
CopyFootprint reaching(CopyFootprint part, float reach) {
    part.reach = reach;
    part.lower = clamp(part.centre - part.halfBox - reach, 0.0, lastPlace);
    part.upper = clamp(part.centre + part.halfBox + reach, 0.0, 1.0);
    return part;
}

// Of a map, by its instances: those of `tree` from the walk's place on.
struct Level {
    CopyFootprint part;   // over the map
    uint tree;            // 0, or 1 + its index
    Walk walk;
    uint next, end;       // instances
};

Level levelFrom(Vtm vtm, CopyFootprint part, uint tree) {
    uvec4 texel = texelAt(vtm, vtm.placed.x + tree - 1u);
    CopyFootprint reached = reaching(part, uintBitsToFloat(texel.y));
    return Level(reached, tree, walkFrom(vtm, reached, texel.x), 0u, 0u);
}

// The map of an instance under a footprint of the map around; false if they do not meet.
bool findMap(Vtm vtm, CopyFootprint around, uvec4 instance, uvec4 symbol, out CopyFootprint part) {
    ivec4 m = ivec4(instance.z << 16, instance.z, instance.w << 16, instance.w) >> 16;
    mat2 linear = mat2(vec2(m.xy), vec2(m.zw)) * (uintBitsToFloat(symbol.z) / slopeScale);
    vec2 centre = vec2(instance.xy & 0xFFFFFFu) / 16777216.0;
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

// A map and all that are placed in it and in each other, each with the palettes of those around it.
void addMaps(Vtm vtm, CopyFootprint part, inout vec4 sum) {
    Level levels[INNER_MAPS];
    int depth = 0;  // of levels
    uint root = vtm.root, tree = vtm.instances;
    innerDepth = 0;
    bool isNew = true;
    while (spend(1.0)) {
        if (isNew) {
            addTree(vtm, part, root, sum);
            isNew = false;
            if (tree != 0u && depth < INNER_MAPS)
                levels[depth++] = levelFrom(vtm, part, tree);
        }
        if (depth == 0)
            break;
        int last = depth - 1;
        if (levels[last].next < levels[last].end) {
            uvec4 instance = texelAt(vtm, vtm.placed.y + levels[last].next);
            uint place = vtm.placed.z + 2u * (instance.x >> 24 | instance.y >> 24 << 8);
            uvec4 symbol = texelAt(vtm, place);
            ++levels[last].next;
            if (findMap(vtm, levels[last].part, instance, symbol, part)) {
                uvec4 map = texelAt(vtm, place + 1u);
                innerGrounds[last] = high(symbol.x);
                innerPalettes[last] = symbol.y;
                innerDepth = depth;
                root = map.x;
                tree = map.y;
                isNew = true;
            }
            continue;
        }
        ivec2 cell;
        float side;
        uint entry;
        if (nextSquare(vtm, levels[last].part, levels[last].walk, cell, side, entry)) {
            if ((entry & 3u) == kindInstances) {
                levels[last].next = entry >> 8;
                levels[last].end = levels[last].next + (entry >> 2 & 63u) + 1u;
            }
        } else {
            uint next = texelAt(vtm, vtm.placed.x + levels[last].tree - 1u).z;
            if (next != 0u)
                levels[last] = levelFrom(vtm, levels[last].part, next);
            else
                --depth;
        }
    }
    innerDepth = 0;
}

#else

void addMaps(Vtm vtm, CopyFootprint part, inout vec4 sum) { addTree(vtm, part, vtm.root, sum); }

#endif

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

// Adds what the maps have of the footprint; gives up where no turns are left.
void addFootprint(Vtm vtm, Footprint footprint, inout vec4 sum) {
    vec2 scale = vtm.size / vtm.square.z, offset = -vtm.square.xy / vtm.square.z;
    mat2 toBox = inverse(footprint.sides) * vtm.square.z;
    vec2 halfBox = 0.5 * (abs(footprint.sides[0]) + abs(footprint.sides[1])) / vtm.size;
    vec2 s = copies(vtm.wrapping.x, footprint.st.x, halfBox.x);
    vec2 t = copies(vtm.wrapping.y, footprint.st.y, halfBox.y);
    for (float y = t.x; y <= t.y && spend(1.0); ++y)
        for (float x = s.x; x <= s.y && spend(1.0); ++x) {
            bvec2 mirrored = bvec2(isMirrored(vtm.wrapping.x, x), isMirrored(vtm.wrapping.y, y));
            vec2 st = footprint.st - vec2(x, y);
            st = mix(st, 1.0 - st, mirrored);
            vec2 turned = mix(vec2(1.0), vec2(-1.0), mirrored);
            vec2 lower = max(st - halfBox, 0.0), upper = min(st + halfBox, 1.0);
            if (any(greaterThan(lower, upper)))
                continue;
            // A box that only touches the picture's end has no cell beyond it.
            lower = clamp(lower * scale + offset, 0.0, lastPlace);
            upper = clamp(upper * scale + offset, 0.0, 1.0);
            CopyFootprint part = CopyFootprint(st * scale + offset, halfBox * scale, lower, upper,
                             mat2(toBox[0] * turned.x, toBox[1] * turned.y),
                             mat3x2(footprint.sides[0], footprint.sides[1], picturePoint(vtm, st * scale + offset)), 1.0, 0.0);
            part.turn = cross2(part.toBox[0], part.toBox[1]) < 0.0 ? -1.0 : 1.0;
            addMaps(vtm, part, sum);
        }
}

// A share of what a pixel may take. The prefilter's own turns are set aside; what was begun and not finished is not
// shown, so nothing is ever missing.
vec4 sampled(Vtm vtm, vec2 st, vec2 dx, vec2 dy, float turns) {
    if ((vtm.features & ~FEATURES) != 0u)
        return vec4(1.0, 0.0, 1.0, 1.0);  // the include was made for other assets
    Footprint footprint = footprintOf(vtm, st, dx, dy);
    float share = prefilterShare(footprint);
    vec4 color = vec4(0.0);
    if (share < 1.0) {
        float allowed = turns - prefilterTurns;
        turnsLeft = allowed;
        addFootprint(vtm, footprint, color);
        color = clamp(color, 0.0, 1.0);
        share = max(share, clamp(1.0 - 4.0 * turnsLeft / allowed, 0.0, 1.0));
    }
    if (share > 0.0)
        color = mix(color, prefiltered(vtm, footprint), share);
    return color;
}

// Shared by all strips, and by all samples that a pixel of the user's takes.
const float turnsOfSample = float(turnsPerPixel) / float(VTM_SAMPLES);

vec4 vtm_sample_grad(Vtm vtm, vec2 st, vec2 dx, vec2 dy) { return sampled(vtm, st, dx, dy, turnsOfSample); }

// ---- Perspective ----------------------------------------------------------------------------------------

// On a plane in perspective (s, t, q) times gl_FragCoord.w is linear over the screen, so its differences are exact.
// With g = q' / q and J = ((s, t)' - (s, t) q' / q) / q what lies p pixels away is (s, t) / q + J p / (1 + g · p). A
// footprint is that with g = 0, which is off by |g| / 4 of a pixel at most where the pixel ends; on strips, 1 / n of a
// pixel wide, it is off by |g| / (4 n²), which is to stay below 1 / 256.
int stripsFor(float g) { return clamp(int(ceil(8.0 * sqrt(g))), 1, 4); }

vec4 vtm_sample_proj(Vtm vtm, vec3 stq) {
    vec3 at = stq * gl_FragCoord.w, dx = dFdx(at) / at.z, dy = dFdy(at) / at.z;
    vec2 st = stq.xy / stq.z, g = clamp(vec2(dx.z, dy.z), -1.0, 1.0);
    mat2 sides = mat2(dx.xy - st * dx.z, dy.xy - st * dy.z);
    int axis = abs(g.x) > abs(g.y) ? 0 : 1, count = stripsFor(abs(g[axis]));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; ++i) {
        float p = (float(i) + 0.5) / float(count) - 0.5, scale = 1.0 / (1.0 + g[axis] * p);
        vec2 away = sides[axis] * (p * scale);
        mat2 strip = mat2(sides[0] - away * g.x, sides[1] - away * g.y) * scale;
        strip[axis] /= float(count);
        sum += sampled(vtm, st + away, strip[0], strip[1], turnsOfSample / float(count));
    }
    return sum / float(count);
}

vec4 vtm_sample(Vtm vtm, vec2 st) { return vtm_sample_proj(vtm, vec3(st, 1.0)); }
