// The number of the region that a pixel's centre lies in, by the curves themselves: on the way from the point to a corner
// of its leaf the nearest piece tells.
// Requires: fetch.glsl, its sections being leaves, pieces, numbers of paints and nodes; constants kindNode, kindSolid,
// maxLevel, leafExtent, slopeScale. Twin of: raster/src/paint_at.cpp.

// Squares of the deepest level are the unit, 2^24 a side of the map.
uniform vec4 pixelToUnit;  // linear part, by columns
uniform vec4 unitAnchor;   // from baseUnit to the point at the pixel position zw
uniform ivec2 baseUnit;
uniform uint rootEntry;

out uint id;

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

struct Curve {
    vec2 a, b, chord;
    float slopeA, slopeB;
};

Curve curveOf(uvec4 piece) {
    vec2 a = vec2(low(piece.x), high(piece.x)), b = vec2(low(piece.y), high(piece.y));
    vec2 slopes = vec2(int(piece.z << 16) >> 16, int(piece.z) >> 16) / slopeScale;
    return Curve(a, b, b - a, slopes.x, slopes.y);
}

vec2 curveAt(Curve c, float s) {
    float r = 1.0 - s;
    vec2 p = c.a + s * c.chord + s * r * (c.slopeA * r - c.slopeB * s) * vec2(-c.chord.y, c.chord.x);
    return s == 1.0 ? c.b : p;
}

vec2 derivativeAt(Curve c, float s) {
    float r = 1.0 - s, t = c.slopeA * r * (1.0 - 3.0 * s) - c.slopeB * s * (2.0 - 3.0 * s);
    return c.chord + t * vec2(-c.chord.y, c.chord.x);
}

bool isLeft(vec2 from, vec2 along, vec2 p) { return cross2(along, p - from) >= 0.0; }

// Ends of the three parts of the curve on which its distance from the way is monotone.
vec4 monotoneParts(Curve c, vec2 along) {
    float n = cross2(along, vec2(-c.chord.y, c.chord.x));
    float constant = cross2(along, c.chord) + n * c.slopeA;
    float halfB = -n * (2.0 * c.slopeA + c.slopeB), a = 3.0 * n * (c.slopeA + c.slopeB);
    float discriminant = halfB * halfB - a * constant;
    if (discriminant <= 0.0)
        return vec4(0.0, 0.0, 1.0, 1.0);
    float q = -(halfB + (halfB < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
    float one = a == 0.0 ? 0.0 : clamp(q / a, 0.0, 1.0), other = q == 0.0 ? 1.0 : clamp(constant / q, 0.0, 1.0);
    return vec4(0.0, min(one, other), max(one, other), 1.0);
}

// Where the way is crossed between s0 and s1, whose sides differ.
float crossing(Curve c, vec2 from, vec2 along, float s0, float s1) {
    bool first = isLeft(from, along, curveAt(c, s0));
    for (int i = 0; i < 24; ++i) {
        float middle = 0.5 * (s0 + s1);
        if (isLeft(from, along, curveAt(c, middle)) == first)
            s0 = middle;
        else
            s1 = middle;
    }
    return 0.5 * (s0 + s1);
}

// The paint at the beginning of a way that ends in `corner` paint, and how far that is from what rounding could turn.
uint paintOnWay(uvec4 leaf, vec2 from, vec2 along, uint corner, out float sureness) {
    uint paint = corner;
    float nearest = 1.0;
    sureness = 1.0;
    for (uint i = leaf.x; i < leaf.x + low(leaf.y); ++i) {
        uvec4 piece = texelAt(sections.y + i);
        Curve c = curveOf(piece);
        vec4 parts = monotoneParts(c, along);
        for (int k = 0; k < 3; ++k) {
            float s0 = k == 0 ? parts.x : k == 1 ? parts.y : parts.z, s1 = k == 0 ? parts.y : k == 1 ? parts.z : parts.w;
            if (isLeft(from, along, curveAt(c, s0)) == isLeft(from, along, curveAt(c, s1)))
                continue;
            float s = crossing(c, from, along, s0, s1);
            float place = dot(curveAt(c, s) - from, along) / dot(along, along);
            if (place < 0.0 || place >= nearest)
                continue;
            nearest = place;
            float sine = cross2(normalize(derivativeAt(c, s)), -normalize(along));
            paint = sine > 0.0 ? low(piece.w) : high(piece.w);
            sureness = min(abs(sine), 4.0 * min(s, 1.0 - s));
        }
    }
    return paint;
}

uint paintInLeaf(uvec4 leaf, vec2 point) {
    const float sure = 0.05;
    uint best = 0u;
    float bestSureness = -1.0;
    for (int k = 0; k < 4 && bestSureness < sure; ++k) {
        vec2 corner = mix(vec2(0.0), vec2(leafExtent), bvec2(k == 1 || k == 2, k == 2 || k == 3));
        uint word = k < 2 ? leaf.z : leaf.w, paint = (k & 1) == 0 ? low(word) : high(word);
        float sureness = 1.0;
        if (corner != point)
            paint = paintOnWay(leaf, point, corner - point, paint, sureness);
        if (sureness > bestSureness) {
            best = paint;
            bestSureness = sureness;
        }
    }
    return best;
}

uint paintAtUnit(uvec2 unit, vec2 rest) {
    uint entry = rootEntry, shift = 2u * maxLevel;
    while ((entry & 3u) == kindNode && shift >= 2u) {
        shift -= 2u;
        uvec2 child = unit >> shift & 3u;
        uvec4 row = texelAt(sections.w + 4u * (entry >> 2) + child.y);
        entry = child.x < 2u ? (child.x == 0u ? row.x : row.y) : (child.x == 2u ? row.z : row.w);
    }
    if ((entry & 3u) == kindSolid)
        return entry >> 2;
    vec2 point = (vec2(unit & (1u << shift) - 1u) + rest) * (float(leafExtent) / float(1u << shift));
    return paintInLeaf(texelAt(sections.x + (entry >> 2)), point);
}

void main() {
    const float maximum = 33554432.0;  // beyond it nothing of the map lies; keeps the conversion to int defined
    vec2 d = gl_FragCoord.xy - unitAnchor.zw;
    vec2 offset = clamp(unitAnchor.xy + pixelToUnit.xy * d.x + pixelToUnit.zw * d.y, -maximum, maximum), whole = floor(offset);
    ivec2 unit = baseUnit + ivec2(whole), end = ivec2(1 << int(2u * maxLevel));
    bool inside = all(greaterThanEqual(unit, ivec2(0))) && all(lessThan(unit, end));
    id = texelAt(sections.z + (inside ? paintAtUnit(uvec2(unit), offset - whole) : 0u)).x;
}
