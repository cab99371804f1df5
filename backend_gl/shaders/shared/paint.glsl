// The stack machine of paint programs.
// Requires: fetch.glsl, gradient.glsl, image.glsl, blend.glsl; constants op*, maxStack; LINEAR, RADIAL,
// IMAGE, GROUPS, MIXING, MATERIAL defined as 1 or 0: what the asset's programs contain. Some drivers run
// both sides of every branch, so what cannot occur is left out; and the body of a loop, with all loops in it, once more to
// find that it has ended, unless it is left at the bottom, by a break. Where MATERIAL is 1: materialColor, which
// backend_gl/core/programs.cpp makes.
// Twin of: raster/src/paint.cpp.
// Exports: paintColor.

#if MATERIAL
// Premultiplied colour of a material at a point of its space.
vec4 materialColor(uint material, vec2 p);
#endif

vec4 layerColor(ASSET_IN uint op, uint argument, vec2 point, mat3x2 pixel) {
#if LINEAR || RADIAL
    if (LINEAR == 1 && op == opLinear || RADIAL == 1 && op == opRadial)
        return gradientColor(ASSET RADIAL == 1 && op == opRadial, argument, point, pixel);
#endif
#if IMAGE
    if (op == opImage)
        return imageColor(ASSET argument, point, pixel);
#endif
#if MATERIAL
    if (op == opMaterial) {
        uvec4 a = texelAt(ASSET argument), b = texelAt(ASSET argument + 1u);
        return clamp(materialColor(b.z, applyMatrix(a, b, point)), 0.0, 1.0);
    }
#endif
    return uintBitsToFloat(texelAt(ASSET argument));
}

#if GROUPS

vec4 popped(uvec4 instruction, vec4 source, vec4 backdrop) {
#if MIXING
    if (instruction.x != opPop)
        return backdrop * maskFactor(instruction.x, source);
    return blend(instruction.y, source * uintBitsToFloat(instruction.z), backdrop);
#else
    return over(source * uintBitsToFloat(instruction.z), backdrop);
#endif
}

vec4 runProgram(ASSET_IN uint first, uint count, vec2 point, mat3x2 pixel) {
    vec4 stack[maxStack];
    int top = 0;
    stack[0] = vec4(0.0);
    for (uint i = first; i < first + count; ++i) {
        uvec4 instruction = texelAt(ASSET SECTIONS.w + i);
        if (instruction.x == opPush) {
            stack[++top] = vec4(0.0);
        } else if (instruction.x < opSolid) {
            --top;
            stack[top] = popped(instruction, stack[top + 1], stack[top]);
        } else {
            vec4 source = layerColor(ASSET instruction.x, SECTIONS.w + instruction.w, point, pixel);
            stack[top] = over(source * uintBitsToFloat(instruction.z), stack[top]);
        }
        if (i + 1u == first + count)
            break;
    }
    return stack[top];
}

#else

vec4 runProgram(ASSET_IN uint first, uint count, vec2 point, mat3x2 pixel) {
    vec4 sum = vec4(0.0);
    for (uint i = first; i < first + count; ++i) {
        uvec4 instruction = texelAt(ASSET SECTIONS.w + i);
        vec4 source = layerColor(ASSET instruction.x, SECTIONS.w + instruction.w, point, pixel);
        sum = over(source * uintBitsToFloat(instruction.z), sum);
        if (i + 1u == first + count)
            break;
    }
    return sum;
}

#endif

// Premultiplied colour of a paint at a picture point of a pixel, whose sides and centre, in the picture, are `pixel`.
vec4 paintColor(ASSET_IN uint paint, vec2 point, mat3x2 pixel) {
    uvec4 texel = paintTexel(ASSET paint);
#if LINEAR || RADIAL || IMAGE || GROUPS || MATERIAL
    // Where turns are counted while they are taken, a program's stand in its free word.
    if (isProgram(texel))
        return spend(float(texel.z)) ? runProgram(ASSET texel.x, texel.y, point, pixel) : vec4(0.0);
    return uintBitsToFloat(texel);
#else
    return uintBitsToFloat(texel);
#endif
}
