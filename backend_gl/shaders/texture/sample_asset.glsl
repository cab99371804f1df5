// An asset as a uniform: `uniform Vtm sign;`. backend_gl/texture/sampled_texture.cpp binds it.
// Requires: IMAGE, INNER_MAPS, TEXT_PAGES, SAMPLED_TEXELS. Exports: Vtm; ASSET_IN, ASSET, ASSET_PART, SECTIONS, TEXEL_SIZE,
// spend for fetch.glsl; nodesOf, placedOf, gridOf, readNumbers; turnsLeft.

struct Vtm {
    usampler2D texels;     // all records
    sampler2D prefilter;   // the pyramid of means
#if IMAGE
    sampler2D images;
#endif
    uvec4 sections;        // first texels of the leaves, pieces, paints and data
    uint imageSection;     // first texel of the list of pictures
    uint rampSums;         // first texel of the integrals of ramps
    uint nodes;            // first texel of the nodes
    uint root;             // entry of the tree
    uint ground;           // solid paint that most of the picture's squares show
    uint features;         // of the paint programs, one bit each
    vec2 size;             // of the picture, its units
    vec3 square;           // the tree's: least x and y, side
    vec2 prefilterTexels;  // of the finest level
    ivec2 wrapping;        // beyond [0, 1] of s and of t
#if TEXT_PAGES
    uint page;             // first texel of a page of text; 0: a picture
#endif
#if INNER_MAPS
    uint grid;             // first texel of the map's first grid of instances; 0: it has none
    uvec3 placed;          // first texels of the instances, the symbols and the palettes
#endif
};

#define ASSET_IN Vtm vtm,
#define ASSET vtm,
#define ASSET_PART(name) vtm.name

// What loops use of a Vtm: some drivers gather a uniform lane by lane, each time that it is read.
uvec4 sectionsOf = uvec4(0u);
uint nodesOf = 0u;
uvec3 placedOf = uvec3(0u);
vec2 texelSize = vec2(0.0);
#define SECTIONS sectionsOf
#define TEXEL_SIZE texelSize

uint gridOf(Vtm vtm) {
#if INNER_MAPS
    return vtm.grid;
#else
    return 0u;
#endif
}

void readNumbers(Vtm vtm) {
    sectionsOf = vtm.sections;
    nodesOf = vtm.nodes;
#if INNER_MAPS
    placedOf = vtm.placed;
#endif
#if SAMPLED_TEXELS
    texelSize = 1.0 / vec2(textureSize(vtm.texels, 0));
#endif
}

// Turns of loops that a pixel may still take (backend_gl/core/turns.hpp). What would take more is not done: spend() says so.
float turnsLeft = 0.0;

bool spend(float turns) {
    turnsLeft -= turns;
    return turnsLeft >= 0.0;
}
