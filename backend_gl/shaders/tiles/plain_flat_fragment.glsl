// Blocks of one plain paint. Requires: place.glsl, plain_paint.glsl, output.glsl.

out vec4 color;

void main() {
    enterTile(gl_FragCoord.xy);
    color = outputColor(regionValue(plainColor(tile.cells, tilePoint(gl_FragCoord.xy))));
}
