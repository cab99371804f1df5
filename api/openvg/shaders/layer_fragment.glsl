// A drawing call's pixel: source, transform, blending, mixed by coverage (specification section 2.8).
// Requires: all parts before it; macros SOURCE_…, BLEND (a function of blend_modes.glsl), TRANSFORMS,
// MULTIPLIES, STENCIL, MASKED. Twin of: api/openvg/draw/row_compositor.cpp.

uniform sampler2D sourceTexels, otherTexels;
#ifdef MASKED
uniform sampler2D mask;
#endif

// Premultiplied, as the call's source gives it.
vec4 sourceColor(vec2 pixel) {
#if defined(SOURCE_SOLID)
    vec4 c = tileColor;
#elif defined(SOURCE_TEXELS)
    vec4 c = texelColor(sourceTexels, texels[0], pixel);
#else
    vec4 c = gradientColor(pixel);
#endif
#ifdef TRANSFORMS
    c = converted(unpremultiplied(c), transform.yz, ivec2(transform.x, 0));
    c = matrix[0] * c.r + matrix[1] * c.g + matrix[2] * c.b + matrix[3] * c.a + added;
    c = premultiplied(clamp(c, 0.0, 1.0));
#endif
#ifdef MULTIPLIES
    c *= texelColor(otherTexels, texels[1], pixel);
#endif
    return c;
}

// In the surface's space, after the colour transform.
vec4 prepared(vec4 c) {
#if defined(SOURCE_SOLID) && !defined(MULTIPLIES)
    return c;
#else
    ivec2 from = conversion.xy, to = ivec2(surface.y, surface.x == kindGrey ? 1 : 0);
    bool transforms = conversion.z != 0;
    if (from == to && !transforms)
        return c;
    c = unpremultiplied(c);
    if (transforms) {
        c = clamp(c * scale + bias, 0.0, 1.0);
        from.y = 0;
    }
    return premultiplied(surface.x == kindAlpha ? c : converted(c, from, to));
#endif
}

vec4 blended(vec4 s, vec4 d, vec2 pixel) {
#ifdef STENCIL
    vec4 through = texelColor(otherTexels, texels[1], pixel);
    if (surface.x == kindGrey)
        through.rgb = vec3(dot(through.rgb, vec3(0.2126, 0.7152, 0.0722)));
    vec4 alphas = through * s.a;
    vec3 c = unpremultiplied(s).rgb * alphas.rgb;
    return vec4(BLEND(vec4(vec3(c.r), alphas.r), vec4(vec3(d.r), d.a)).r,
                BLEND(vec4(vec3(c.g), alphas.g), vec4(vec3(d.g), d.a)).r,
                BLEND(vec4(vec3(c.b), alphas.b), vec4(vec3(d.b), d.a)).r, BLEND(alphas, d).a);
#else
    return BLEND(s, d);
#endif
}

vec4 mixed(vec4 before, vec4 after, float share) {
    if (conversion.w == 0)
        return mix(before, after, share);
    vec4 a = premultiplied(decoded(unpremultiplied(before))), b = premultiplied(decoded(unpremultiplied(after)));
    return premultiplied(encoded(unpremultiplied(mix(a, b, share))));
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    float share = shareOf(place);
#ifdef MASKED
    share *= texelFetch(mask, place, 0).r;
#endif
    if (share <= 0.0)
        discard;
    vec2 pixel = vec2(place - frame.zw);
    vec4 before = beforeOf(storedBefore(place));
    vec4 after = blended(prepared(sourceColor(pixel)), before, pixel);
    if (share < 1.0)
        after = mixed(before, after, share);
    color = stored(after);
}
