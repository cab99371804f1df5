// A patch with paint programs. Requires: cell.glsl, fetch.glsl, region_color.glsl, output.glsl.

out vec4 color;

// Each piece is looked at twice, once a side, after the reference's own paint, so that the paint interpreter, which
// compilers inline, stands in the program once.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    vec2 point = patchPicture.xy + patchPicture.z * cell.o;
    mat3x2 pixel = mat3x2(patchPicture.z * pixelToPatch.xy, patchPicture.z * pixelToPatch.zw, point);
    bool flatPatch = patchTexels.z != 0u;
    uvec4 references = flatPatch ? uvec4(0u) : firstReferences(cell);
    Recent recent = nothingRecent();
    vec4 sum = vec4(0.0);
    float weight = 1.0;
    uint paint = flatPatch ? patchTexels.z - 1u : low(cell.texel.x), other = 0u, side = 1u, i = 0u;
    for (;;) {
        if (weight != 0.0)
            sum += weight * regionValue(regionColor(recent, paint, point, pixel));
        side ^= 1u;
        if (side == 1u) {
            paint = other;
            weight = -weight;
            continue;
        }
        if (i == referenceCount(references)) {
            if ((references.x & moreBit) == 0u)
                break;
            references = patchTexel(references.w);
            i = 0u;
        }
        uint reference = referenceAt(references, i++);
        uvec4 piece = patchTexel(reference >> 2 << 1);
        weight = pieceWeight(patchPiece(piece.xyz, cell.o), cell.way, reference);
        paint = low(piece.w);
        other = high(piece.w);
    }
    color = outputColor(sum);
}
