// One axis of a blur: means over coarse pixels, a kernel, cubic B-splines back to pixels.
// Requires: layer.glsl, store.glsl; constants variant, the action,
// blur*, maxBlurKernel. Twin of: raster/filter/blur.cpp, which has the method.

uniform ivec2 along;                  // the axis: (1, 0) or (0, 1)
uniform int coarse;                   // pixels of a coarse one
uniform int phase;                    // blurReduce: the input's pixel where the result's first begins;
                                      // blurEnlarge: pixels from the corner of a coarse one to the result's first
uniform int reach;                    // blurKernel: pixels to each side
uniform float weights[maxBlurKernel];  // from the centre outwards

int lineOf(ivec2 p) { return p.x * along.x + p.y * along.y; }

vec4 mean(ivec2 p) {
    ivec2 start = p + along * (lineOf(p) * (coarse - 1) + phase);
    vec4 sum = vec4(0.0);
    for (int k = 0; k < coarse; ++k)
        sum += firstAt(start + k * along);
    return sum / float(coarse);
}

vec4 convolved(ivec2 p) {
    vec4 sum = weights[0] * firstAt(p);
    for (int k = 1; k <= reach; ++k)
        sum += weights[k] * (firstAt(p - k * along) + firstAt(p + k * along));
    return sum;
}

vec4 enlarged(ivec2 p) {
    float at = (float(lineOf(p) + phase) + 0.5) / float(coarse) - 0.5;
    float whole = floor(at), t = at - whole, u = 1.0 - t;
    ivec2 q = p + along * (int(whole) - lineOf(p));
    return (u * u * u * firstAt(q - along) + (4.0 - 6.0 * t * t + 3.0 * t * t * t) * firstAt(q) +
            (4.0 - 6.0 * u * u + 3.0 * u * u * u) * firstAt(q + along) + t * t * t * firstAt(q + 2 * along)) /
           6.0;
}

void main() {
    ivec2 p = pixel();
    store(variant == blurReduce ? mean(p) : variant == blurKernel ? convolved(p) : enlarged(p));
}
