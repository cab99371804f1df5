// What one piece changes in a pixel: the crossings on the way from a cell's reference point R to the pixel's
// centre O, and the piece's shadow, seen from O, in the pixel's box (docs/coverage.md).
// Requires: place.glsl; block_vertex.glsl's outputs; constants tileStep, tileSlopeScale, leftOfChordBit, leftOfCurveBit.
// Exports: TilePiece, tilePiece, mayMeetPixel, pieceWeight, sidesOf.

flat in vec4 tileToBox;

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// A piece of backend_gl/tiles/tile.hpp relative to O, in tile sides.
struct TilePiece {
    vec2 a, b, chord;
    float slopeA, slopeB;
};

TilePiece tilePiece(uvec3 bits, vec2 o) {
    vec4 ab = vec4(uvec4(bits.x, bits.x >> 18 | bits.y << 14, bits.y >> 4, bits.y >> 22 | bits.z << 10) & 0x3FFFFu) *
                  tileStep -
              1.0;
    vec2 slopes = vec2(ivec2(bits.zz << uvec2(12u, 0u)) >> 20) / tileSlopeScale;
    return TilePiece(ab.xy - o, ab.zw - o, ab.zw - ab.xy, slopes.x, slopes.y);
}

// Whether it may have a shadow in the pixel: the box around its ends, grown by how far it is from its chord, meets it.
bool mayMeetPixel(TilePiece p) {
    vec2 a = times(tileToBox, p.a), b = times(tileToBox, p.b), across = times(tileToBox, vec2(-p.chord.y, p.chord.x));
    vec2 margin = 0.5 + 4.0 / 27.0 * (abs(p.slopeA) + abs(p.slopeB)) * abs(across);
    return all(lessThanEqual(min(a, b), margin)) && all(greaterThanEqual(max(a, b), -margin));
}

// Where the ray from O through v leaves the box: the way along its border in sides, from the middle of the right
// one, over which the area swept by the ray grows by 1/4 a side.
float borderPlace(vec2 v) {
    bool wide = abs(v.x) >= abs(v.y);
    float along = wide ? v.x : v.y, across = wide ? v.y : -v.x;
    return (wide ? 0.0 : 1.0) + (along > 0.0 ? 0.0 : 2.0) + 0.5 * across / along;
}

// The shadow of the curve middle + u tangent + (bend u² + third u³) across for u in the range; turn: 1 if O lies to its
// left, -1 to its right, 0 if its ends tell.
float shadowOf(vec2 middle, vec2 tangent, vec2 across, float bend, float third, vec2 range, float turn) {
    vec2 p0 = middle + range.x * (tangent + range.x * (bend + range.x * third) * across);
    vec2 p1 = middle + range.y * (tangent + range.y * (bend + range.y * third) * across);
    // The shorter way round, but where that is about a half: from the left the curve goes round O
    // counter-clockwise, whatever roundings say of its ends.
    float sweep = 0.25 * (borderPlace(p1) - borderPlace(p0));
    sweep -= floor(sweep + 0.5);
    sweep += turn * sweep < -0.25 ? turn : 0.0;
    // Between chord and curve, to the left of the chord: -w³ t''(middle) / 12 length².
    float w = range.y - range.x;
    float lens = -w * w * w * (bend + 1.5 * third * (range.x + range.y)) / 6.0 * cross2(tangent, across);
    return w > 0.0 ? sweep - 0.5 * cross2(p0, p1) + lens : 0.0;
}

// A point of a piece next to O, up to rounding the nearest: the place s of the curve, its height there and the slope.
struct Foot {
    float s;
    float height, slope;
    bool leftOfChord, leftOfCurve;  // so lies O
    bool inside;                    // next to O it does not end
};

Foot footOf(TilePiece p) {
    float length2 = dot(p.chord, p.chord);
    float along = -dot(p.a, p.chord) / length2, t = -cross2(p.chord, p.a) / length2;
    float s = clamp(along, 0.0, 1.0), rest = 1.0 - s;
    float height = s * rest * (p.slopeA * rest - p.slopeB * s);
    float slope = p.slopeA * rest * (1.0 - 3.0 * s) - p.slopeB * s * (2.0 - 3.0 * s);
    return Foot(s, height, slope, t > 0.0, s == along ? t > height : t > 0.0, s == along);
}

// The factor of c_left - c_right. way: O - R; bits: how R lies; toBox: tileToBox, or that of a part of the pixel whose
// middle O is.
float pieceWeight(TilePiece p, vec2 way, uint bits, vec4 toBox) {
    Foot foot = footOf(p);
    float rest = 1.0 - foot.s;

    // R sees a and b, relative to it, on both sides of its way to O.
    bool between = (cross2(way, p.a + way) > 0.0) != (cross2(way, p.b + way) > 0.0);
    float chordO = foot.leftOfChord ? 1.0 : 0.0, curveO = foot.leftOfCurve ? 1.0 : 0.0;
    float chordR = float(bits & leftOfChordBit), curveR = float(bits >> 1 & 1u);
    float crossings = (between ? chordO - chordR : 0.0) + (curveO - chordO) - (curveR - chordR);

    // t(s) around the foot: height + slope u + bend u² + third u³. The part in the box, taken as the part of the tangent
    // at the foot that is: u in [range.x, range.y].
    float third = p.slopeA + p.slopeB, bend = 3.0 * third * foot.s - 2.0 * p.slopeA - p.slopeB;
    vec2 normal = vec2(-p.chord.y, p.chord.x);
    vec2 middle = times(toBox, p.a + foot.s * p.chord + foot.height * normal);
    vec2 tangent = times(toBox, p.chord + foot.slope * normal), across = times(toBox, normal);
    vec2 inverse = 1.0 / mix(tangent, vec2(1e-20), vec2(lessThan(abs(tangent), vec2(1e-20))));
    vec2 ends = (vec2(-0.5) - middle) * inverse, others = (vec2(0.5) - middle) * inverse;
    vec2 minimum = min(ends, others), maximum = max(ends, others);
    vec2 range = vec2(max(minimum.x, minimum.y), min(maximum.x, maximum.y));
    float shadow = shadowOf(middle, tangent, across, bend, third, clamp(range, -foot.s, rest),
                            !foot.inside ? 0.0 : foot.leftOfCurve ? 1.0 : -1.0);
    return crossings - (range.x < range.y ? shadow : 0.0);
}

// How O lies, for ways from it.
uint sidesOf(TilePiece p) {
    Foot foot = footOf(p);
    return (foot.leftOfChord ? leftOfChordBit : 0u) | (foot.leftOfCurve ? leftOfCurveBit : 0u);
}
