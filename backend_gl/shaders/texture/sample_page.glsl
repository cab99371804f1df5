// What a footprint has of a page of text: glyphs in the cells of a grid, whose maps are a font's. docs/fonts.md.
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
// Exports: addPage.

#if TEXT_PAGES

uint byteAt(Vtm vtm, uint texel, uint i) { return wordAt(vtm, texel, i >> 2) >> (8u * (i & 3u)) & 0xFFu; }

struct PageLayer {
    uvec4 records, kinds;  // the layer's first and last texel
    vec4 grid, reach;
};

// The glyphs of a layer that may meet a footprint, cell by cell.
struct GlyphWalk {
    ivec2 cell, first, last;
    uint next, end;    // of this cell's glyphs
    uint chained;      // symbol that stands in the same cell as the one before; 0: none
    vec2 corner;       // of that cell
    uint color;        // of that cell's glyphs, as a texel; 0: their own
};

GlyphWalk walkGlyphs(CopyFootprint part, PageLayer layer) {
    vec2 corner = layer.grid.xy, size = layer.grid.zw;
    ivec2 end = ivec2(layer.records.xy) - 1;
    ivec2 first = clamp(ivec2(floor((part.lower - layer.reach.zw - corner) / size)), ivec2(0), end + 1);
    ivec2 last = clamp(ivec2(floor((part.upper + layer.reach.xy - corner) / size)), ivec2(-1), end);
    return GlyphWalk(first.x > last.x ? ivec2(first.x, last.y + 1) : first, first, last, 0u, 0u, 0u, vec2(0.0), 0u);
}

// Steps on by a glyph or a cell; false if there are no more. `symbol` is 0 where the step found none.
bool stepGlyphs(Vtm vtm, CopyFootprint part, PageLayer layer, inout GlyphWalk walk, out uint symbol, out vec2 centre) {
    symbol = walk.chained;
    centre = walk.corner;
    walk.chained = 0u;
    if (symbol != 0u)
        return true;
    if (walk.next < walk.end) {
        uvec4 texel = texelAt(vtm, layer.records.w + (walk.next >> 1));
        uvec2 glyph = (walk.next & 1u) == 0u ? texel.xy : texel.zw;
        ++walk.next;
        centre = vec2(glyph & 0xFFFFFFu) / 8388608.0 - 0.5;
        if (all(lessThan(abs(centre - part.centre), part.halfBox + layer.reach.xy)))
            symbol = glyph.x >> 24 | glyph.y >> 24 << 8;
        return true;
    }
    if (walk.cell.y > walk.last.y)
        return false;
    uint index = uint(walk.cell.y) * layer.records.x + uint(walk.cell.x);
    if (layer.kinds.x == 1u) {
        symbol = byteAt(vtm, layer.records.z, index);
        centre = walk.corner = layer.grid.xy + vec2(walk.cell) * layer.grid.zw;
        walk.color = layer.kinds.y == 0u ? 0u : layer.kinds.z + byteAt(vtm, layer.kinds.y, index);
    } else {
        uint glyphs = wordAt(vtm, layer.records.z, index);
        walk.next = glyphs & 0xFFFFFFu;
        walk.end = walk.next + (glyphs >> 24);
    }
    walk.cell.x += 1;
    if (walk.cell.x > walk.last.x)
        walk.cell = ivec2(walk.first.x, walk.cell.y + 1);
    return true;
}

// Goes on to the next glyph that the footprint meets.
bool nextGlyph(Vtm vtm, CopyFootprint around, PageLayer layer, uvec4 page, inout GlyphWalk walk,
               out CopyFootprint part, out uint root) {
    uint symbol;
    vec2 centre;
    bool found = false;
    while (!found && spend(1.0) && stepGlyphs(vtm, around, layer, walk, symbol, centre)) {
        if (symbol == 0u)
            continue;
        uint place = page.z + page.w * symbol;
        uvec4 record = texelAt(vtm, place);
        vec4 linear = uintBitsToFloat(texelAt(vtm, place + 1u));
        if (layer.kinds.x == 1u) {
            walk.chained = record.y;
            centre += uintBitsToFloat(texelAt(vtm, place + 2u)).xy;
        }
        found = findMap(around, mat2(linear.xy, linear.zw), centre, part);
        root = record.x;
        pageInk = walk.color == 0u ? vec4(unpackUnorm2x16(record.z), unpackUnorm2x16(record.w))
                                   : uintBitsToFloat(texelAt(vtm, walk.color));
        if (found)
            break;
    }
    return found;
}

void addLayer(Vtm vtm, CopyFootprint around, mat3x2 pixel, PageLayer layer, uvec4 page, inout vec4 sum) {
    GlyphWalk walk = walkGlyphs(around, layer);
    CopyFootprint part = around;
    uint root = 0u;
    while (spend(1.0) && nextGlyph(vtm, around, layer, page, walk, part, root))
        addMap(vtm, part, pixel, root, 0u, sum);
}

void addPage(Vtm vtm, CopyFootprint part, mat3x2 pixel, inout vec4 sum) {
    uvec4 page = texelAt(vtm, vtm.page);
    pageGround = uintBitsToFloat(texelAt(vtm, vtm.page + 1u));
    if (pageGround.a > 0.0) {
        vec2 extent = vtm.size / vtm.square.z;
        Frame frame = Frame(part.toBox * mat2(extent.x, 0.0, 0.0, extent.y) * (1.0 / float(leafExtent)),
                            part.toBox * -part.centre + 0.5);
        sum += abs(squareArea(frame)) * pageGround;
    }
    onPage = true;
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

#endif
