// One box of pixels an instance, for composition.
// Exports, flat: maskOffset, boxPaint.

layout(location = 0) in ivec4 box;     // pixels [x, z) × [y, w) of the target
layout(location = 1) in ivec4 source;  // xy: from the target's pixel to the mask's; z: paint

uniform vec2 targetSize;

flat out ivec2 maskOffset;
flat out uint boxPaint;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? box.x : box.z, (gl_VertexID >> 1) == 0 ? box.y : box.w);
    gl_Position = vec4(corner / targetSize * 2.0 - 1.0, 0.0, 1.0);
    maskOffset = source.xy;
    boxPaint = uint(source.z);
}
