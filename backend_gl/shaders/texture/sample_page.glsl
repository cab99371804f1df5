// What a footprint has of a picture, or of a page of text: glyphs in the cells of a grid, whose maps are a font's. docs/fonts.md.
// Requires: sample_asset.glsl, leaf_integral.glsl, placed_paints.glsl, sample_tree.glsl, sample_maps.glsl; TEXT_PAGES;
// constant leafExtent.
// Twin of: page_texels.cpp, which writes the texels. Lengths are in sides of the page's square, floats unless stated:
//     page      number of layers, first texel of the layers, of the symbols, texels of a symbol (uints)
//               ground, premultiplied
//     layer     columns, rows, first texel of the cells, of the glyphs (uints)
//               min corner of the first cell, size of a cell
//               how far glyphs reach beyond their cells: before them (x, y), behind them
//               1 if a cell names its symbol, colours or 0, palette, unused (uints)
//     symbol    root of the map, next symbol in the cell or 0, colour over the ground as four 16-bit unorms (uints)
//               linear map from the map's square, columns
//               centre of that square in its cell, unused; on pages of cells only
//     cells     8 bits: symbol, 0 for none; or 32 bits: first glyph, 2^24 times the number of glyphs
//     glyph     8 bytes: centre x and y in 24 bits each, over [-1/2, 3/2); symbol in the high bytes
// Exports: addPicture.

#if TEXT_PAGES

struct PageLayer {
    uvec4 records, kinds;  // the layer's first and last texel
    vec4 grid, reach;
};

// The glyphs of a layer that may meet a footprint, cell by cell.
struct GlyphWalk {
    ivec2 cell, first, last;
    uint next, end;    // of this cell's glyphs
    uint symbol;       // that the last step found, or that stands in the same cell as the one before; 0: none
    vec2 centre;       // of it, or of its cell's min corner
    uint index;        // of its cell
    bool isOver;
};

GlyphWalk walkGlyphs(CopyFootprint part, PageLayer layer) {
    vec2 corner = layer.grid.xy, size = layer.grid.zw;
    ivec2 end = ivec2(layer.records.xy) - 1;
    ivec2 first = clamp(ivec2(floor((part.lower - layer.reach.zw - corner) / size)), ivec2(0), end + 1);
    ivec2 last = clamp(ivec2(floor((part.upper + layer.reach.xy - corner) / size)), ivec2(-1), end);
    return GlyphWalk(first, first, last, 0u, 0u, 0u, vec2(0.0), 0u, any(greaterThan(first, last)));
}

bool isDone(GlyphWalk walk) { return walk.isOver && walk.symbol == 0u; }
bool namesSymbols(PageLayer layer) { return layer.kinds.x == 1u; }

// Steps on by a glyph or a cell, reading one texel.
void stepGlyphs(Vtm vtm, CopyFootprint part, PageLayer layer, inout GlyphWalk walk) {
    bool isGlyph = walk.next < walk.end;
    uint index = uint(walk.cell.y) * layer.records.x + uint(walk.cell.x), word = namesSymbols(layer) ? index >> 2 : index;
    uvec4 texel = texelAt(vtm, isGlyph ? layer.records.w + (walk.next >> 1) : layer.records.z + (word >> 2));
    if (isGlyph) {
        uvec2 glyph = (walk.next & 1u) == 0u ? texel.xy : texel.zw;
        ++walk.next;
        walk.centre = vec2(glyph & 0xFFFFFFu) / 8388608.0 - 0.5;
        if (all(lessThan(abs(walk.centre - part.centre), part.halfBox + layer.reach.xy)))
            walk.symbol = glyph.x >> 24 | glyph.y >> 24 << 8;
    } else {
        uint found = texel[word & 3u];
        if (namesSymbols(layer)) {
            walk.symbol = found >> (8u * (index & 3u)) & 0xFFu;
            walk.centre = layer.grid.xy + vec2(walk.cell) * layer.grid.zw;
            walk.index = index;
        } else {
            walk.next = found & 0xFFFFFFu;
            walk.end = walk.next + (found >> 24);
        }
        walk.cell = walk.cell.x < walk.last.x ? walk.cell + ivec2(1, 0) : ivec2(walk.first.x, walk.cell.y + 1);
    }
    walk.isOver = walk.next == walk.end && walk.cell.y > walk.last.y;
}

vec4 inkOf(Vtm vtm, PageLayer layer, uvec4 symbol, uint index) {
    uint color = layer.kinds.z + (wordAt(vtm, layer.kinds.y, index >> 2) >> (8u * (index & 3u)) & 0xFFu);
    return layer.kinds.y == 0u ? vec4(unpackUnorm2x16(symbol.z), unpackUnorm2x16(symbol.w))
                               : uintBitsToFloat(texelAt(vtm, color));
}

// Goes on to the next glyph that the footprint meets. What is done for each glyph or cell stands in the inner loop, what is
// done for few of them around it.
bool nextGlyph(Vtm vtm, CopyFootprint around, PageLayer layer, uvec4 page, inout GlyphWalk walk,
               out CopyFootprint part, out uint root) {
    bool found = false;
    while (!isDone(walk) && spend(1.0)) {
        while (!walk.isOver && walk.symbol == 0u && spend(1.0)) {
            stepGlyphs(vtm, around, layer, walk);
            if (walk.isOver || walk.symbol != 0u)
                break;
        }
        uint place = page.z + page.w * walk.symbol;
        uvec4 record = texelAt(vtm, place);
        vec4 linear = uintBitsToFloat(texelAt(vtm, place + 1u));
        vec2 inCell = namesSymbols(layer) ? uintBitsToFloat(texelAt(vtm, place + 2u)).xy : vec2(0.0);
        part = partOver(around, mat2(linear.xy, linear.zw), walk.centre + inCell);
        found = meetsMap(part) && walk.symbol != 0u;
        root = record.x;
        pageInk = inkOf(vtm, layer, record, walk.index);
        walk.symbol = namesSymbols(layer) ? record.y : 0u;
        if (found || isDone(walk))
            break;
    }
    return found;
}

// A picture that is no page is met once, as it is: compilers inline addMap, so it stands in a program once.
void addLayer(Vtm vtm, CopyFootprint around, mat3x2 pixel, PageLayer layer, uvec4 page, inout vec4 sum) {
    GlyphWalk walk = walkGlyphs(around, layer);
    CopyFootprint part = around;
    uint root = vtm.root, grid = onPage ? 0u : gridOf(vtm);
    while (spend(1.0)) {
        bool found = !onPage;
        if (onPage)
            found = nextGlyph(vtm, around, layer, page, walk, part, root);
        if (found)
            addMap(vtm, part, pixel, root, grid, sum);
        if (!onPage || isDone(walk))
            break;
    }
}

vec4 groundSum(Vtm vtm, CopyFootprint part) {
    vec2 extent = vtm.size / vtm.square.z;
    Frame frame = Frame(part.toBox * mat2(extent.x, 0.0, 0.0, extent.y) * (1.0 / float(leafExtent)),
                        part.toBox * -part.centre + 0.5);
    return abs(squareArea(frame)) * pageGround;
}

void addPicture(Vtm vtm, CopyFootprint part, mat3x2 pixel, inout vec4 sum) {
    onPage = vtm.page != 0u;
    uvec4 page = uvec4(1u, 0u, 0u, 0u);
    if (onPage) {
        page = texelAt(vtm, vtm.page);
        pageGround = groundColor = uintBitsToFloat(texelAt(vtm, vtm.page + 1u));
        sum += groundSum(vtm, part);
    }
    for (uint i = 0u; i < page.x && spend(1.0); ++i) {
        uint at = page.y + 4u * i;
        PageLayer layer = PageLayer(texelAt(vtm, at), texelAt(vtm, at + 3u), uintBitsToFloat(texelAt(vtm, at + 1u)),
                                    uintBitsToFloat(texelAt(vtm, at + 2u)));
        addLayer(vtm, part, pixel, layer, page, sum);
        if (i + 1u == page.x)
            break;
    }
    onPage = false;
}

#else

void addPicture(Vtm vtm, CopyFootprint part, mat3x2 pixel, inout vec4 sum) {
    addMap(vtm, part, pixel, vtm.root, gridOf(vtm), sum);
}

#endif
