// What a footprint has of a map and of those that are placed in it and in each other. docs/instances.md.
// Requires: sample_asset.glsl, leaf_integral.glsl, placed_paints.glsl, sample_tree.glsl; INNER_MAPS, PROGRAMS; constants
// kind*, slopeScale.
// Exports: addMap.

#if INNER_MAPS

// Instances by where they stand; a map has a grid for each size of instances. Twin of: instance_grids.cpp, which writes the
// texels:
//     grid      columns and rows (16 bits each), first texel of the cells, of the entries, of the next grid or 0 (uints)
//               min corner of the first cell, cells a side of the map (floats)
//     cells     a word each: first entry, 2^24 times the number of entries
//     entry     instance; min and max x, min and max y of its box, 65536ths of the map's side, the whole of the last one
//               included (16 bits each); unused. Each cell that the box meets has one.
struct Grid {
    uvec4 records;   // its two texels
    vec4 place;
    ivec2 cell;      // whose entries come next
    uint next, end;  // texels of these
};

ivec2 cellAt(Grid grid, vec2 p) {
    ivec2 count = ivec2(low(grid.records.x), high(grid.records.x));
    return clamp(ivec2(floor((p - grid.place.xy) * grid.place.zw)), ivec2(0), count - 1);
}

const Grid noGrid = Grid(uvec4(0u), vec4(0.0), ivec2(0), 0u, 0u);

// Before the first cell that the footprint meets.
Grid gridAt(Vtm vtm, CopyFootprint part, uint texel) {
    if (texel == 0u)
        return noGrid;
    Grid grid = Grid(texelAt(vtm, texel), uintBitsToFloat(texelAt(vtm, texel + 1u)), ivec2(0), 0u, 0u);
    grid.cell = cellAt(grid, part.lower) - ivec2(1, 0);
    return grid;
}

bool isDone(CopyFootprint part, Grid grid) {
    return grid.records.x == 0u || grid.next == grid.end && grid.cell == cellAt(grid, part.upper);
}

uint wordOfCell(Grid grid) { return uint(grid.cell.y) * low(grid.records.x) + uint(grid.cell.x); }

// `texel` has the cell's word: enterCell().
void stepCell(CopyFootprint part, inout Grid grid, out uint texel) {
    int last = cellAt(grid, part.upper).x;
    grid.cell = grid.cell.x < last ? grid.cell + ivec2(1, 0) : ivec2(cellAt(grid, part.lower).x, grid.cell.y + 1);
    texel = grid.records.y + (wordOfCell(grid) >> 2);
}

void enterCell(inout Grid grid, uvec4 texel) {
    uint word = texel[wordOfCell(grid) & 3u];
    grid.next = grid.records.z + (word & 0xFFFFFFu);
    grid.end = grid.next + (word >> 24);
}

// Whether the footprint meets an entry's box. Of the cells that its own box and that one both meet, only that one tells which
// holds their common min corner, so an instance is met once.
bool meetsEntry(CopyFootprint part, Grid grid, uvec4 entry) {
    vec2 lower = vec2(low(entry.y), low(entry.z)) / 65536.0;
    vec2 upper = vec2(high(entry.y) + 1u, high(entry.z) + 1u) / 65536.0, corner = max(part.lower, lower);
    return all(lessThanEqual(corner, min(part.upper, upper))) && meetsBox(part, 0.5 * (lower + upper), 0.5 * (upper - lower)) &&
           cellAt(grid, corner) == grid.cell;
}

#endif

// Where the search for squares stands.
struct Search {
    CopyFootprint part;   // over the map
    Walk walk;            // over its squares
#if INNER_MAPS
    Grid grid;            // of its instances, which come next
#endif
    bool isOver;
};

#if INNER_MAPS

// The maps around, each amid its instances. The loops below make indices known when the program is compiled: some drivers
// store each lane of a processor for itself otherwise.
struct Around {
    CopyFootprint part;
    Grid grid;
};
Around outer[INNER_MAPS];

Search searchOf(Vtm vtm, CopyFootprint part, uint root, uint grid) {
    return Search(part, walkFrom(root), gridAt(vtm, part, grid), false);
}

// Into an instance; its map's first grid, which is returned, comes next.
uint enterInstance(Vtm vtm, uint number, inout Search search) {
    uvec4 instance = texelAt(vtm, placedOf.x + number);
    uint place = placedOf.y + 2u * (instance.x >> 24 | instance.y >> 24 << 8);
    uvec4 symbol = texelAt(vtm, place);
    ivec4 m = ivec4(instance.z << 16, instance.z, instance.w << 16, instance.w) >> 16;
    mat2 linear = mat2(vec2(m.xy), vec2(m.zw)) * (uintBitsToFloat(symbol.z) / slopeScale);
    vec2 centre = vec2(instance.xy & 0xFFFFFFu) / 16777216.0;
    uvec4 map = texelAt(vtm, place + 1u);
    for (int i = 0; i < INNER_MAPS; ++i)
        if (i == innerDepth) {
            innerGrounds[i] = high(symbol.x);
            innerPalettes[i] = symbol.y;
            outer[i] = Around(search.part, search.grid);
        }
    ++innerDepth;
    search.part = partOver(search.part, linear, centre);
    search.walk = walkFrom(map.x);
    uint grid = map.y;
    return innerDepth < INNER_MAPS ? grid : 0u;
}

// To a map's next grid, or back to the map around.
bool leave(inout Search search, out uint grid) {
    grid = search.grid.records.w;
    if (grid != 0u)
        return true;
    if (innerDepth > 0) {
        --innerDepth;
        for (int i = 0; i < INNER_MAPS; ++i)
            if (i == innerDepth) {
                search.part = outer[i].part;
                search.grid = outer[i].grid;
            }
    } else {
        search.isOver = true;
    }
    return false;
}

bool isAtEnd(Search search) { return isDone(search.walk) && isDone(search.part, search.grid); }

#else

Search searchOf(Vtm vtm, CopyFootprint part, uint root, uint grid) { return Search(part, walkFrom(root), false); }

#endif

// Goes on to the next square that the footprint meets; false if there is none.
bool nextSquare(Vtm vtm, inout Search search, mat3x2 pixel, out Square square) {
    ivec2 cell = ivec2(0);
    float side = 1.0;
    uint entry = 0u;
    bool found = false;
#if INNER_MAPS
    // What is done for each square or instance stands in the inner loop, what is done for few of them around it. A step reads
    // one texel, whatever it does.
    while (!search.isOver && spend(1.0)) {
        uvec4 texel = uvec4(0u);
        bool isNear = false, ended = isAtEnd(search);
        while (!ended && spend(1.0)) {
            bool inTree = !isDone(search.walk), inCell = !inTree && search.grid.next < search.grid.end;
            uint place;
            if (inTree)
                found = advance(search.part, search.walk, cell, side, entry, place) && entry != groundEntry();
            else if (inCell)
                place = search.grid.next++;
            else
                stepCell(search.part, search.grid, place);
            texel = texelAt(vtm, place);
            if (inTree)
                setEntry(search.walk, texel);
            else if (inCell)
                isNear = meetsEntry(search.part, search.grid, texel);
            else
                enterCell(search.grid, texel);
            ended = isAtEnd(search);
            if (found || isNear || ended)
                break;
        }
        uint grid;
        bool opens = isNear;
        if (isNear)
            grid = enterInstance(vtm, texel.x, search);
        else if (!found && ended)
            opens = leave(search, grid);
        if (opens)
            search.grid = gridAt(vtm, search.part, grid);
        if (found || search.isOver)
            break;
    }
#else
    // Of what is placed there is nothing where its paint is the ground's.
    while (!search.isOver && spend(1.0)) {
        uint place;
        found = advance(search.part, search.walk, cell, side, entry, place) && entry != groundEntry();
        setEntry(search.walk, texelAt(vtm, place));
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
void addMap(Vtm vtm, CopyFootprint part, mat3x2 pixel, uint root, uint grid, inout vec4 sum) {
#if INNER_MAPS
    innerDepth = 0;  // the sample before may have been given up inside a map
#endif
    Search search = searchOf(vtm, part, root, grid);
    descend(vtm, part, search.walk);
    Square square;
#if PROGRAMS
    LeafSum leaf = noLeaf();
    bool isOver = false;
    while (!isOver && spend(1.0)) {
        while (!isOver && spend(1.0)) {
            if (isFinished(leaf) && nextSquare(vtm, search, pixel, square))
                leaf = leafOf(square, sum);
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
#else
    while (spend(1.0)) {
        if (nextSquare(vtm, search, pixel, square))
            sum += leafIntegral(vtm, square);
        if (search.isOver)
            break;
    }
#endif
}
