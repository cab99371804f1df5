// What a footprint has of a map and of those that are placed in it and in each other. docs/instances.md.
// Requires: sample_asset.glsl, placed_paints.glsl, sample_tree.glsl; INNER_MAPS; constants kind*, slopeScale.
// Exports: addMaps.

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

bool findInstance(Vtm vtm, CopyFootprint around, uvec4 instance, uvec4 symbol, out CopyFootprint part) {
    ivec4 m = ivec4(instance.z << 16, instance.z, instance.w << 16, instance.w) >> 16;
    mat2 linear = mat2(vec2(m.xy), vec2(m.zw)) * (uintBitsToFloat(symbol.z) / slopeScale);
    return findMap(around, linear, vec2(instance.xy & 0xFFFFFFu) / 16777216.0, part);
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
            if (findInstance(vtm, levels[last].part, instance, symbol, part)) {
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
