// Pixels of another format, one to one: converted (specification section 3.4.4), neither blended nor mixed.
// Requires: surface_pixel.glsl, spaces.glsl. texels[0].base: from pixels to texels.

uniform sampler2D sourceTexels;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    if (shareOf(place) <= 0.0)
        discard;
    vec4 c = exactly(texelFetch(sourceTexels, place + texels[0].base.xy, 0), texels[0].levels);
    ivec2 from = conversion.xy, to = ivec2(surface.y, surface.x == kindGrey ? 1 : 0);
    bool isPremultiplied = texels[0].how.z == 0;
    if (isPremultiplied)
        c.rgb = min(c.rgb, c.a);
    c = respaced(c, from, isPremultiplied, to, surface.z != 0);
    color = storedColor(c);
}
