// The lines' colour.
precision highp float;

flat in vec4 inkOfLine;
out vec4 color;

void main() { color = inkOfLine; }
