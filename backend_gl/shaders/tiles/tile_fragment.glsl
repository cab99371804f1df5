// A tile whose regions all have solid colours. Requires: cell.glsl, fetch.glsl, output.glsl.

out vec4 color;

void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    uvec4 references = firstReferences(cell);
    vec4 sum = regionValueIn(65535.0, unpackColor(cell.texel.yz));
    uint met = 0u, all = referencesFrom(references);
    for (;;) {
        uint count = referenceCount(references), i = 0u;
        for (; i < count; ++i) {
            uint reference = referenceAt(references, i), first = reference >> 2 << 1;
            TilePiece piece = tilePiece(tileTexel(first).xyz, cell.o);
            float weight = pieceWeight(piece, cell.way, reference, tileToBox);
            uvec4 colors = tileTexel(first + 1u);
            sum += weight * (regionValueIn(65535.0, unpackColor(colors.xy)) -
                             regionValueIn(65535.0, unpackColor(colors.zw)));
        }
        met += i;
        if ((references.x & moreBit) == 0u)
            break;
        references = tileTexel(references.w);
        all = max(all, referencesFrom(references));
    }
    color = outputColor(finishedSum(cell, sum / 65535.0, met == all));
}
