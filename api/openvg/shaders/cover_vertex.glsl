// The corners of a tile, a strip of two triangles; an instance each. Requires: layer_prelude.glsl.
// Exports to fragments: block, tileColor.

layout(location = 0) in uvec4 rectangle;  // x, y, width, height
layout(location = 1) in uint firstShare;  // 0xffffffff: all are 1
layout(location = 2) in vec4 color;

flat out ivec4 block;  // x, y, width, place of the first share; -1: all are 1
flat out vec4 tileColor;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 place = vec2(rectangle.xy) + corner * vec2(rectangle.zw);
    block = ivec4(ivec3(rectangle.xyz), int(firstShare));
    tileColor = color;
    gl_Position = vec4(2.0 * place / vec2(frame.xy) - 1.0, 0.0, 1.0);
}
