// One mask repeated over the plane, as the paper has it (rows 6 to 11): a lookup and two colours. Each step is a
// function, so that bench_report can count it in the compiled shader.
// Requires: paper_hermite.glsl; COMPRESSED, FILTERED, LINEAR, CELLS, MIP, SURFACE defined as 1 or 0, DEPTH; constants
// pattern*. With SURFACE, CELLS too.
// Made by: paper/gl/pattern.cpp. Twin of: paper/evaluate/mask.cpp.

mat2 pixelInPeriods;           // a pixel's sides
#if SURFACE
in vec2 st;                    // in periods
float lod;                     // of the mip's level 0
uniform float mipLog2;         // its side
#else
uniform mat3x2 toPattern;      // (pixel, 1) to periods
uniform float lod;
#endif
uniform vec4 insideColor, outsideColor;
#if CELLS
uniform usampler2D places;     // of squares: column of the cell's or the node's texel, a multiple of 4, + kind; row << 16
uniform sampler2D cells;       // A and B, in periods, in a texel; slopes and operator in the next; twice
#endif
#if MIP
uniform sampler2D mip;         // of the classification function; the analytic coverage stands for a level before 0
#endif

out vec4 color;

#if CELLS
ivec2 texelOf(uint place) { return ivec2(place & 0xFFFCu, place >> 16); }

// The place of the finest square that holds a point.
#if COMPRESSED
// One level of the 16-tree (row 8).
uint descend(uint place, ivec2 square, int level) {
    return texelFetch(places, texelOf(place) + (square >> (2 * (DEPTH - 1 - level)) & 3), 0).x;
}

uint find(vec2 uv) {
    ivec2 square = ivec2(uv * float(1 << (2 * DEPTH)));
    uint place = 0u;
    for (int level = 0; level < DEPTH; ++level)
        place = descend(place, square, level);
    return place;
}
#else
uint find(vec2 uv) { return texelFetch(places, ivec2(uv * float(1 << (2 * DEPTH))), 0).x; }
#endif

// Above zero inside. Filtered: in pixels, to first order (row 6). All times the square of the chord's length, which spares
// dividing by it twice.
float pieceDistance(ivec2 texel, vec2 slopes, vec2 uv) {
    vec4 ends = texelFetch(cells, texel, 0);
    vec2 chord = ends.zw - ends.xy, across = vec2(-chord.y, chord.x), p = uv - ends.xy;
    float square = dot(chord, chord);
#if LINEAR
    vec2 t = vec2(0.0);
#else
    vec2 t = hermite(slopes, dot(p, chord) / square);
#endif
    float f = dot(p, across) - t.x * square;
#if FILTERED
    vec2 gradient = (across - t.y * chord) * pixelInPeriods;
    f /= length(gradient);
#endif
    return f;
}

// Functions 0 to i of a cell, given those before i (row 2).
float combined(uint place, vec2 uv, int i, float before) {
    ivec2 texel = texelOf(place) + ivec2(2 * i, 0);
    vec4 slopes = texelFetch(cells, texel + ivec2(1, 0), 0);
    float d = pieceDistance(texel, slopes.xy, uv);
    return i == 0 ? d : slopes.z * min(slopes.z * before, slopes.z * d);
}

// Share of the pixel that is inside, by what its centre's cell says. No boundary, no loop: early out (row 9).
float cellCoverage(vec2 uv) {
    uint place = find(uv), kind = place & 3u;
    int count = int(kind) - int(patternInside);
    float h = 0.0;
    for (int i = 0; i < count; ++i)
        h = combined(place, uv, i, h);
#if FILTERED
    return count > 0 ? clamp(0.5 + h, 0.0, 1.0) : float(kind);
#else
    return count > 0 ? float(h > 0.0) : float(kind);
#endif
}
#endif

#if MIP
// Row 7: from a pixel of half a texel to one of a texel the mip takes over, and its levels are blended as any texture's.
float minified(float coverage, vec2 st) { return mix(coverage, textureLod(mip, st, lod).r, clamp(lod + 1.0, 0.0, 1.0)); }
#endif

void main() {
#if SURFACE
    pixelInPeriods = mat2(dFdx(st), dFdy(st));
#if MIP
    vec2 sides = vec2(dot(pixelInPeriods[0], pixelInPeriods[0]), dot(pixelInPeriods[1], pixelInPeriods[1]));
    lod = 0.5 * log2(max(sides.x, sides.y)) + mipLog2;
#endif
#else
    pixelInPeriods = mat2(toPattern[0], toPattern[1]);
    vec2 st = toPattern * vec3(gl_FragCoord.xy, 1.0);
#endif
    float b = 0.0;
#if CELLS
    b = cellCoverage(min(fract(st), patternLargest));  // rounding may reach the period
#endif
#if MIP
    b = minified(b, st);
#endif
    color = mix(outsideColor, insideColor, b);
}
