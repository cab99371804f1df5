// A popped group with a blend mode that reads the backdrop; replaces the target's pixels.
// Requires: blend.glsl. Twin of: raster/src/evaluate.cpp.

flat in ivec2 maskOffset;
flat in uint boxPaint;

uniform sampler2D layer;     // the popped picture
uniform sampler2D backdrop;  // a copy of the picture below
uniform uint blendMode;
uniform float opacity;

out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    color = blend(blendMode, texelFetch(layer, pixel, 0) * opacity, texelFetch(backdrop, pixel, 0));
}
