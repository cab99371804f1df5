// A tile's colour as it is: what is stored. Requires: surface_pixel.glsl.

void main() {
    if (shareOf(ivec2(gl_FragCoord.xy)) <= 0.0)
        discard;
    color = tileColor;
}
