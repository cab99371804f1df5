// A leaf of a mask, whose paint indices are 0 outside and 1 inside. Requires: leaf_placement.glsl, fetch.glsl.

out vec4 color;

void main() {
    Frame frame = leafFrame();
    if (overlapOf(frame).empty)
        discard;
    uvec4 leaf = texelAt(sections.x + (leafEntry >> 2));
    vec2 a = cornerOf(frame, 0), b = cornerOf(frame, 1), c = cornerOf(frame, 2), d = cornerOf(frame, 3);
    float sum = seg(a, b) * float(low(leaf.z)) + seg(b, c) * float(high(leaf.z)) + seg(c, d) * float(low(leaf.w)) +
                seg(d, a) * float(high(leaf.w));
    uint end = leaf.x + low(leaf.y);
    for (uint i = leaf.x; i < end; ++i) {
        uvec4 piece = texelAt(sections.y + i);
        sum += pieceSum(frame, piece) * (float(low(piece.w)) - float(high(piece.w)));
    }
    color = vec4(leafOrigin.z * sum);
}
