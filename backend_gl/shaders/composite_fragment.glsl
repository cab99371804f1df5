// Layers on layers: fills through a mask, groups, masks and clips (compat mode).
// Requires: paint.glsl, blend.glsl; constants action*. Twin of: asset/src/evaluate.cpp.

flat in ivec2 maskOffset;
flat in uint boxPaint;

uniform uint action;
uniform sampler2D layer;          // Fill, Clip: the coverage; else the popped picture
uniform sampler2D backdrop;       // Blend: the picture below
uniform ivec4 maskBox;            // Clip: pixels [x, z) × [y, w) where the mask can be above 0
uniform uint blendMode;           // Blend
uniform uint maskOp;              // Mask
uniform float opacity;            // Over, Blend
uniform vec4 pixelToPicture;      // linear part, by columns
uniform vec4 pictureAnchor;       // a picture point and the pixel position that shows it

out vec4 color;

vec2 pictureOf(vec2 pixel) {
    vec2 d = pixel - pictureAnchor.zw;
    return pictureAnchor.xy + pixelToPicture.xy * d.x + pixelToPicture.zw * d.y;
}

float coverageAt(ivec2 pixel) { return clamp(texelFetch(layer, pixel + maskOffset, 0).r, 0.0, 1.0); }

bool inMaskBox(ivec2 pixel) {
    return all(greaterThanEqual(pixel, maskBox.xy)) && all(lessThan(pixel, maskBox.zw));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    color = vec4(0.0);
    if (action == actionFill) {
        float coverage = coverageAt(pixel);
        if (coverage == 0.0)
            discard;
        color = paintColor(boxPaint, pictureOf(gl_FragCoord.xy)) * coverage;
    } else if (action == actionClip) {
        // Blended with (0, source alpha): what stays of the target.
        color.a = inMaskBox(pixel) ? coverageAt(pixel) : 0.0;
    } else {
        vec4 popped = texelFetch(layer, pixel, 0);
        if (action == actionMask)
            color.a = maskFactor(maskOp, popped);
        else if (action == actionOver)
            color = popped * opacity;
        else
            color = blend(blendMode, popped * opacity, texelFetch(backdrop, pixel, 0));
    }
}
