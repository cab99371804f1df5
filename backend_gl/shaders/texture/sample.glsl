// An asset as a texture: the mean colour over a parallelogram of the picture. docs/texture.md.
// Requires: sample_asset.glsl, sample_tree.glsl, sample_maps.glsl, sample_page.glsl, sample_prefilter.glsl;
// constants wrap*, turnsPerPixel, prefilterTurns, FEATURES, VTM_SAMPLES.
// Exports: vtm_sample, vtm_sample_proj, vtm_sample_grad.

// Here as everywhere loops are left at the bottom, by a break: some drivers run the body otherwise once more, with all
// loops in it, to find that they have ended. (Others take long to compile nested loops with conditions at the bottom.)
// Values are chosen by mix(), or by `?:` between variables, which is no branch: docs/backend.md, Programs.

// ---- The footprint ------------------------------------------------------------------------------------

bool repeats(int wrapping) { return wrapping == wrapRepeat || wrapping == wrapMirror; }

// Copies of the picture that a footprint of this half width meets, as (first, last).
vec2 copies(int wrapping, float at, float halfWidth) {
    float first = floor(at - halfWidth);
    return mix(vec2(0.0), vec2(first, max(ceil(at + halfWidth) - 1.0, first)), bvec2(repeats(wrapping)));
}

bool isMirrored(int wrapping, float copy) {
    return wrapping == wrapMirror && abs(copy - 2.0 * floor(copy * 0.5)) > 0.5;
}

// Adds what the maps have of the footprint; gives up where no turns are left.
void addFootprint(Vtm vtm, Footprint footprint, inout vec4 sum) {
    readNumbers(vtm);
    vec2 scale = vtm.size / vtm.square.z, offset = -vtm.square.xy / vtm.square.z;
    mat2 toBox = inverse(footprint.sides) * vtm.square.z;
    vec2 halfBox = 0.5 * (abs(footprint.sides[0]) + abs(footprint.sides[1])) / vtm.size;
    vec2 s = copies(vtm.wrapping.x, footprint.st.x, halfBox.x);
    vec2 t = copies(vtm.wrapping.y, footprint.st.y, halfBox.y);
    vec2 copy = vec2(s.x, t.x);
    while (copy.y <= t.y && spend(1.0)) {
        bvec2 mirrored = bvec2(isMirrored(vtm.wrapping.x, copy.x), isMirrored(vtm.wrapping.y, copy.y));
        vec2 st = footprint.st - copy;
        st = mix(st, 1.0 - st, mirrored);
        vec2 turned = mix(vec2(1.0), vec2(-1.0), mirrored);
        vec2 lower = max(st - halfBox, 0.0), upper = min(st + halfBox, 1.0);
        if (all(lessThanEqual(lower, upper))) {
            layGround(vtm, all(equal(lower, st - halfBox)) && all(equal(upper, st + halfBox)), sum);
            // A box that only touches the picture's end has no cell beyond it.
            lower = clamp(lower * scale + offset, 0.0, lastPlace);
            upper = clamp(upper * scale + offset, 0.0, 1.0);
            CopyFootprint part = CopyFootprint(st * scale + offset, halfBox * scale, lower, upper,
                                               mat2(toBox[0] * turned.x, toBox[1] * turned.y));
            mat3x2 pixel = mat3x2(footprint.sides[0], footprint.sides[1], picturePoint(vtm, st * scale + offset));
            addPicture(vtm, part, pixel, sum);
        }
        copy = mix(vec2(s.x, copy.y + 1.0), vec2(copy.x + 1.0, copy.y), bvec2(copy.x < s.y));
        if (copy.y > t.y)
            break;
    }
}

// A share of what a pixel may take. The prefilter's own turns are set aside; what was begun and not finished is not
// shown, so nothing is ever missing.
vec4 sampled(Vtm vtm, vec2 st, vec2 dx, vec2 dy, float turns) {
    if ((vtm.features & ~FEATURES) != 0u)
        return vec4(1.0, 0.0, 1.0, 1.0);  // the include was made for other assets
    Footprint footprint = footprintOf(vtm, st, dx, dy);
    float share = prefilterShare(footprint);
    vec4 color = vec4(0.0);
    if (share < 1.0) {
        float allowed = turns - prefilterTurns;
        turnsLeft = allowed;
        addFootprint(vtm, footprint, color);
        color = clamp(color, 0.0, 1.0);
        share = max(share, clamp(1.0 - 4.0 * turnsLeft / allowed, 0.0, 1.0));
    }
    if (share > 0.0)
        color = mix(color, prefiltered(vtm, footprint), share);
    return color;
}

// Shared by all strips, and by all samples that a pixel of the user's takes.
const float turnsOfSample = float(turnsPerPixel) / float(VTM_SAMPLES);

vec4 vtm_sample_grad(Vtm vtm, vec2 st, vec2 dx, vec2 dy) { return sampled(vtm, st, dx, dy, turnsOfSample); }

// ---- Perspective ----------------------------------------------------------------------------------------

// On a plane in perspective (s, t, q) times gl_FragCoord.w is linear over the screen, so its differences are exact.
// With g = q' / q and J = ((s, t)' - (s, t) q' / q) / q what lies p pixels away is (s, t) / q + J p / (1 + g · p). A
// footprint is that with g = 0, which is off by |g| / 4 of a pixel at most where the pixel ends; on strips, 1 / n of a
// pixel wide, it is off by |g| / (4 n²), which is to stay below 1 / 256.
int stripsFor(float g) { return clamp(int(ceil(8.0 * sqrt(g))), 1, 4); }

vec4 vtm_sample_proj(Vtm vtm, vec3 stq) {
    vec3 at = stq * gl_FragCoord.w, dx = dFdx(at) / at.z, dy = dFdy(at) / at.z;
    vec2 st = stq.xy / stq.z, g = clamp(vec2(dx.z, dy.z), -1.0, 1.0);
    mat2 sides = mat2(dx.xy - st * dx.z, dy.xy - st * dy.z);
    bool acrossX = abs(g.x) > abs(g.y);
    float most = acrossX ? g.x : g.y;
    vec2 axis = acrossX ? sides[0] : sides[1];
    int count = stripsFor(abs(most));
    vec2 widths = mix(vec2(1.0), vec2(1.0 / float(count)), bvec2(acrossX, !acrossX));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; ++i) {
        float p = (float(i) + 0.5) / float(count) - 0.5, scale = 1.0 / (1.0 + most * p);
        vec2 away = axis * (p * scale), strip = widths * scale;
        sum += sampled(vtm, st + away, (sides[0] - away * g.x) * strip.x, (sides[1] - away * g.y) * strip.y,
                       turnsOfSample / float(count));
        if (i + 1 == count)
            break;
    }
    return sum / float(count);
}

vec4 vtm_sample(Vtm vtm, vec2 st) { return vtm_sample_proj(vtm, vec3(st, 1.0)); }
