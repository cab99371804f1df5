// Pixels of the target, which are stored as four bytes whatever their format is: what is there, and how a
// colour is stored. Requires: layer_prelude.glsl, spaces.glsl, block of cover_vertex.glsl.
// Exports: shareOf, storedBefore, beforeOf, stored, and the output `color`.

flat in ivec4 block;
flat in vec4 tileColor;

uniform sampler2D shares;

#ifdef FETCHES
layout(location = 0) inout vec4 color;
vec4 storedBefore(ivec2 pixel) { return color; }
#else
layout(location = 0) out vec4 color;
uniform sampler2D backdrop;
vec4 storedBefore(ivec2 pixel) { return texelFetch(backdrop, pixel, 0); }
#endif

const int shareColumns = 2048;
const int kindColor = 0, kindGrey = 1, kindAlpha = 2;

float shareOf(ivec2 pixel) {
    if (block.w == -1)
        return 1.0;
    ivec2 place = pixel - block.xy;
    int i = block.w + place.y * block.z + place.x;
    return texelFetch(shares, ivec2(i % shareColumns, i / shareColumns), 0).r;
}

// Premultiplied, in the surface's space. Where alpha has few levels, its rounding may fall below a colour's.
vec4 beforeOf(vec4 before) {
    before = exactly(before, levels);
    return surface.z != 0 ? vec4(min(before.rgb, before.a), before.a) : premultiplied(before);
}

// Of a colour as the surface's space has it, premultiplied or not.
vec4 storedColor(vec4 c) {
    if (surface.w == 0)
        c.a = 1.0;
    else if (surface.z != 0)
        c.rgb = min(c.rgb, c.a);
    c = floor(clamp(c, 0.0, 1.0) * levels + 0.5) / levels;
    if (surface.x == kindAlpha)
        return surface.z != 0 ? vec4(c.a) : vec4(vec3(1.0), c.a);
    return surface.x == kindGrey ? vec4(vec3(c.r), 1.0) : c;
}
// Of a premultiplied one.
vec4 stored(vec4 c) { return storedColor(surface.z != 0 ? c : unpremultiplied(c)); }
