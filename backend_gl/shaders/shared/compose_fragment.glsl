// A finished picture into a user's framebuffer. Requires: output.glsl, box_vertex.glsl's outputs.

flat in ivec2 maskOffset;
flat in uint boxPaint;

uniform sampler2D layer;

out vec4 color;

void main() { color = outputColor(texelFetch(layer, ivec2(gl_FragCoord.xy) + maskOffset, 0)); }
