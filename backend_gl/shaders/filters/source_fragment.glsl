// A picture that was drawn for a filter, as a layer. Requires: store.glsl, colors.glsl.

uniform sampler2D layer;
uniform ivec4 layerBox;  // as firstBox
uniform bool alphaOnly, toLight;

void main() {
    ivec2 texel = pixel() + layerBox.xy;
    vec4 color = clamp(texelFetch(layer, clamp(texel, ivec2(0), layerBox.zw - 1), 0), 0.0, 1.0);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, layerBox.zw)))
        color = vec4(0.0);
    if (alphaOnly)
        color.rgb = vec3(0.0);
    store(toLight ? inLight(color) : color);
}
