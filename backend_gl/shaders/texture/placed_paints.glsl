// The asset's paint for a number that a placed map names: through the palettes of all maps around. Twin of PlacedPaints
// in asset/instances.hpp. And what lies under a map: its ground, so that only what differs is added up.
// Requires: sample_asset.glsl, fetch.glsl; INNER_MAPS, TEXT_PAGES; constant kindSolid.
// Exports: isPlaced, paintOf; innerDepth, innerPalettes, innerGrounds, which sample_maps.glsl sets; onPage, pageColor,
// pageGround, pageInk, which sample_page.glsl sets; layGround, groundColor, groundEntry, groundOf.

#if TEXT_PAGES
bool onPage = false;       // a glyph of a page is added up
vec4 pageGround, pageInk;  // outside it and inside, premultiplied
vec4 pageColor(uint number) { return number == 0u ? pageGround : pageInk; }
#else
const bool onPage = false;
vec4 pageColor(uint number) { return vec4(0.0); }
#endif

#if INNER_MAPS

int innerDepth = 0;  // of the map that is being added up
uint innerPalettes[INNER_MAPS], innerGrounds[INNER_MAPS];

bool isPlaced() { return innerDepth > 0 || onPage; }

uint paletteAt(Vtm vtm, uint place) {
    uint word = texelAt(vtm, placedOf.z + place / 8u)[place / 2u & 3u];
    return (place & 1u) == 0u ? low(word) : high(word);
}

uint paintOf(Vtm vtm, uint number) {
    for (int i = INNER_MAPS - 1; i >= 0; --i)
        if (i < innerDepth)
            number = number == 0u ? innerGrounds[i] : paletteAt(vtm, innerPalettes[i] + number - 1u);
    return number;
}

#else

bool isPlaced() { return onPage; }
uint paintOf(ASSET_IN uint number) { return number; }

#endif

// Of the picture's own map, or of a page. The paint that most of the map's squares show lies under each footprint inside the
// picture, so that these squares add nothing; under others lies paint 0, which is transparent.
uint groundPaint = 0u;
vec4 groundColor = vec4(0.0);

void layGround(Vtm vtm, bool isInside, inout vec4 sum) {
    uint most = vtm.ground;
    groundPaint = isInside ? most : 0u;
    groundColor = solidColor(vtm, groundPaint);
    sum += groundColor;
}

// A square that adds nothing to the map that is being added up.
uint groundEntry() {
    uint number = isPlaced() ? 0u : groundPaint;
    return number << 2 | kindSolid;
}

// What lies under the map that is being added up.
vec4 groundOf(Vtm vtm) {
#if INNER_MAPS
    vec4 inner = solidColor(vtm, paintOf(vtm, 0u)), outer = groundColor;
    return innerDepth > 0 ? inner : outer;
#else
    return groundColor;
#endif
}
