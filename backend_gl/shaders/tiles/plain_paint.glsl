// Plain paints: layers of ramps that are tables (backend_gl/tiles/plain_paints.hpp).
// Requires: place.glsl, blend.glsl; constants plainTexelBits, plainTag, radialBit; RADIAL, RAMP_POINTS defined as 1 or 0.
// Exports: plainColor.

#if RAMP_POINTS
uniform uint rampPoints;  // whose mean is that over a pixel
#endif

uint plainTexel(uint word) { return word & ((1u << plainTexelBits) - 1u); }

// A ramp over a pixel: t in its middle, and 12 times the variance.
struct RampPixel {
    float t, squaredWidth;
};

// The layer's second texel, if it has one, is the next. The mean over a cone's tip is not 0: as in gradient.glsl, for round
// ones.
RampPixel rampPixel(uvec4 layer, vec2 point, inout uint next) {
    vec4 row = uintBitsToFloat(layer);
    float t = dot(row.xy, point) + row.z;
    vec2 slope = row.xy;
#if RADIAL
    vec4 other = uintBitsToFloat(tileTexel(next));
    float across = dot(other.xy, point) + other.z, squared = t * t + across * across;
    float area = abs(pixelToTile.x * pixelToTile.w - pixelToTile.y * pixelToTile.z);
    float spread = max(abs(row.x * other.y - row.y * other.x) * area / 12.0, 1e-30);
    float near = 1.0 / (1.0 + 0.275 * squared / spread);
    float cone = sqrt(squared + spread * (1.0 + 0.756 * near * near));
    if ((layer.w & radialBit) != 0u) {
        slope = (t * row.xy + across * other.xy) / cone + other.w * row.xy;
        t = cone + other.w * t;
        ++next;
    }
#endif
    vec2 sides = vec2(dot(slope, pixelToTile.xy), dot(slope, pixelToTile.zw));
    return RampPixel(t, dot(sides, sides));
}

// Times 65535.
vec4 rampColor(uvec4 layer, float t) {
    float segment = floor(t);
    uvec4 ends = tileTexel(plainTexel(layer.w + uint(int(segment))));
    return mix(unpackColor(ends.xy), unpackColor(ends.zw), t - segment);
}

// The next layer's premultiplied colour, the mean over a pixel. n points that are evenly apart by d have a variance of
// d² (n² - 1) / 12.
vec4 layerColor(inout uint next, vec2 point) {
    uvec4 layer = tileTexel(next++);
    RampPixel ramp = rampPixel(layer, point, next);
#if RAMP_POINTS
    float count = float(rampPoints), apart = sqrt(ramp.squaredWidth / (count * count - 1.0));
    float t = ramp.t - 0.5 * (count - 1.0) * apart;
    vec4 sum = vec4(0.0);
    uint left = rampPoints;
    do {
        sum += rampColor(layer, t);
        t += apart;
    } while (--left != 0u);
    return sum / (65535.0 * count);
#else
    return rampColor(layer, ramp.t) / 65535.0;
#endif
}

// Of a paint's first word, at a point in tile sides. Some drivers run a loop's body once more to find that it has ended,
// unless the condition stands at the bottom.
vec4 plainColor(uint paint, vec2 point) {
    uint next = plainTexel(paint), left = paint >> plainTexelBits;
    vec4 color = vec4(0.0);
    do
        color = over(layerColor(next, point), color);
    while (--left != 0u);
    return color;
}
