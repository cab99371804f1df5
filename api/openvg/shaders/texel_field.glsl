// An image's colours at pixels: nearest, interpolated, or the mean of interpolated samples over the pixel's
// footprint; tiled outside. Requires: layer_prelude.glsl, spaces.glsl, tiling.glsl.
// Twin of: api/openvg/draw/texel_source.cpp. Exports: texelColor.

const int maxSamples = 16;

vec4 texel(sampler2D image, TexelBlock b, ivec2 place) {
    int column = inside(place.x, b.area.z, b.how.x), row = inside(place.y, b.area.w, b.how.x);
    if (column < 0 || row < 0)
        return b.fill;
    vec4 c = exactly(texelFetch(image, b.area.xy + ivec2(column, row), 0), b.levels);
    return b.how.z != 0 ? premultiplied(c) : c;
}

// Far places are all one: there is nothing between texels there.
ivec2 whole(vec2 v) { return ivec2(clamp(floor(v), -1e9, 1e9)); }

vec4 bilinear(sampler2D image, TexelBlock b, vec2 place) {
    vec2 q = place - 0.5, t = q - floor(q);
    ivec2 i = whole(q) + b.base.xy;
    vec4 a = texel(image, b, i);
    if (t == vec2(0.0))
        return a;
    return mix(mix(a, texel(image, b, i + ivec2(1, 0)), t.x),
               mix(texel(image, b, i + ivec2(0, 1)), texel(image, b, i + ivec2(1, 1)), t.x), t.y);
}

vec2 mappedPlace(TexelBlock b, vec2 pixel) {
    vec3 p = b.map[0].xyz * pixel.x + b.map[1].xyz * pixel.y + b.map[2].xyz;
    return b.how.w != 0 ? p.xy / p.z : p.xy;
}

int samplesAlong(vec2 side) {
    float size = length(side);
    return size > 1.001 ? int(min(ceil(size), float(maxSamples))) : 1;
}

// Premultiplied, in the image's space. `pixel` is counted from the origin.
vec4 texelColor(sampler2D image, TexelBlock b, vec2 pixel) {
    vec2 place = mappedPlace(b, pixel);
    if (b.how.y == 0)
        return texel(image, b, whole(place) + b.base.xy);
    ivec2 samples = b.base.zw;
    if (b.how.w != 0) {
        vec2 across = vec2(0.5, 0.0), along = vec2(0.0, 0.5);
        samples = ivec2(samplesAlong(mappedPlace(b, pixel + across) - mappedPlace(b, pixel - across)),
                        samplesAlong(mappedPlace(b, pixel + along) - mappedPlace(b, pixel - along)));
    }
    if (samples == ivec2(1))
        return bilinear(image, b, place);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < samples.y; ++j)
        for (int i = 0; i < samples.x; ++i)
            sum += bilinear(image, b, mappedPlace(b, pixel + (vec2(i, j) + 0.5) / vec2(samples) - 0.5));
    return sum / float(samples.x * samples.y);
}
