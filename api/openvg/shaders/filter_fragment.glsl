// Pixels of an image as a filter has them (specification section 12), into another image, or as sums across on
// their way there. Requires: surface_pixel.glsl, spaces.glsl, tiling.glsl. texels[0].base: from pixels to the
// first texel that is weighted. transform: what is filtered is linear, premultiplied; what comes out is.
// ramp: row of the weights or of the table, columns and rows of weights, channels that are written.
// Twin of: api/openvg/image/filters.cpp, filter_convolutions.cpp, filter_gaussian.cpp.

uniform sampler2D sourceTexels, ramps;

vec4 sourceAt(ivec2 place) {
    TexelBlock b = texels[0];
    int column = inside(place.x, b.area.z, b.how.x), row = inside(place.y, b.area.w, b.how.x);
    if (column < 0 || row < 0)
        return b.fill;
    vec4 c = texelFetch(sourceTexels, b.area.xy + ivec2(column, row), 0);
#ifndef READS_SUMS
    bool isPremultiplied = b.how.z == 0;
    c = exactly(c, b.levels);
    if (isPremultiplied)
        c.rgb = min(c.rgb, c.a);
    c = respaced(c, ivec2(conversion.x, 0), isPremultiplied, ivec2(transform.x, 0), transform.y != 0);
#endif
    return c;
}

vec4 entry(float channel) { return texelFetch(ramps, ivec2(int(channel + 0.5), ramp.x), 0); }

vec4 filtered(ivec2 place) {
#if defined(FILTER_MATRIX)
    vec4 c = sourceAt(place);
    return matrix[0] * c.r + matrix[1] * c.g + matrix[2] * c.b + matrix[3] * c.a + added;
#elif defined(FILTER_TABLES)
    vec4 c = clamp(sourceAt(place), 0.0, 1.0) * 255.0;
    return vec4(entry(c.r).r, entry(c.g).g, entry(c.b).b, entry(c.a).a);
#elif defined(FILTER_TABLE)
    // `scale` is 1 in one channel.
    return entry(dot(clamp(sourceAt(place), 0.0, 1.0) * 255.0, scale));
#else
    vec4 sum = vec4(0.0);
    for (int j = 0; j < ramp.z; ++j)
        for (int i = 0; i < ramp.y; ++i)
            sum += texelFetch(ramps, ivec2(j * ramp.y + i, ramp.x), 0).r * sourceAt(place + ivec2(i, j));
    return sum * scale + bias;
#endif
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    vec4 c = filtered(place + texels[0].base.xy);
#ifdef WRITES_SUMS
    color = c;
#else
    ivec2 from = ivec2(transform.z, 0), to = ivec2(surface.y, surface.x == kindGrey ? 1 : 0);
    bool isPremultiplied = transform.w != 0;
    c = clamp(c, 0.0, 1.0);
    if (isPremultiplied)
        c.rgb = min(c.rgb, c.a);
#ifdef MASKED
    vec4 there = exactly(storedBefore(place), levels);
    bvec4 isWritten = bvec4((ramp.w & 8) != 0, (ramp.w & 4) != 0, (ramp.w & 2) != 0, (ramp.w & 1) != 0);
    c = mix(surface.z != 0 ? unpremultiplied(there) : there, respaced(c, from, isPremultiplied, to, false),
            isWritten);
    c = surface.z != 0 ? premultiplied(c) : c;
#else
    c = respaced(c, from, isPremultiplied, to, surface.z != 0);
#endif
    color = storedColor(c);
#endif
}
