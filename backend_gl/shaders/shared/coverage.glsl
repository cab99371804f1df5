// Areas by Green's theorem in the pixel's own coordinates, its box being [0, 1]² (docs/coverage.md).
// Requires: low, high; constants leafExtent, slopeScale, chordCount, smallestSpan.
// Twin of: raster/src/coverage.cpp.
// Exports: Frame, toPixel, cornerOf, seg, quadArea, cross2, curveSum, sideOf, alongSide, pieceSum.

// Leaf coordinates to the pixel's: p -> linear · p + origin.
struct Frame {
    mat2 linear;
    vec2 origin;
};

vec2 toPixel(Frame frame, vec2 p) { return frame.linear * p + frame.origin; }

// The mean of clamp(x, 0, 1) for x evenly between a and b. Split at x = 1 instead of subtracting antiderivatives, whose
// leading digits cancel for large |x|.
float meanOfClamp(float a, float b) {
    float from = clamp(a, 0.0, 1.0), to = clamp(b, 0.0, 1.0), span = b - a;
    float ramp = (to - from) * (to + from) * 0.5, above = max(b, 1.0) - max(a, 1.0);
    return mix((ramp + above) / span, from, abs(span) < smallestSpan);
}

// ∫ clamp(x, 0, 1) dy along P -> Q inside 0 <= y <= 1.
float seg(vec2 p, vec2 q) {
    vec2 d = q - p;
    float y0 = clamp(p.y, 0.0, 1.0), y1 = clamp(q.y, 0.0, 1.0), slope = d.x / d.y;
    float x0 = p.x + slope * (y0 - p.y), x1 = q.x + slope * (y1 - q.y);
    return mix((y1 - y0) * meanOfClamp(x0, x1), 0.0, abs(d.y) < smallestSpan);
}

vec2 cornerOf(Frame frame, int k) {
    bvec2 far = bvec2(k == 1 || k == 2, k == 2 || k == 3);
    return toPixel(frame, mix(vec2(0.0), vec2(leafExtent), far));
}

// Signed area of the leaf's part of the box.
float quadArea(Frame frame) {
    vec2 a = cornerOf(frame, 0), b = cornerOf(frame, 1), c = cornerOf(frame, 2), d = cornerOf(frame, 3);
    return seg(a, b) + seg(b, c) + seg(c, d) + seg(d, a);
}

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

struct Curve {
    vec2 a, b, chord, normal;
    float slopeA, slopeB;
};

float signedLow(uint word) { return float(int(word << 16) >> 16); }
float signedHigh(uint word) { return float(int(word) >> 16); }

Curve curveOf(Frame frame, uvec4 piece) {
    vec2 a = vec2(low(piece.x), high(piece.x)), b = vec2(low(piece.y), high(piece.y)), d = b - a;
    return Curve(toPixel(frame, a), toPixel(frame, b), frame.linear * d, frame.linear * vec2(-d.y, d.x),
                 signedLow(piece.z) / slopeScale, signedHigh(piece.z) / slopeScale);
}

// The s for which the curve can lie in the box, as (from, to); empty unless from < to.
vec2 rangeInBox(Curve c) {
    float area = cross2(c.chord, c.normal);
    float bulge = 4.0 / 27.0 * (abs(c.slopeA) + abs(c.slopeB));
    vec2 toCentre = vec2(0.5) - c.a;
    float halfS = 0.5 * (abs(c.normal.x) + abs(c.normal.y)) / abs(area);
    float halfT = 0.5 * (abs(c.chord.x) + abs(c.chord.y)) / abs(area);
    bool misses = area == 0.0 || bulge == 0.0 || abs(cross2(c.chord, toCentre) / area) > bulge + halfT;
    float s = cross2(toCentre, c.normal) / area;
    return mix(clamp(vec2(s - halfS, s + halfS), 0.0, 1.0), vec2(0.0), bvec2(misses));
}

// Side of the leaf on which an end point lies, decided on the stored integers; -1: inside.
int sideOf(uint point) {
    uvec2 p = uvec2(low(point), high(point));
    int side = p.x == 0u && p.y > 0u ? 3 : -1;
    side = p.y == leafExtent && p.x > 0u ? 2 : side;
    side = p.x == leafExtent && p.y < leafExtent ? 1 : side;
    return p.y == 0u && p.x < leafExtent ? 0 : side;
}

// Along a piece from A to B. Outside the box one chord stands for the curve. Points between are off the curve by
// -h² t''(s) / 12, the mean of what a chord of the step h between its points misses. What does not change in the loop
// stands before it: not every driver takes it out.
float curveSum(Frame frame, uvec4 piece) {
    Curve c = curveOf(frame, piece);
    vec2 range = rangeInBox(c);
    int end = range.x < range.y ? chordCount + 1 : 0;  // points between A and B
    float h = (range.y - range.x) * (1.0 / float(chordCount)), h2 = h * h * (1.0 / 6.0);
    vec2 lift = h2 * vec2(2.0 * c.slopeA + c.slopeB, -3.0 * (c.slopeA + c.slopeB)), last = c.a;
    float sum = 0.0;
    for (int i = 0; i <= end; ++i) {
        float s = range.x + float(i) * h, r = 1.0 - s;
        float t = s * r * (c.slopeA * r - c.slopeB * s) + lift.x + s * lift.y;
        vec2 next = mix(c.a + s * c.chord + t * c.normal, c.b, bvec2(i == end));
        sum += seg(last, next);
        last = next;
        if (i == end)
            break;  // or some drivers run the body once more
    }
    return sum;
}

// From a point to the end of the leaf's side on which it lies; 0 inside.
float alongSide(Frame frame, uint point) {
    int side = sideOf(point);
    float area = 0.0;
    if (side >= 0)
        area = seg(toPixel(frame, vec2(low(point), high(point))), cornerOf(frame, (side + 1) & 3));
    return area;
}

// What a piece adds to the loop of the region on its left, which is closed along the leaf's sides.
float pieceSum(Frame frame, uvec4 piece) {
    return curveSum(frame, piece) + alongSide(frame, piece.y) - alongSide(frame, piece.x);
}
