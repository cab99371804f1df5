// Tiles of one plain paint. Requires: place.glsl, plain_paint.glsl, output.glsl.

out vec4 color;

void main() {
    color = outputColor(regionValue(plainColor(tileTexels.y, tilePoint(gl_FragCoord.xy))));
}
