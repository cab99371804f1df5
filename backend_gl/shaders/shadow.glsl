// What one piece changes in a pixel: the crossings on the way from a cell's reference point R to the pixel's
// centre O, and the piece's shadow, seen from O, in the pixel's box (docs/coverage.md).
// Requires: constants patchStep, patchSlopeScale, leftOfChordBit, leftOfCurveBit.
// Exports: pixelToPatch, patchToPixel, PatchPiece, patchPiece, pieceWeight.

uniform vec4 pixelToPatch;  // linear parts, by columns
uniform vec4 patchToPixel;

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }
vec2 times(vec4 matrix, vec2 v) { return matrix.xy * v.x + matrix.zw * v.y; }

// A piece of src/patch.hpp relative to O, in patch sides.
struct PatchPiece {
    vec2 a, b, chord;
    float slopeA, slopeB;
};

PatchPiece patchPiece(uvec3 bits, vec2 o) {
    vec4 ab = vec4(uvec4(bits.x, bits.x >> 18 | bits.y << 14, bits.y >> 4, bits.y >> 22 | bits.z << 10) &
                   0x3FFFFu) * patchStep - 1.0;
    vec2 slopes = vec2(ivec2(bits.zz << uvec2(12u, 0u)) >> 20) / patchSlopeScale;
    return PatchPiece(ab.xy - o, ab.zw - o, ab.zw - ab.xy, slopes.x, slopes.y);
}

float heightAt(PatchPiece p, float s) {
    float r = 1.0 - s;
    return s * r * (p.slopeA * r - p.slopeB * s);
}

// Relative to O, pixels. From the nearer end, so that the ends are exactly those of the next pieces.
vec2 curvePoint(PatchPiece p, float s) {
    vec2 along = s < 0.5 ? p.a + s * p.chord : p.b - (1.0 - s) * p.chord;
    return times(patchToPixel, along + heightAt(p, s) * vec2(-p.chord.y, p.chord.x));
}

// Where the ray from O through v leaves the box: the way along its border in sides, from the middle of the right
// one, over which the area swept by the ray grows by 1/4 a side.
float borderPlace(vec2 v) {
    bool wide = abs(v.x) >= abs(v.y);
    float slope = wide ? v.y / v.x : -v.x / v.y;
    float side = wide ? (v.x > 0.0 ? 0.0 : 2.0) : (v.y > 0.0 ? 1.0 : 3.0);
    return side + 0.5 * slope;
}

// The part of the curve in the box, taken as its tangent's at the foot of O, clamped to the piece.
vec2 rangeInBox(PatchPiece p, float foot, float tangentSlope) {
    vec2 middle = curvePoint(p, foot);
    vec2 way = times(patchToPixel, p.chord + tangentSlope * vec2(-p.chord.y, p.chord.x));
    way = mix(way, vec2(1e-20), lessThan(abs(way), vec2(1e-20)));
    vec2 u = (vec2(-0.5) - middle) / way, v = (vec2(0.5) - middle) / way;
    vec2 least = min(u, v), most = max(u, v);
    vec2 range = foot + vec2(max(least.x, least.y), min(most.x, most.y));
    return range.x < range.y ? clamp(range, 0.0, 1.0) : vec2(0.0);
}

// The factor of c_left - c_right. way: O - R; bits: how R lies.
float pieceWeight(PatchPiece p, vec2 way, uint bits) {
    float inverse = 1.0 / dot(p.chord, p.chord);
    float s = -dot(p.a, p.chord) * inverse, t = -cross2(p.chord, p.a) * inverse;
    float foot = clamp(s, 0.0, 1.0), rest = 1.0 - foot;
    bool leftOfChord = t > 0.0;
    bool leftOfCurve = foot == s ? t > heightAt(p, s) : leftOfChord;

    // R sees a and b, relative to it, on both sides of its way to O.
    bool between = (cross2(way, p.a + way) > 0.0) != (cross2(way, p.b + way) > 0.0);
    float chordO = leftOfChord ? 1.0 : 0.0, curveO = leftOfCurve ? 1.0 : 0.0;
    float chordR = float(bits & leftOfChordBit), curveR = (bits & leftOfCurveBit) != 0u ? 1.0 : 0.0;
    float crossings = (between ? chordO - chordR : 0.0) + (curveO - chordO) - (curveR - chordR);

    float slope = p.slopeA * rest * (1.0 - 3.0 * foot) - p.slopeB * foot * (2.0 - 3.0 * foot);
    vec2 range = rangeInBox(p, foot, slope);
    if (!(range.x < range.y))
        return crossings;
    float determinant = patchToPixel.x * patchToPixel.w - patchToPixel.y * patchToPixel.z;
    vec2 p0 = curvePoint(p, range.x), p1 = curvePoint(p, range.y);
    float triangle = cross2(p0, p1);
    // Seen from the left the curve goes round O counter-clockwise, whatever the roundings say of its ends.
    bool counterClockwise = foot == s ? leftOfCurve == (determinant > 0.0) : triangle > 0.0;
    float sweep = borderPlace(p1) - borderPlace(p0);
    sweep = counterClockwise ? (sweep < 0.0 ? sweep + 4.0 : sweep) : (sweep > 0.0 ? sweep - 4.0 : sweep);
    // Between curve and chord: -w³ t''(middle) / 12 chord² to the left of the chord.
    float w = range.y - range.x, m = 0.5 * (range.x + range.y);
    float bend = p.slopeA * (6.0 * m - 4.0) + p.slopeB * (6.0 * m - 2.0);
    float lens = -w * w * w * bend / 12.0 * dot(p.chord, p.chord) * determinant;
    float shadow = 0.25 * sweep - 0.5 * triangle + lens;
    return crossings - (determinant > 0.0 ? shadow : -shadow);
}
