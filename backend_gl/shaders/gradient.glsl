// Gradients of paint programs.
// Requires: fetch.glsl; constants spread*, maxStopsLog2. Twin of: asset/src/gradient.cpp.
// Exports: applyMatrix, gradientColor.

// Columns (a.xy), (a.zw), (b.xy), applied to a picture point.
vec2 applyMatrix(uvec4 a, uvec4 b, vec2 p) {
    vec4 linear = uintBitsToFloat(a);
    return linear.xy * p.x + linear.zw * p.y + uintBitsToFloat(b.xy);
}

float spreadOffset(uint spread, float u) {
    switch (spread) {
        case spreadReflect: return 1.0 - abs(1.0 - (u - 2.0 * floor(u / 2.0)));
        case spreadRepeat: return u - floor(u);
        default: return clamp(u, 0.0, 1.0);
    }
}

// How many stops have an offset <= u; of several at one offset the last counts from there on.
uint stopsUpTo(ASSET_IN uint firstStop, uint count, float u) {
    uint from = 0u, to = count;
    while (from < to) {
        uint middle = (from + to) / 2u;
        if (uintBitsToFloat(texelAt(ASSET firstStop + middle).x) <= u)
            from = middle + 1u;
        else
            to = middle;
    }
    return from;
}

vec4 stopColor(uvec4 stop) { return vec4(low(stop.y), high(stop.y), low(stop.z), high(stop.z)) / 65535.0; }

// Straight colours are interpolated, then premultiplied (SVG 2 section 14.2.4).
vec4 colorAt(ASSET_IN uint firstStop, uint count, float u) {
    uint upTo = stopsUpTo(ASSET firstStop, count, u);
    uvec4 before = texelAt(ASSET firstStop + (upTo == 0u ? 0u : upTo - 1u));
    uvec4 after = texelAt(ASSET firstStop + min(upTo, count - 1u));
    float start = uintBitsToFloat(before.x), gap = uintBitsToFloat(after.x) - start;
    vec4 c = mix(stopColor(before), stopColor(after), gap > 0.0 ? (u - start) / gap : 0.0);
    return vec4(c.rgb * c.a, c.a);
}

// The larger root u of |p - (1-u) f| = (1-u) fr + u with (1-u) fr + u >= 0, and whether there is one.
// With d = p - f: a u² - 2 b u - c = 0; the roots are q / a and -c / q, q = b ± sqrt(b² + a c) with the
// sign that cancels nothing.
bool radialOffset(vec2 p, vec2 f, float fr, out float u) {
    vec2 d = p - f;
    float grow = 1.0 - fr;
    float a = grow * grow - dot(f, f), b = dot(d, f) - fr * grow, c = dot(d, d) - fr * fr;
    float discriminant = b * b + a * c;
    u = 0.0;
    if (discriminant < 0.0)
        return false;
    float q = b + (b < 0.0 ? -1.0 : 1.0) * sqrt(discriminant);
    float one = q == 0.0 ? 0.0 : -c / q, other = a == 0.0 ? one : q / a;
    u = max(one, other);
    if (fr + u * grow >= 0.0)
        return true;
    u = min(one, other);
    return fr + u * grow >= 0.0;
}

vec4 gradientColor(ASSET_IN bool radial, uint gradient, vec2 point) {
    uvec4 a = texelAt(ASSET gradient), b = texelAt(ASSET gradient + 1u);
    vec2 p = applyMatrix(a, b, point);
    float u = p.x;
    if (radial) {
        vec4 focus = uintBitsToFloat(texelAt(ASSET gradient + 2u));
        if (!radialOffset(p, focus.xy, focus.z, u))
            return vec4(0.0);
    }
    return colorAt(ASSET gradient + 3u, b.w, spreadOffset(b.z, u));
}
