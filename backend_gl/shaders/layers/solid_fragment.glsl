// A square of one solid colour. Requires: leaf_placement.glsl.

out vec4 color;

void main() {
    Frame frame = leafFrame();
    Overlap overlap = overlapOf(frame);
    if (overlap.empty)
        discard;
    color = leafColor * (overlap.whole ? 1.0 : leafOrigin.z * quadArea(frame));
}
