// The asset's paint for a number that a placed map names: through the palettes of all maps around. Twin of PlacedPaints
// in asset/instances.hpp.
// Requires: sample_asset.glsl, fetch.glsl; INNER_MAPS.
// Exports: isPlaced, paintOf; innerDepth, innerPalettes, innerGrounds, which sample.glsl sets.

#if INNER_MAPS

int innerDepth = 0;  // of the map that is being added up
uint innerPalettes[INNER_MAPS], innerGrounds[INNER_MAPS];

bool isPlaced() { return innerDepth > 0; }

uint paletteAt(Vtm vtm, uint place) {
    uint word = texelAt(vtm, vtm.placed.w + place / 8u)[place / 2u & 3u];
    return (place & 1u) == 0u ? low(word) : high(word);
}

uint paintOf(Vtm vtm, uint number) {
    for (int i = innerDepth - 1; i >= 0; --i)
        number = number == 0u ? innerGrounds[i] : paletteAt(vtm, innerPalettes[i] + number - 1u);
    return number;
}

#else

bool isPlaced() { return false; }
uint paintOf(ASSET_IN uint number) { return number; }

#endif
