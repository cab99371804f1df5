// Blocks of one plain paint. Requires: place.glsl, plain_paint.glsl, output.glsl.

flat in uvec4 blockMore;  // for each tile the paint's first word

out vec4 color;

void main() {
    enterTile(gl_FragCoord.xy);
    color = outputColor(regionValue(plainColor(chosen(blockMore), tilePoint(gl_FragCoord.xy))));
}
