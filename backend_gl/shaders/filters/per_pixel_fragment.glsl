// Primitives that compute each pixel from the same pixel of their inputs.
// Requires: layer.glsl, store.glsl, colors.glsl, numbers.glsl; constants variant, the primitive, primitive*, composite*,
// transfer*.
// Twin of: raster/filter/per_pixel.cpp.

uniform bool isLight;  // the result's colour space

// Straight numbers in the parameters, from `index` on.
vec4 colorFrom(uint index) {
    vec4 c = vec4(number(index), number(index + 1u), number(index + 2u), number(index + 3u));
    return premultiplied(isLight ? vec4(linearLight(c.rgb), c.a) : c);
}

vec4 matrixTimes(vec4 c) {
    vec4 sum = vec4(0.0);
    for (uint row = 0u; row < 4u; ++row) {
        uint i = row * 5u;
        float value = number(i) * c.r + number(i + 1u) * c.g + number(i + 2u) * c.b + number(i + 3u) * c.a +
                      number(i + 4u);
        sum += value * vec4(row == 0u, row == 1u, row == 2u, row == 3u);
    }
    return sum;
}

// GLSL leaves powers of 0 open.
float power(float c, float exponent) {
    return c > 0.0 ? pow(c, exponent) : exponent > 0.0 ? 0.0 : exponent < 0.0 ? 1.0e30 : 1.0;
}

// `next`: where the channel's function begins; moved behind it.
float transferred(float c, inout uint next) {
    uint kind = uint(number(next)), count = uint(number(next + 1u)), values = next + 2u;
    next = values + count;
    if (kind == transferLinear)
        return clamp(number(values) * c + number(values + 1u), 0.0, 1.0);
    if (kind == transferGamma)
        return clamp(number(values) * power(c, number(values + 1u)) + number(values + 2u), 0.0, 1.0);
    if (count == 0u)
        return c;
    if (kind == transferDiscrete)
        return clamp(number(values + min(uint(c * float(count)), count - 1u)), 0.0, 1.0);
    float at = c * float(count - 1u);
    uint k = min(uint(at), count - 1u);
    float low = number(values + k), high = number(values + min(k + 1u, count - 1u));
    return clamp(low + (at - float(k)) * (high - low), 0.0, 1.0);
}

vec4 transferredColor(vec4 c) {
    uint next = 0u;
    float r = transferred(c.r, next), g = transferred(c.g, next), b = transferred(c.b, next);
    return vec4(r, g, b, transferred(c.a, next));
}

vec4 composited(vec4 a, vec4 b) {
    switch (uint(number(0u))) {
        case compositeOver: return over(a, b);
        case compositeIn: return a * b.a;
        case compositeOut: return a * (1.0 - b.a);
        case compositeAtop: return a * b.a + (1.0 - a.a) * b;
        case compositeXor: return a * (1.0 - b.a) + (1.0 - a.a) * b;
        case compositeLighter: return a + b;
        default: {
            vec4 c = clamp(number(1u) * a * b + number(2u) * a + number(3u) * b + number(4u), 0.0, 1.0);
            return vec4(min(c.rgb, c.a), c.a);
        }
    }
}

void main() {
    vec4 a = firstAt(pixel()), b = secondAt(pixel());
    switch (variant) {
        case primitivePicture: a = isLight ? inLight(a) : encoded(a); break;
        case primitiveBlend: a = blend(uint(number(0u)), a, b); break;
        case primitiveColorMatrix: a = premultiplied(clamp(matrixTimes(straightened(a)), 0.0, 1.0)); break;
        case primitiveComponentTransfer:
            a = premultiplied(transferredColor(clamp(straightened(a), 0.0, 1.0)));
            break;
        case primitiveComposite: a = composited(a, b); break;
        case primitiveFlood: a = colorFrom(0u); break;
        // The second input's alpha in the parameters' colour, below the first.
        case primitiveDropShadow: a = over(a, colorFrom(4u) * b.a); break;
        default: a = over(a, b); break;
    }
    store(a);
}
