// Any entry whose paints include programs. Requires: leaf_placement.glsl, fetch.glsl, leaf_integral.glsl.

out vec4 color;

uvec4 leafTexel() {
    uint payload = leafEntry >> 2;
    if ((leafEntry & 3u) == kindSolid)
        return uvec4(0u, 0u, uvec2(payload | payload << 16));
    return texelAt(sections.x + payload);
}

void main() {
    Frame frame = leafFrame();
    Overlap overlap = overlapOf(frame);
    if (overlap.empty)
        discard;
    color = leafOrigin.z * leafIntegral(frame, leafTexel(), picturePoint(overlap), picturePixel(frame));
}
