// Popped groups, masks and clips over a target of compat mode.
// Requires: blend.glsl; constants action*. Twin of: raster/src/evaluate.cpp.

flat in ivec2 maskOffset;
flat in uint boxPaint;

uniform uint action;
uniform sampler2D layer;  // Clip: the coverage; else the popped picture
uniform ivec4 maskBox;    // Clip: pixels [x, z) × [y, w) where the mask can be above 0
uniform uint maskOp;      // Mask
uniform float opacity;    // Over

out vec4 color;

bool inMaskBox(ivec2 pixel) {
    return all(greaterThanEqual(pixel, maskBox.xy)) && all(lessThan(pixel, maskBox.zw));
}

// Clip and Mask are blended with (0, source alpha): alpha says what stays of the target.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 texel = texelFetch(layer, pixel + maskOffset, 0);
    if (action == actionClip)
        color = vec4(inMaskBox(pixel) ? clamp(texel.r, 0.0, 1.0) : 0.0);
    else if (action == actionMask)
        color = vec4(maskFactor(maskOp, texel));
    else
        color = texel * opacity;
}
