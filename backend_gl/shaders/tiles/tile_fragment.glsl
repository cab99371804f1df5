// A tile whose regions all have solid colours. Requires: cell.glsl, fetch.glsl, output.glsl.

out vec4 color;

// Some drivers run a loop's body once more to find that it has ended, unless the condition stands at the bottom.
void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    List list = listOf(cell);
    vec4 sum = regionValueIn(65535.0, unpackColor(cell.texel.yz));
    uint met = 0u, all = list.left;
    do {
        if (list.left != 0u) {
            uvec4 bits = nextPiece(list), colors = tileTexel(bits.w >> 2);
            float weight = pieceWeight(tilePiece(bits.xyz, cell.o), cell.way, bits.w, tileToBox);
            sum += weight * (regionValueIn(65535.0, unpackColor(colors.xy)) -
                             regionValueIn(65535.0, unpackColor(colors.zw)));
            ++met;
        }
    } while (list.left != 0u);
    color = outputColor(finishedSum(cell, sum / 65535.0, met == all));
}
