// Tiles of one colour. Requires: output.glsl.

flat in vec4 flatColor;

out vec4 color;

void main() { color = outputColor(regionValue(flatColor)); }
