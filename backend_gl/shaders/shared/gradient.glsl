// Gradients of paint programs.
// Requires: fetch.glsl; constants spread*, longRamp; LONG_RAMPS defined as 1 where a gradient has more stops than longRamp, else 0.
// Twin of: raster/src/gradient.cpp.
// Exports: applyMatrix, gradientColor.

// Columns (a.xy), (a.zw), (b.xy), applied to a picture point.
vec2 applyMatrix(uvec4 a, uvec4 b, vec2 p) {
    vec4 linear = uintBitsToFloat(a);
    return linear.xy * p.x + linear.zw * p.y + uintBitsToFloat(b.xy);
}

float spreadOffset(uint spread, float u) {
    float reflected = 1.0 - abs(1.0 - (u - 2.0 * floor(u / 2.0)));
    return mix(mix(clamp(u, 0.0, 1.0), u - floor(u), spread == spreadRepeat), reflected, spread == spreadReflect);
}

// How many stops have an offset <= u; of several at one offset the last counts from there on.
uint stopsUpTo(ASSET_IN uint firstStop, uint count, float u) {
    uint from = 0u, to = count;
    while (from < to) {
        uint middle = (from + to) / 2u;
        bool counts = uintBitsToFloat(texelAt(ASSET firstStop + middle).x) <= u;
        from = counts ? middle + 1u : from;
        to = counts ? to : middle;
        if (from >= to)
            break;
    }
    return from;
}

vec4 stopColor(uvec4 stop) { return vec4(low(stop.y), high(stop.y), low(stop.z), high(stop.z)) / 65535.0; }

vec4 premultiplied(vec4 c) { return vec4(c.rgb * c.a, c.a); }

// Straight colours are interpolated, then premultiplied (SVG 2 section 14.2.4).
vec4 colorBetween(uvec4 before, uvec4 after, float u) {
    float start = uintBitsToFloat(before.x), gap = uintBitsToFloat(after.x) - start;
    return premultiplied(mix(stopColor(before), stopColor(after), mix(0.0, (u - start) / gap, gap > 0.0)));
}

// ---- Means over pixels

#if LONG_RAMPS
#ifdef ONE_ASSET
// First texel of the integrals from stop to stop (backend_gl/upload/asset_texels.hpp).
uniform uint rampSums;
#endif

vec4 integralBetween(ASSET_IN uint from, uint to) {
    uint sums = ASSET_PART(rampSums) - SECTIONS.w;
    return vec4(texelAt(ASSET sums + to) - texelAt(ASSET sums + from)) * exp2(-31.0);
}
#endif

// How much of a pixel has u at a distance d from that in its middle, u being the sum of two that are even over their
// boxes: |d| is at most `reach`, and up to `even` all are alike.
float pixelWeight(float d, float reach, float even) {
    float rest = reach - abs(d), slope = reach - even;
    return mix(1.0, rest / slope, rest < slope);
}

// A part of one period of the ramp, along it: the pixel's middle, and distances d from there, `from` to `last`.
struct Period {
    float middle, from, last;
};

// Of the n-th period, from n to n + 1, what a pixel with u in its middle has of it. A padded ramp is one.
Period periodAt(uint spread, float n, float u, float reach) {
    if (spread != spreadReflect && spread != spreadRepeat)
        return Period(u, -reach, reach);
    float a = max(-reach, n - u), b = min(reach, n + 1.0 - u);
    if (spread == spreadReflect && mod(n, 2.0) != 0.0)
        return Period(n + 1.0 - u, -b, -a);
    return Period(u - n, a, b);
}

// Adds what the ramp differs from a colour, times weights, and the weights, up to the next stop or bend of the weight, and
// moves the part's beginning there: colours that are all alike stay what they are, where blend modes may jump. It is a
// quadratic times a straight line, which Simpson's rule integrates exactly; at the same time that serves what lies before
// the first stop and behind the last. `next` is the stop that comes next.
void addStretch(ASSET_IN uint firstStop, uint count, float reach, float even, vec4 base, inout Period part, inout uint next,
                inout vec4 sum, inout float weights) {
    float middle = part.middle, from = part.from;
    uvec4 before = texelAt(ASSET firstStop + max(next, 1u) - 1u);
    uvec4 after = texelAt(ASSET firstStop + min(next, count - 1u));
    float end = mix(min(part.last, uintBitsToFloat(after.x) - middle), part.last, next == count);
    float bend = mix(mix(part.last, even, from < even), -even, from < -even), to = min(end, bend);
    if (from < to) {
        float at = 0.5 * (from + to), sixth = (to - from) / 6.0;
        vec3 shares = sixth * vec3(pixelWeight(from, reach, even), 4.0 * pixelWeight(at, reach, even),
                                   pixelWeight(to, reach, even));
        sum += shares.x * (colorBetween(before, after, middle + from) - base) +
               shares.y * (colorBetween(before, after, middle + at) - base) +
               shares.z * (colorBetween(before, after, middle + to) - base);
        weights += shares.x + shares.y + shares.z;
        part.from = to;
    }
    next += to == end ? 1u : 0u;
}

#if LONG_RAMPS
// On to the last stop, instead of from stop to stop: all weights are 1 there.
void skipStops(ASSET_IN uint firstStop, uint count, vec4 base, inout Period part, inout uint next, inout vec4 sum,
               inout float weights) {
    uint upTo = stopsUpTo(ASSET firstStop, part.from < part.last && count > longRamp ? count : 0u, part.middle + part.last);
    if (upTo > next) {
        float end = uintBitsToFloat(texelAt(ASSET firstStop + upTo - 1u).x) - part.middle;
        sum += integralBetween(ASSET firstStop + next - 1u, firstStop + upTo - 1u) - (end - part.from) * base;
        weights += end - part.from;
        part.from = end;
        next = upTo;
    }
}
#endif

// The mean over a pixel whose sides change u by `longer` > 0 and `shorter`, and in whose middle `base` is. A reflected ramp
// repeats after two, so no mean is over more; a padded one is all but two colours beyond 1024. One loop over the stretches
// of all periods, since compilers inline what is in it.
vec4 rampMean(ASSET_IN uint firstStop, uint count, uint spread, float u, float longer, float shorter,
              vec4 base) {
    bool periodic = spread == spreadReflect || spread == spreadRepeat;
    float widest = periodic ? 2.0 : 1024.0;
    longer = min(longer, widest);
    shorter = min(shorter, widest);
    float reach = 0.5 * (longer + shorter), even = 0.5 * (longer - shorter), weights = 0.0;
    u -= mix(0.0, 2.0 * floor(0.5 * u), periodic);
    vec4 sum = vec4(0.0);
    float n = mix(0.0, floor(u - reach), periodic), end = mix(1.0, u + reach, periodic);
    Period part = Period(0.0, 0.0, 0.0);
    uint next = 0u;
    while (n < end || part.from < part.last) {
        if (!(part.from < part.last)) {
            part = periodAt(spread, n++, u, reach);
            next = stopsUpTo(ASSET firstStop, count, part.middle + part.from);
        }
        addStretch(ASSET firstStop, count, reach, even, base, part, next, sum, weights);
#if LONG_RAMPS
        skipStops(ASSET firstStop, count, base, part, next, sum, weights);
#endif
        if (n >= end && part.from >= part.last)
            break;
    }
    return mix(base, base + sum / weights, bvec4(weights > 0.0));
}

// The same; of long ramps the shorter side's box is replaced by two points with the same variance.
vec4 meanOver(ASSET_IN uint firstStop, uint count, uint spread, float u, float longer, float shorter, vec4 base) {
#if LONG_RAMPS
    bool isLong = count > longRamp;
    float apart = mix(0.0, 0.28867513 * shorter, isLong);  // 1 / sqrt(12)
    int points = isLong ? 2 : 1;
    shorter = mix(shorter, 0.0, isLong);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < points; ++i) {
        sum += rampMean(ASSET firstStop, count, spread, u + float(2 * i - 1) * apart, longer, shorter, base);
        if (i + 1 == points)
            break;
    }
    return sum / float(points);
#else
    return rampMean(ASSET firstStop, count, spread, u, longer, shorter, base);
#endif
}

// A stretch is as good as straight in a pixel if interpolating straight colours moves the mean over it by no more: its
// bend times the variance, which is a twelfth of the width's square at most.
const float maxBending = 1.0 / 3000.0;

// The mean over a pixel whose sides change u by `sides`. Where the pixel has nothing but a little of one stretch between two
// stops, it is the colour in the middle.
vec4 colorOver(ASSET_IN uint firstStop, uint count, uint spread, float u, vec2 sides) {
    sides = min(abs(sides), vec2(1024.0));
    float longer = max(sides.x, sides.y), shorter = min(sides.x, sides.y), width = longer + shorter;
    bool padded = spread != spreadReflect && spread != spreadRepeat;
    float v = spreadOffset(spread, u), unclamped = padded ? u : v;
    uint upTo = stopsUpTo(ASSET firstStop, count, unclamped);
    uvec4 before = texelAt(ASSET firstStop + max(upTo, 1u) - 1u);
    uvec4 after = texelAt(ASSET firstStop + min(upTo, count - 1u));
    vec4 change = abs(stopColor(after) - stopColor(before));
    float bend = max(change.r, max(change.g, change.b)) * change.a;  // times the stretch's length squared
    float low = mix(0.0, uintBitsToFloat(before.x), upTo > 0u), high = mix(1.0, uintBitsToFloat(after.x), upTo < count);
    float gap = high - low;
    vec4 middle = colorBetween(before, after, v);
    bool isMiddle = width * width * bend <= 12.0 * maxBending * gap * gap &&
                    (padded && upTo == 0u || unclamped - 0.5 * width >= low) &&
                    (padded && upTo == count || unclamped + 0.5 * width <= high);
    return isMiddle ? middle : meanOver(ASSET firstStop, count, spread, u, longer, shorter, middle);
}

// ---- Radial gradients

// The larger root u of |p - (1-u) f| = (1-u) fr + u with (1-u) fr + u >= 0, and whether there is one.
// With d = p - f: a u² - 2 b u - c = 0; the roots are q / a and -c / q, q = b ± sqrt(b² + a c) with the
// sign that cancels nothing. Its slope is (u f + d) / (a u - b).
bool radialOffset(vec2 p, vec2 f, float fr, out float u, out vec2 slope) {
    vec2 d = p - f;
    float grow = 1.0 - fr;
    float a = grow * grow - dot(f, f), b = dot(d, f) - fr * grow, c = dot(d, d) - fr * fr;
    float discriminant = b * b + a * c;
    float q = b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(discriminant, 0.0));
    float one = mix(-c / q, 0.0, q == 0.0), other = mix(q / a, one, a == 0.0);
    float larger = max(one, other), smaller = min(one, other);
    u = fr + larger * grow >= 0.0 ? larger : smaller;
    slope = (u * f + d) / max(abs(a * u - b), 1e-6);
    return discriminant >= 0.0 && fr + u * grow >= 0.0;
}

// A radial gradient is a cone over the plane, about its focus: the mean of u over a pixel is not that in the middle. Moves
// u, and scales what the pixel's sides change it by, to mean and variance; the formula stands in the twin.
void overCone(vec2 slope, vec2 d, mat2 sides, inout float u, out vec2 along) {
    along = slope * sides;
    float steep = dot(slope, slope), above = steep * dot(d, d);
    float all = steep * (dot(sides[0], sides[0]) + dot(sides[1], sides[1])), radial = dot(along, along);
    if (radial > 0.0 && above <= 64.0 * all) {  // else it is far from the tip
        float near = 1.0 / (1.0 + 6.6 * above / all), tip = 0.0315 * all * near * near;
        u += sqrt(above + max(all - radial, 0.0) / 12.0 + tip) - sqrt(above);
        along *= sqrt(max(0.0, 1.0 - 12.0 * tip / radial));
    }
}

// Where the middle of a pixel is nearer to the focus than this share of its side, it is put there: at the focus itself
// there is no slope.
const float besideFocus = 1e-3;

// The mean over a pixel whose middle is `point`, where the ramp bends within it.
vec4 gradientColor(ASSET_IN bool radial, uint gradient, vec2 point, mat3x2 pixel) {
    uvec4 a = texelAt(ASSET gradient), b = texelAt(ASSET gradient + 1u);
    vec4 linear = uintBitsToFloat(a);
    mat2 sides = mat2(linear.xy, linear.zw) * mat2(pixel[0], pixel[1]);
    vec2 p = applyMatrix(a, b, point), along = vec2(sides[0].x, sides[1].x);
    float u = p.x;
    bool exists = true;
    if (radial) {
        vec4 focus = uintBitsToFloat(texelAt(ASSET gradient + 2u));
        vec2 d = p - focus.xy, slope;
        d = mix(d, besideFocus * sides[0], bvec2(length(d) < besideFocus * length(sides[0])));
        exists = radialOffset(focus.xy + d, focus.xy, focus.z, u, slope);
        overCone(slope, d, sides, u, along);
    }
    vec4 color = vec4(0.0);
    if (exists)
        color = colorOver(ASSET gradient + 3u, b.w, b.z, u, along);
    return color;
}
