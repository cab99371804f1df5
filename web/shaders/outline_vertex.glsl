// Rectangles of the picture, an instance each, as loops of four lines.
precision highp float;

uniform mat3 toClip;  // from (point of the picture, 1)

layout(location = 0) in vec4 rectangle;  // least x and y, width, height
layout(location = 1) in vec4 ink;

flat out vec4 inkOfLine;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 || gl_VertexID == 2, gl_VertexID >= 2);
    vec3 place = toClip * vec3(rectangle.xy + corner * rectangle.zw, 1.0);
    gl_Position = vec4(place.xy, 0.0, place.z);
    inkOfLine = ink;
}
