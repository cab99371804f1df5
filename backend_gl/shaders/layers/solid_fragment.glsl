// A square of a mask that is all inside. Requires: leaf_placement.glsl.

out vec4 color;

void main() {
    Frame frame = leafFrame();
    Overlap overlap = overlapOf(frame);
    if (overlap.empty)
        discard;
    color = vec4(overlap.whole ? 1.0 : leafOrigin.z * quadArea(frame));
}
