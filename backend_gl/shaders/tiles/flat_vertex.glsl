// Tiles of one colour.

layout(location = 0) in vec2 position;  // pixels
layout(location = 1) in vec4 premultiplied;

uniform vec2 targetSize;

flat out vec4 flatColor;

void main() {
    gl_Position = vec4(position / targetSize * 2.0 - 1.0, 0.0, 1.0);
    flatColor = premultiplied;
}
