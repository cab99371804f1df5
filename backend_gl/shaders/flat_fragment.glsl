// Patches of one colour.

flat in vec4 flatColor;

out vec4 color;

void main() { color = flatColor; }
