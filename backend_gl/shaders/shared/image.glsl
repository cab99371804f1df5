// Pictures of paint programs and their levels (image/levels.hpp), all in one texture, row after row.
// Requires: fetch.glsl (spend, too), gradient.glsl; constants imageColumnsLog2, filter*. Twin of: raster/src/image_fill.cpp.
// Exports: imageColor.

#ifdef ONE_ASSET
uniform sampler2D images;
// First texel of the list of pictures: first pixel, width, height, 0.
uniform uint imageSection;
#endif

// The level that is so much coarser, or the last. Each stands behind the one before: first texel, width, height, number.
uvec4 levelOf(uvec4 picture, uint number) {
    while (picture.w < number && picture.y * picture.z > 1u)
        picture = uvec4(picture.x + picture.y * picture.z, (picture.yz + 1u) / 2u, picture.w + 1u);
    return picture;
}

// The picture itself is stored straight, means are premultiplied.
vec4 levelTexel(ASSET_IN uvec4 level, ivec2 p) {
    p = clamp(p, ivec2(0), ivec2(level.yz) - 1);
    uint index = level.x + uint(p.y) * level.y + uint(p.x);
    ivec2 place = ivec2(index & ((1u << imageColumnsLog2) - 1u), index >> imageColumnsLog2);
    vec4 c = texelFetch(ASSET_PART(images), place, 0);
    return vec4(mix(c.rgb, c.rgb * c.a, bvec3(level.w == 0u)), c.a);
}

// How texels make a colour: the mean of a square, `width` texels wide, and by a share Catmull-Rom's cubic. The width
// is in [1, 4]; at 1 the mean interpolates. 0: the nearest texel.
struct Kernel {
    float width, cubic;
};

// Weights of texels whose middles are at these distances. The cubic (Keys 1981, a = -1/2) passes through the pixels,
// and through the points of any quadratic.
vec2 weightsOf(Kernel kernel, vec2 d) {
    d = abs(d);
    float reach = 0.5 * kernel.width;
    vec2 mean = max(min(d + 0.5, vec2(reach)) - max(d - 0.5, vec2(-reach)), 0.0) / kernel.width;
    vec2 keys = mix((1.5 * d - 2.5) * d * d + 1.0, ((-0.5 * d + 2.5) * d - 4.0) * d + 2.0, step(1.0, d));
    return mix(mix(mean, keys, kernel.cubic), vec2(1.0), bvec2(kernel.width == 0.0));
}

// Of texels in a row that count at most.
int tapsOf(Kernel kernel) {
    int taps = int(ceil(kernel.width)) + 1;
    return kernel.cubic > 0.0 ? 4 : taps;
}

// Premultiplied neighbours are summed, so that transparent pixels lend no colour.
vec4 filtered(ASSET_IN uvec4 level, vec2 p, Kernel kernel) {
    // Keeps the conversion to int defined; the edge goes on beyond the border anyway.
    p = clamp(p * exp2(-float(level.w)), vec2(-2.0), vec2(level.yz) + 2.0);
    int taps = tapsOf(kernel);
    vec2 corner = floor(p - mix(0.5 * kernel.width, 1.5, kernel.cubic > 0.0));
    vec4 sum = vec4(0.0);
    ivec2 tap = ivec2(0);
    for (int i = 0; i < taps * taps; ++i) {
        vec2 weights = weightsOf(kernel, corner + vec2(tap) + 0.5 - p);
        sum += weights.x * weights.y * levelTexel(ASSET level, ivec2(corner) + tap);
        ++tap.x;
        if (tap.x == taps)
            tap = ivec2(0, tap.y + 1);
        if (i + 1 == taps * taps)
            break;
    }
    return sum;
}

// Where a pixel's footprint is read (docs/scene.md, filters of images): at 2 side + 1 points along its longer axis, a
// step apart, each for a square `width` wide. The outermost two count `outer`, and all of them `all`.
struct Probes {
    int side;
    float width, outer, all;
    vec2 step;
};

const float maxOblong = 16.0, nearlyRound = 1.0 / 64.0;

// m: a pixel's sides in the image. Its singular values are the axes of the ellipse that it makes of a circle.
Probes probesOf(mat2 m) {
    float a = m[0].x * m[0].x + m[1].x * m[1].x, b = m[0].x * m[0].y + m[1].x * m[1].y;
    float c = m[0].y * m[0].y + m[1].y * m[1].y;
    float halved = 0.5 * (a - c), root = length(vec2(halved, b)), longer = sqrt(0.5 * (a + c) + root);
    float shorter = abs(m[0].x * m[1].y - m[0].y * m[1].x) / max(longer, 1e-20);
    vec2 along = mix(vec2(b, root - halved), vec2(halved + root, b), bvec2(halved > 0.0));
    float width = max(1.0, max(shorter, longer / maxOblong));
    float all = clamp(longer / width - nearlyRound, 1.0, maxOblong);
    int side = int(ceil(0.5 * (all - 1.0)));
    return Probes(side, width, mix(0.5 * (all - float(2 * side - 1)), 1.0, side == 0), all,
                  along * (width / max(length(along), 1e-20)));
}

// Of squares two to four texels wide; those of the picture itself may be narrower. From so many texels on a level is
// blended with the next, so that none comes at once. From one texel to so many the cubic becomes the mean of a square.
const float mostTexels = 4.0, blendsFrom = 3.5, cubicTo = 1.25;

// Nearest and bilinear at the point. The others filter for a pixel, so they are asked at its centre, wherever in it the
// point lies. One loop over levels and points, because compilers inline what is in it.
vec4 imageColor(ASSET_IN uint fill, vec2 point, mat3x2 pixel) {
    uvec4 a = texelAt(ASSET fill), b = texelAt(ASSET fill + 1u);
    uvec4 picture = texelAt(ASSET ASSET_PART(imageSection) + b.z);
    bool ofPixel = b.w >= filterTrilinear;
    vec2 p = applyMatrix(a, b, ofPixel ? pixel[2] : point);
    vec4 linear = uintBitsToFloat(a);
    Probes probes = Probes(0, 1.0, 1.0, 1.0, vec2(0.0));
    if (ofPixel)
        probes = probesOf(mat2(linear.xy, linear.zw) * mat2(pixel[0], pixel[1]));
    int lod = int(clamp(log2(probes.width) - 1.0, 0.0, 30.0));
    Kernel kernel = Kernel(clamp(probes.width * exp2(-float(lod)), 1.0, mostTexels), 0.0);
    if (b.w == filterNearest)
        kernel.width = 0.0;
    float share = max((kernel.width - blendsFrom) / (mostTexels - blendsFrom), 0.0);
    if (lod == 0 && b.w == filterBicubic)
        kernel.cubic = max((cubicTo - kernel.width) / (cubicTo - 1.0), 0.0);
    int taps = tapsOf(kernel);
    vec4 sum = vec4(0.0);
    int levels = share > 0.0 ? 2 : 1;
    // At each point: the loop itself, down to its level, the texels.
    int turnsOfPoint = 1 + lod + 3 + taps * taps + 1;
    if (!spend(float(levels * (2 * probes.side + 1) * turnsOfPoint)))
        return sum;
    for (int i = levels * -probes.side; i < levels * (probes.side + 1); ++i) {
        // The two levels take turns at each of the points.
        bool coarser = levels == 2 && (i & 1) == 1;
        int ofTwo = i >> 1, probe = levels == 2 ? ofTwo : i;
        uvec4 level = levelOf(picture, uint(lod) + (coarser ? 1u : 0u));
        float weight = mix(1.0, probes.outer, abs(probe) == probes.side) / probes.all;
        Kernel ofLevel = Kernel(mix(kernel.width, 0.5 * kernel.width, coarser), kernel.cubic);
        sum += weight * mix(1.0 - share, share, coarser) *
               filtered(ASSET level, p + float(probe) * probes.step, ofLevel);
        if (i + 1 == levels * (probes.side + 1))
            break;
    }
    // Catmull-Rom overshoots beside edges.
    sum.a = clamp(sum.a, 0.0, 1.0);
    return vec4(clamp(sum.rgb, 0.0, sum.a), sum.a);
}
