// Pictures of paint programs, all in one texture, row after row.
// Requires: fetch.glsl, gradient.glsl; constant imageColumnsLog2. Twin of: asset/src/paint.cpp.
// Exports: imageColor.

#ifdef ONE_ASSET
uniform sampler2D images;
// First texel of the list of pictures: first pixel, width, height.
uniform uint imageSection;
#endif

vec4 imagePixel(ASSET_IN uvec3 picture, ivec2 p) {
    p = clamp(p, ivec2(0), ivec2(picture.yz) - 1);
    uint index = picture.x + uint(p.y) * picture.y + uint(p.x);
    ivec2 place = ivec2(index & ((1u << imageColumnsLog2) - 1u), index >> imageColumnsLog2);
    vec4 c = texelFetch(ASSET_PART(images), place, 0);
    return vec4(c.rgb * c.a, c.a);
}

// Premultiplied neighbours are interpolated, so that transparent pixels lend no colour.
vec4 imageColor(ASSET_IN uint fill, vec2 point) {
    uvec4 a = texelAt(ASSET fill), b = texelAt(ASSET fill + 1u);
    uvec3 picture = texelAt(ASSET ASSET_PART(imageSection) + b.z).xyz;
    // Keeps the conversion to int defined; the edge goes on beyond the border anyway.
    vec2 p = clamp(applyMatrix(a, b, point), vec2(-1.0), vec2(picture.yz) + 1.0);
    if (b.w == 0u)
        return imagePixel(ASSET picture, ivec2(floor(p)));
    p -= 0.5;
    vec2 corner = floor(p), f = p - corner;
    ivec2 q = ivec2(corner);
    vec4 top = mix(imagePixel(ASSET picture, q), imagePixel(ASSET picture, q + ivec2(1, 0)), f.x);
    vec4 bottom = mix(imagePixel(ASSET picture, q + ivec2(0, 1)), imagePixel(ASSET picture, q + ivec2(1, 1)), f.x);
    return mix(top, bottom, f.y);
}
