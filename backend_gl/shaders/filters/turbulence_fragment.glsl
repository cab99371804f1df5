// Sums of Perlin's noise. Requires: store.glsl, colors.glsl. Twin of: raster/filter/turbulence.cpp.

uniform sampler2D lattice;  // rows: x and y components of red, green, blue, alpha by lattice point; its number
uniform sampler2D places;   // by octave a row of columns and, behind them all, one of rows of pixels: low and
                            // high lattice point, from the low one to the centre, what is interpolated with
uniform int octaves;
uniform bool fractal;

int numberOf(int point) { return int(texelFetch(lattice, ivec2(point, 2), 0).x); }

vec4 slope(int point, vec2 from) {
    return from.x * texelFetch(lattice, ivec2(point, 0), 0) + from.y * texelFetch(lattice, ivec2(point, 1), 0);
}

vec4 noise(vec4 x, vec4 y) {
    int left = numberOf(int(x.x)), right = numberOf(int(x.y)), low = int(y.x), high = int(y.y);
    vec2 rest = vec2(x.z, y.z);
    vec4 top = mix(slope(numberOf(left + low), rest), slope(numberOf(right + low), rest - vec2(1.0, 0.0)), x.w);
    vec4 bottom =
        mix(slope(numberOf(left + high), rest - vec2(0.0, 1.0)), slope(numberOf(right + high), rest - 1.0), x.w);
    return mix(top, bottom, y.w);
}

void main() {
    ivec2 p = pixel();
    vec4 sum = vec4(0.0);
    float share = 1.0;
    for (int octave = 0; octave < octaves; ++octave, share *= 0.5) {
        vec4 value = noise(texelFetch(places, ivec2(p.x, octave), 0),
                           texelFetch(places, ivec2(p.y, octaves + octave), 0));
        sum += share * (fractal ? value : abs(value));
    }
    store(premultiplied(clamp(fractal ? (sum + 1.0) / 2.0 : sum, 0.0, 1.0)));
}
