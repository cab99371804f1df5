// A vertex of a surface.
// Requires: nothing.

layout(location = 0) in vec4 position;
layout(location = 1) in vec2 repeats;

out vec2 st;

void main() {
    st = repeats;
    gl_Position = position;
}
