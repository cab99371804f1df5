// A leaf whose regions all have solid colours. Requires: leaf_placement.glsl, fetch.glsl.

uniform bool paintsAreCoverage;

out vec4 color;

vec4 regionColor(uint paint) { return paintsAreCoverage ? vec4(float(paint)) : solidColor(paint); }

void main() {
    Frame frame = leafFrame();
    if (overlapOf(frame).empty)
        discard;
    uvec4 leaf = texelAt(sections.x + (leafEntry >> 2));
    vec2 a = cornerOf(frame, 0), b = cornerOf(frame, 1), c = cornerOf(frame, 2), d = cornerOf(frame, 3);
    vec4 sum = seg(a, b) * regionColor(low(leaf.z)) + seg(b, c) * regionColor(high(leaf.z)) +
               seg(c, d) * regionColor(low(leaf.w)) + seg(d, a) * regionColor(high(leaf.w));
    uint end = leaf.x + low(leaf.y);
    for (uint i = leaf.x; i < end; ++i) {
        uvec4 piece = texelAt(sections.y + i);
        float weight = pieceSum(frame, piece);
        if (weight != 0.0)
            sum += weight * (regionColor(low(piece.w)) - regionColor(high(piece.w)));
    }
    color = leafOrigin.z * sum;
}
