// Blend modes: a function each, of premultiplied source and destination in the same space. Requires: nothing.
// Twin of: api/openvg/draw/blend.cpp. Exports: the functions that blendName() of api/openvg/gl/programs.cpp names.

vec4 src(vec4 s, vec4 d) { return s; }
vec4 srcOver(vec4 s, vec4 d) { return s + d * (1.0 - s.a); }
vec4 dstOver(vec4 s, vec4 d) { return s * (1.0 - d.a) + d; }
vec4 srcIn(vec4 s, vec4 d) { return s * d.a; }
vec4 dstIn(vec4 s, vec4 d) { return d * s.a; }
vec4 multiply(vec4 s, vec4 d) {
    return vec4((s * (1.0 - d.a) + d * (1.0 - s.a) + s * d).rgb, srcOver(s, d).a);
}
vec4 screen(vec4 s, vec4 d) { return s + d - s * d; }
vec4 darken(vec4 s, vec4 d) { return min(srcOver(s, d), dstOver(s, d)); }
vec4 lighten(vec4 s, vec4 d) { return max(srcOver(s, d), dstOver(s, d)); }
vec4 additive(vec4 s, vec4 d) { return min(s + d, 1.0); }

// ---- VG_KHR_advanced_blending: Porter-Duff ----

vec4 clear(vec4 s, vec4 d) { return vec4(0.0); }
vec4 dst(vec4 s, vec4 d) { return d; }
vec4 srcOut(vec4 s, vec4 d) { return s * (1.0 - d.a); }
vec4 dstOut(vec4 s, vec4 d) { return d * (1.0 - s.a); }
vec4 srcAtop(vec4 s, vec4 d) { return s * d.a + d * (1.0 - s.a); }
vec4 dstAtop(vec4 s, vec4 d) { return s * (1.0 - d.a) + d * s.a; }
vec4 exclusiveOr(vec4 s, vec4 d) { return s * (1.0 - d.a) + d * (1.0 - s.a); }

// ---- Channel by channel ----

struct Operands {
    float s, d, sa, da;
};

// What shows where only one of the two is.
float apart(Operands o) { return o.s * (1.0 - o.da) + o.d * (1.0 - o.sa); }
// The destination without its alpha; 0 where there is none.
float plain(Operands o) { return o.da > 0.0 ? o.d / o.da : 0.0; }

float multiplied(Operands o) { return 2.0 * o.s * o.d + apart(o); }
float screened(Operands o) { return o.sa * o.da - 2.0 * (o.da - o.d) * (o.sa - o.s) + apart(o); }

float overlay(Operands o) { return 2.0 * o.d < o.da ? multiplied(o) : screened(o); }
float hardLight(Operands o) { return 2.0 * o.s < o.sa ? multiplied(o) : screened(o); }

float lightened(Operands o) {
    return o.d * o.sa + (sqrt(plain(o)) * o.da - o.d) * (2.0 * o.s - o.sa) + apart(o);
}
float softLightSvg(Operands o) {
    float p = plain(o), light = (1.0 - p) * (2.0 * o.s - o.sa);
    if (2.0 * o.s < o.sa)
        return o.d * (o.sa - light) + apart(o);
    return 8.0 * o.d <= o.da ? o.d * (o.sa - light * (3.0 - 8.0 * p)) + apart(o) : lightened(o);
}
float softLight(Operands o) {
    float p = plain(o), light = 2.0 * o.s - o.sa;
    if (2.0 * o.s < o.sa)
        return o.d * o.sa + o.d * (1.0 - p) * light + apart(o);
    return 4.0 * o.d <= o.da ? o.d * o.sa + o.d * ((16.0 * p - 12.0) * p + 3.0) * light + apart(o) : lightened(o);
}

float dodged(Operands o, float share) {
    float both = o.sa * o.da;
    if (!(o.s < o.sa))
        return both + apart(o);
    return min(both, o.d * o.sa / (share * (1.0 - o.s / o.sa))) + apart(o);
}
float burnt(Operands o, float share) {
    if (!(o.s > 0.0))
        return apart(o);
    float both = o.sa * o.da;
    return both - min(both, o.sa * (o.sa * (o.da - o.d) / (share * o.s))) + apart(o);
}
float colorDodge(Operands o) { return dodged(o, 1.0); }
float colorBurn(Operands o) { return burnt(o, 1.0); }
float vividLight(Operands o) { return 2.0 * o.s < o.sa ? burnt(o, 2.0) : dodged(o, 2.0); }

float difference(Operands o) { return o.s + o.d - 2.0 * min(o.s * o.da, o.d * o.sa); }
float subtract(Operands o) { return max(o.d - o.s, 0.0); }
float invert(Operands o) { return (1.0 - o.sa) * o.d + o.sa * (1.0 - o.d); }
float exclusion(Operands o) { return o.s * o.da + o.d * o.sa - 2.0 * o.s * o.d + apart(o); }

float linearDodge(Operands o) {
    float both = o.sa * o.da;
    return o.s * o.da + o.d * o.sa <= both ? o.s + o.d : both + apart(o);
}
float linearBurn(Operands o) {
    float both = o.sa * o.da;
    return o.s * o.da + o.d * o.sa > both ? o.s + o.d - both : apart(o);
}
float linearLight(Operands o) {
    float both = o.sa * o.da, sum = 2.0 * o.s * o.da + o.d * o.sa;
    return clamp(sum - both, 0.0, both) + apart(o);
}
float pinLight(Operands o) {
    float both = o.sa * o.da, source = 2.0 * o.s * o.da, destination = o.d * o.sa;
    return max(source - both, min(source, destination)) + apart(o);
}
float hardMix(Operands o) {
    float both = o.sa * o.da;
    return (o.s * o.da + o.d * o.sa < both ? 0.0 : both) + apart(o);
}

// Colours are clamped to [0, alpha]; alpha is that of source over destination.
#define SEPARABLE(mode)                                                                 \
    vec4 mode(vec4 s, vec4 d) {                                                         \
        float alpha = s.a + d.a * (1.0 - s.a);                                          \
        vec3 c = vec3(mode(Operands(s.r, d.r, s.a, d.a)),                               \
                      mode(Operands(s.g, d.g, s.a, d.a)),                               \
                      mode(Operands(s.b, d.b, s.a, d.a)));                              \
        return vec4(clamp(c, 0.0, alpha), alpha);                                       \
    }
SEPARABLE(overlay)
SEPARABLE(hardLight)
SEPARABLE(softLightSvg)
SEPARABLE(softLight)
SEPARABLE(colorDodge)
SEPARABLE(colorBurn)
SEPARABLE(difference)
SEPARABLE(subtract)
SEPARABLE(invert)
SEPARABLE(exclusion)
SEPARABLE(linearDodge)
SEPARABLE(linearBurn)
SEPARABLE(vividLight)
SEPARABLE(linearLight)
SEPARABLE(pinLight)
SEPARABLE(hardMix)
