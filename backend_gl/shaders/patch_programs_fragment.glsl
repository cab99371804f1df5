// A patch with paint programs. Requires: cell.glsl, fetch.glsl, paint.glsl, output.glsl.

out vec4 color;

// The last two paints evaluated: the two sides of a chain of pieces.
uint recentPaint = 0xFFFFFFFFu, olderPaint = 0xFFFFFFFFu;
vec4 recentColor = vec4(0.0), olderColor = vec4(0.0);

vec4 regionColor(uint paint, vec2 point) {
    if (paint == recentPaint)
        return recentColor;
    uint swappedPaint = recentPaint;
    vec4 swappedColor = recentColor;
    recentColor = paint == olderPaint ? olderColor : regionValue(paintColor(paint, point));
    recentPaint = paint;
    olderPaint = swappedPaint;
    olderColor = swappedColor;
    return recentColor;
}

// Each piece is looked at twice, once a side, after the reference's own paint, so that the paint interpreter, which
// compilers inline, stands in the program once.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    vec2 point = patchPicture.xy + patchPicture.z * cell.o;
    bool flatPatch = patchTexels.z != 0u;
    uvec4 references = flatPatch ? uvec4(0u) : firstReferences(cell);
    vec4 sum = vec4(0.0);
    float weight = 1.0;
    uint paint = flatPatch ? patchTexels.z - 1u : low(cell.texel.x), other = 0u, side = 1u, i = 0u;
    for (;;) {
        if (weight != 0.0)
            sum += weight * regionColor(paint, point);
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
