// FillMask: paint at the pixel's centre times coverage. Blended over.
// Requires: paint.glsl.

flat in ivec2 maskOffset;
flat in uint boxPaint;

uniform sampler2D layer;      // the coverage
uniform vec4 pixelToPicture;  // linear part, by columns
uniform vec4 pictureAnchor;   // a picture point and the pixel position that shows it

out vec4 color;

void main() {
    vec2 d = gl_FragCoord.xy - pictureAnchor.zw;
    vec2 point = pictureAnchor.xy + pixelToPicture.xy * d.x + pixelToPicture.zw * d.y;
    float coverage = clamp(texelFetch(layer, ivec2(gl_FragCoord.xy) + maskOffset, 0).r, 0.0, 1.0);
    color = paintColor(boxPaint, point, mat3x2(pixelToPicture, point)) * coverage;
}
