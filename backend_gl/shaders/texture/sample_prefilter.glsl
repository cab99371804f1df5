// A pixel's footprint in the picture, and its mean from the pyramid of means. docs/texture.md, docs/prefilter.md.
// Requires: sample_asset.glsl, coverage.glsl; constants wrap*, fadeFrom, fadeTo, maxAnisotropy,
// largestFootprint, smallestFootprint, largestPlace. Twin of: raster/tests/prefilter_sampler.cpp.
// Exports: Footprint, footprintOf, prefilterShare, prefiltered.

// Where a pixel's box lies: a parallelogram.
struct Footprint {
    vec2 st;                // its centre
    mat2 sides;             // picture units
    vec2 turn;              // by which they become orthogonal: turnToAxes()
    float longer, shorter;  // its axes (singular values of `sides`), in texels of the finest level
    bool wide;              // wider than a picture whose border's colours go on beyond it
};

// (cos, sin) of the angle, at most 45°, by which to turn a pixel's box so that its sides, mapped by m, are orthogonal:
// tan 2α = 2b / (a - c).
vec2 turnToAxes(mat2 m) {
    float a = dot(m[0], m[0]), b = dot(m[0], m[1]), c = dot(m[1], m[1]);
    vec2 twice = vec2(abs(a - c), mix(2.0 * b, -2.0 * b, a < c));
    float size = length(twice);
    float cosine = mix(1.0, sqrt(0.5 + 0.5 * twice.x / size), size > 0.0);
    return vec2(cosine, mix(0.0, 0.5 * twice.y / (size * cosine), size > 0.0));
}

mat2 turned(mat2 m, vec2 turn) { return m * mat2(turn.x, turn.y, -turn.y, turn.x); }

// Singular values, the larger first.
vec2 axesOf(mat2 m) {
    float a = dot(m[0], m[0]), b = dot(m[0], m[1]), c = dot(m[1], m[1]);
    float longer = sqrt(0.5 * (a + c) + length(vec2(0.5 * (a - c), b)));
    return vec2(longer, abs(cross2(m[0], m[1])) / longer);
}

// Footprints narrower than a 16th of their length are widened to that, as GPUs do. What is no number, or no
// footprint, becomes one that can be drawn.
Footprint footprintOf(Vtm vtm, vec2 st, vec2 dx, vec2 dy) {
    mat2 sides = mat2(dx * vtm.size, dy * vtm.size);
    float unit = max(vtm.size.x, vtm.size.y);
    if (!all(lessThan(abs(st), vec2(largestPlace))))
        st = vec2(0.0);
    vec2 axes = axesOf(sides);
    if (!(axes.x <= unit * largestFootprint)) {
        sides = mat2(unit * largestFootprint);
        axes = vec2(unit * largestFootprint);
    }
    if (!(axes.x >= unit * smallestFootprint)) {
        sides = mat2(unit * smallestFootprint);
        axes = vec2(unit * smallestFootprint);
    }
    float minimum = axes.x / maxAnisotropy;
    vec2 turn = turnToAxes(sides);
    if (axes.y < minimum) {
        sides = turned(sides, turn);
        turn = vec2(1.0, 0.0);
        bool firstIsLonger = dot(sides[0], sides[0]) > dot(sides[1], sides[1]);
        vec2 along = mix(sides[1], sides[0], bvec2(firstIsLonger)), across = vec2(-along.y, along.x) / maxAnisotropy;
        sides = mat2(mix(across, along, bvec2(firstIsLonger)), mix(along, across, bvec2(firstIsLonger)));
        axes.y = minimum;
    }
    // Clamp: the footprint's box stays inside the picture.
    vec2 halfBox = 0.5 * (abs(sides[0]) + abs(sides[1])) / vtm.size;
    bvec2 clamped = equal(vtm.wrapping, ivec2(wrapClamp));
    st = mix(st, clamp(st, min(halfBox, 0.5), max(1.0 - halfBox, 0.5)), clamped);
    bool wide = clamped.x && halfBox.x > 0.5 || clamped.y && halfBox.y > 0.5;
    vec2 texels = vtm.prefilterTexels / vtm.size;
    axes *= sqrt(texels.x * texels.y);
    return Footprint(st, sides, turn, axes.x, axes.y, wide);
}

// How much of the colour the prefilter gives, rising with the footprint: docs/prefilter.md. Less than half a 256th is none, and
// what rounding leaves of a footprint of fadeFrom texels.
float prefilterShare(Footprint footprint) {
    float width = (2.0 * log2(footprint.shorter) + log2(footprint.longer)) / 3.0;
    float share = clamp((width - log2(fadeFrom)) / log2(fadeTo / fadeFrom), 0.0, 1.0);
    share = round(share * 256.0) / 256.0;
    return footprint.wide ? 1.0 : share;
}

// Share of a bilinear tap that lies inside, where the picture is transparent beyond: texels of `size` a side.
float inside(int wrapping, float st, float size) {
    float share = clamp(st * size + 0.5, 0.0, 1.0) * clamp((1.0 - st) * size + 0.5, 0.0, 1.0);
    return wrapping == wrapBorder ? share : 1.0;
}

// ⌊log2 x⌋ of a normal number, and 2^n, exactly.
int exponentOf(float x) { return int(floatBitsToUint(x) >> 23 & 255u) - 127; }
float exp2i(int n) { return uintBitsToFloat(uint(127 + n) << 23); }

// Distance of `count` taps over `length` texels, as a share of it: docs/prefilter.md.
float tapSpacing(float length, float count, float texel) {
    float left = length * length - 2.0 * texel * texel;
    return mix(0.0, sqrt(left / (count * count - 1.0)) / length, left > 0.0 && count > 1.0);
}

vec4 prefiltered(Vtm vtm, Footprint footprint) {
    // A box turned by 45° is no better a pixel than the pixel's own: only slender ones are turned.
    float slender = clamp(footprint.longer / footprint.shorter - 1.0, 0.0, 1.0);
    vec2 turn = normalize(mix(vec2(1.0, 0.0), footprint.turn, slender));
    mat2 sides = turned(footprint.sides, turn);
    vec2 perUnit = 1.0 / vtm.size;
    sides = mat2(sides[0] * perUnit, sides[1] * perUnit);
    vec2 lengths = vec2(length(sides[0] * vtm.prefilterTexels), length(sides[1] * vtm.prefilterTexels));
    if (lengths.x < lengths.y) {
        sides = mat2(sides[1], sides[0]);
        lengths = lengths.yx;
    }
    float parts = clamp(round(lengths.x / lengths.y), 1.0, maxAnisotropy);
    // 64 in all at most; where texels a fifth as large exist, a few more.
    float taps = parts > 7.0 ? 2.0 : parts > 4.0 ? 3.0 : parts > 1.0 || lengths.y < 5.0 ? 4.0 : 5.0;
    // A whole level, of texels that taps are 0.87 to 1.74 apart: two levels blur more, and take software drivers longer.
    int level = exponentOf(max(max(lengths.x / parts, lengths.y) / taps, 1.0) * 1.148698355);  // 2^0.2
    float lod = float(level), texel = exp2i(level);
    vec2 count = vec2(taps * parts, taps), levelTexels = max(vtm.prefilterTexels * exp2i(-level), 1.0);
    vec2 spacing = vec2(tapSpacing(lengths.x, count.x, texel), tapSpacing(lengths.y, count.y, texel));
    vec4 sum = vec4(0.0);
    vec2 tap = vec2(0.0);
    while (tap.y < count.y) {
        vec2 st = footprint.st + sides * ((tap - 0.5 * (count - 1.0)) * spacing);
        sum += textureLod(vtm.prefilter, st, lod) * inside(vtm.wrapping.x, st.x, levelTexels.x) *
               inside(vtm.wrapping.y, st.y, levelTexels.y);
        tap = mix(vec2(0.0, tap.y + 1.0), vec2(tap.x + 1.0, tap.y), bvec2(tap.x + 1.0 < count.x));
        if (tap.y >= count.y)
            break;
    }
    return sum / (count.x * count.y);
}
