// Means of whole texels of a finer level. Twin of: coarser() in raster/src/prefilter.cpp.

uniform sampler2D finer;
uniform ivec2 texels;  // of the finer level that make one of this

out vec4 mean;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * texels;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < texels.y; ++y)
        for (int x = 0; x < texels.x; ++x)
            sum += texelFetch(finer, first + ivec2(x, y), 0);
    mean = sum / float(texels.x * texels.y);
}
