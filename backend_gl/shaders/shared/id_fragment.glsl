// The number of the region that a pixel's centre lies in. In its leaf, paint changes on the way along a row from the left
// border to the point; no crossing is solved for (docs/picking.md).
// Requires: fetch.glsl, its sections being leaves, pieces, numbers of paints and nodes; constants kindNode, kindSolid,
// maxLevel, leafExtent, slopeScale. Twin of: raster/src/paint_at.cpp.

// Squares of the deepest level are the unit, 2^24 a side of the map.
uniform vec4 pixelToUnit;  // linear part, by columns
uniform vec4 unitAnchor;   // from baseUnit to the point at the pixel position zw
uniform ivec2 baseUnit;
uniform uint rootEntry;

out uint id;

struct Curve {
    vec2 a, b;
    float slopeA, slopeB;
};

Curve curveOf(uvec4 piece) {
    vec2 slopes = vec2(int(piece.z << 16) >> 16, int(piece.z) >> 16) / slopeScale;
    return Curve(vec2(low(piece.x), high(piece.x)), vec2(low(piece.y), high(piece.y)), slopes.x, slopes.y);
}

// On the left border, above the row.
bool isOnBorderAbove(vec2 end, float row) { return end.x == 0.0 && end.y > row; }

// How often the piece is crossed from its right to its left, less how often from its left to its right: on the way down
// the left border from its upper end, along the row to the point as far as the chord goes, and from the chord to the curve.
// `distance` is the point's from the curve, in steps.
int crossings(Curve c, vec2 point, out float distance) {
    vec2 chord = c.b - c.a, q = point - c.a;
    float length2 = dot(chord, chord), s = dot(q, chord) / length2, t = (chord.x * q.y - chord.y * q.x) / length2;
    float r = 1.0 - s, height = s > 0.0 && s < 1.0 ? s * r * (c.slopeA * r - c.slopeB * s) : 0.0;
    distance = s < 0.0 ? length(q) : s > 1.0 ? length(point - c.b) : abs(t - height) * sqrt(length2);
    bool leftOfChord = t > 0.0, leftOfCurve = t > height;
    bool aIsBelow = c.a.y <= point.y, bIsBelow = c.b.y <= point.y;
    int border = int(isOnBorderAbove(c.b, point.y)) - int(isOnBorderAbove(c.a, point.y));
    int row = aIsBelow != bIsBelow && leftOfChord != aIsBelow ? (aIsBelow ? -1 : 1) : 0;
    return border + row + int(leftOfCurve) - int(leftOfChord);
}

bool isPaintOf(uvec4 leaf, uint paint) {
    bool found = paint == high(leaf.w);
    for (uint i = leaf.x; i < leaf.x + low(leaf.y); ++i) {
        uint sides = texelAt(sections.y + i).w;
        found = found || paint == low(sides) || paint == high(sides);
    }
    return found;
}

// All changes of paint but the last cancel, in any order. Between two pieces that nearly touch, rounding can turn one of the
// crossings alone, and they do not cancel: then the paint is one of the nearest piece's.
uint paintInLeaf(uvec4 leaf, vec2 point) {
    const float belowTop = float(leafExtent) - 1.0 / 256.0;  // the float before leafExtent
    point.y = min(point.y, belowTop);
    uint paint = high(leaf.w), nearest = paint;
    float minimum = 2.0 * float(leafExtent);
    for (uint i = leaf.x; i < leaf.x + low(leaf.y); ++i) {
        uvec4 piece = texelAt(sections.y + i);
        float distance;
        uint left = low(piece.w), right = high(piece.w);
        paint += uint(crossings(curveOf(piece), point, distance)) * (left - right);
        nearest = distance < minimum ? left : nearest;
        minimum = min(minimum, distance);
    }
    return isPaintOf(leaf, paint) ? paint : nearest;
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
