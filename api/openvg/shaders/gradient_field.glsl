// Gradients: the value at a pixel, and its colour by the ramp (specification section 9.3). Requires:
// layer_prelude.glsl, spaces.glsl, sampler `ramps`: pieces of three texels each, (low, scale), start, change.
// Twin of: api/openvg/draw/gradient_source.cpp, ColorRamp in api/openvg/paint. Exports: gradientColor.

uniform sampler2D ramps;

const int spreadPad = 0x1C00, spreadRepeat = 0x1C01;  // VGColorRampSpreadMode

vec3 fieldPlace(vec2 pixel) { return field[0].xyz * pixel.x + field[1].xyz * pixel.y + field[2].xyz; }

#ifdef SOURCE_LINEAR
float gradientValue(vec2 pixel) {
    vec3 p = fieldPlace(pixel);
    return p.x / p.z;
}
#endif
#ifdef SOURCE_RADIAL
// `field` leads to places seen from the focus; radial: the focus from the centre, r², 1 / (r² - |focus|²).
float gradientValue(vec2 pixel) {
    vec3 p = fieldPlace(pixel);
    vec2 d = p.xy / p.z, f = radial.xy;
    float across = d.x * f.y - d.y * f.x, square = radial.z * dot(d, d) - across * across;
    return (dot(d, f) + sqrt(max(square, 0.0))) * radial.w;
}
#endif

float spreadValue(float v) {
    if (ramp.z == spreadPad)
        return clamp(v, -1.0, 2.0);
    if (ramp.z == spreadRepeat)
        return v - floor(v);
    float twice = v - 2.0 * floor(0.5 * v);
    return twice > 1.0 ? 2.0 - twice : twice;
}

vec4 gradientColor(vec2 pixel) {
    float v = spreadValue(gradientValue(pixel));
    int piece = 0;
    for (int end = ramp.y; end - piece > 1;) {
        int middle = (piece + end) / 2;
        if (v >= texelFetch(ramps, ivec2(3 * middle, ramp.x), 0).x)
            piece = middle;
        else
            end = middle;
    }
    vec2 place = texelFetch(ramps, ivec2(3 * piece, ramp.x), 0).xy;
    vec4 c = texelFetch(ramps, ivec2(3 * piece + 1, ramp.x), 0) +
             (v - place.x) * place.y * texelFetch(ramps, ivec2(3 * piece + 2, ramp.x), 0);
    return ramp.w != 0 ? premultiplied(c) : c;
}
