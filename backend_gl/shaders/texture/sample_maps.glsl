// What a footprint has of a map and of those that are placed in it and in each other. docs/instances.md.
// Requires: sample_asset.glsl, leaf_integral.glsl, placed_paints.glsl, sample_tree.glsl; INNER_MAPS, PROGRAMS; constants
// kind*, slopeScale.
// Exports: addMap.

// Where the search for squares stands.
struct Search {
    CopyFootprint part;   // over the map
    Walk walk;            // over squares, or over cells that hold the centres of instances
#if INNER_MAPS
    bool ofInstances;
    uint tree;            // of instances, that comes next: 0, or 1 + its index
    uint next, end;       // instances of the cell
#endif
    bool isOver;
};

#if INNER_MAPS

// Of the maps around. The loops below make its indices known when the program is compiled: some drivers store each lane
// of a processor for itself otherwise.
Search outer[INNER_MAPS];

Search searchOf(CopyFootprint part, uint root, uint instances) {
    return Search(part, walkFrom(root), false, instances, 0u, 0u, false);
}

// A footprint as one of the cells that hold the centres of instances is asked for.
void reachOut(inout CopyFootprint part, float reach) {
    part.reach = reach;
    part.lower = clamp(part.centre - part.halfBox - reach, 0.0, lastPlace);
    part.upper = clamp(part.centre + part.halfBox + reach, 0.0, 1.0);
}

vec2 centreOf(uvec4 instance) { return vec2(instance.xy & 0xFFFFFFu) / 16777216.0; }

// Into an instance, if the footprint meets it.
void enterInstance(Vtm vtm, uvec4 instance, inout Search search) {
    uint place = vtm.placed.z + 2u * (instance.x >> 24 | instance.y >> 24 << 8);
    uvec4 symbol = texelAt(vtm, place);
    ivec4 m = ivec4(instance.z << 16, instance.z, instance.w << 16, instance.w) >> 16;
    mat2 linear = mat2(vec2(m.xy), vec2(m.zw)) * (uintBitsToFloat(symbol.z) / slopeScale);
    CopyFootprint part;
    if (findMap(search.part, linear, centreOf(instance), part)) {
        uvec4 map = texelAt(vtm, place + 1u);
        for (int i = 0; i < INNER_MAPS; ++i)
            if (i == innerDepth) {
                innerGrounds[i] = high(symbol.x);
                innerPalettes[i] = symbol.y;
                outer[i] = search;
            }
        ++innerDepth;
        search = searchOf(part, map.x, innerDepth < INNER_MAPS ? map.y : 0u);
    }
}

// From the end of a tree to the next tree of the map's instances, or back to the map around.
void leaveTree(Vtm vtm, inout Search search) {
    if (search.tree != 0u) {
        uvec4 texel = texelAt(vtm, vtm.placed.x + search.tree - 1u);
        search.walk = walkFrom(texel.x);
        reachOut(search.part, uintBitsToFloat(texel.y));
        search.tree = texel.z;
        search.ofInstances = true;
    } else if (innerDepth > 0) {
        --innerDepth;
        for (int i = 0; i < INNER_MAPS; ++i)
            if (i == innerDepth)
                search = outer[i];
    } else {
        search.isOver = true;
    }
}

#else

Search searchOf(CopyFootprint part, uint root, uint instances) { return Search(part, walkFrom(root), false); }

#endif

// Goes on to the next square that the footprint meets; false if there is none.
bool nextSquare(Vtm vtm, inout Search search, mat3x2 pixel, out Square square) {
    ivec2 cell = ivec2(0);
    float side = 1.0;
    uint entry = 0u;
    bool found = false;
#if INNER_MAPS
    // What is done for each square or instance stands in the inner loop, what is done for few of them around it.
    while (!search.isOver && spend(1.0)) {
        uvec4 instance;
        bool isNear = false, isAtEnd = search.next == search.end && isDone(search.walk);
        while (!isAtEnd && spend(1.0)) {
            if (search.next < search.end) {
                instance = texelAt(vtm, vtm.placed.y + search.next++);
                isNear = all(lessThan(abs(centreOf(instance) - search.part.centre), search.part.halfBox + search.part.reach));
            } else if (advance(vtm, search.part, search.walk, cell, side, entry)) {
                if (!search.ofInstances)
                    found = !isPlaced() || entry != kindSolid;
                else if ((entry & 3u) == kindInstances) {
                    search.next = entry >> 8;
                    search.end = search.next + (entry >> 2 & 63u) + 1u;
                }
            }
            isAtEnd = search.next == search.end && isDone(search.walk);
            if (found || isNear || isAtEnd)
                break;
        }
        if (isNear)
            enterInstance(vtm, instance, search);
        else if (!found && isAtEnd)
            leaveTree(vtm, search);
        if (found || search.isOver)
            break;
    }
#else
    // Of what is placed there is nothing where its paint is the ground's.
    while (!search.isOver && spend(1.0)) {
        found = advance(vtm, search.part, search.walk, cell, side, entry) && (!isPlaced() || entry != kindSolid);
        search.isOver = isDone(search.walk);
        if (found || search.isOver)
            break;
    }
#endif
    square = squareOf(vtm, search.part, pixel, cell, side, entry);
    return found;
}

// A map and all that are placed in it and in each other, each with the palettes of those around it. Lanes of a processor
// that find their squares at different times add them together, and so with programs.
void addMap(Vtm vtm, CopyFootprint part, mat3x2 pixel, uint root, uint instances, inout vec4 sum) {
#if INNER_MAPS
    innerDepth = 0;  // the sample before may have been given up inside a map
#endif
    Search search = searchOf(part, root, instances);
    Square square;
#if PROGRAMS
    LeafSum leaf = noLeaf();
    bool isOver = false;
    while (!isOver && spend(1.0)) {
        while (!isOver && spend(1.0)) {
            if (isFinished(leaf) && nextSquare(vtm, search, pixel, square))
                leaf = leafOf(square);
            addAreas(vtm, leaf);
            addColors(vtm, leaf, sum);
            isOver = isFinished(leaf) && search.isOver;
            if (isOver || needsProgram(leaf))
                break;
        }
        if (!isOver)
            addProgram(vtm, leaf, pixel, sum);
        if (isOver)
            break;
    }
#elif SHARES
    LeafSum leaf = noLeaf();
    while (spend(1.0)) {
        if (isFinished(leaf) && nextSquare(vtm, search, pixel, square))
            leaf = leafOf(square);
        addAreas(vtm, leaf);
        addColors(vtm, leaf, sum);
        if (isFinished(leaf) && search.isOver)
            break;
    }
#else
    while (spend(1.0)) {
        if (nextSquare(vtm, search, pixel, square))
            sum += leafIntegral(vtm, square);
        if (search.isOver)
            break;
    }
#endif
}
