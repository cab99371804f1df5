// The stack machine of paint programs.
// Requires: fetch.glsl, gradient.glsl, image.glsl, blend.glsl; constants op*, maxStack.
// Twin of: asset/src/paint.cpp.
// Exports: paintColor.

vec4 layerColor(uint op, uint argument, vec2 point) {
    if (op == opSolid)
        return uintBitsToFloat(texelAt(argument));
    if (op == opImage)
        return imageColor(argument, point);
    return gradientColor(op == opRadial, argument, point);
}

vec4 runProgram(uint first, uint count, vec2 point) {
    vec4 stack[maxStack];
    int top = 0;
    stack[0] = vec4(0.0);
    for (uint i = first; i < first + count; ++i) {
        uvec4 instruction = texelAt(sections.w + i);
        float opacity = uintBitsToFloat(instruction.z);
        if (instruction.x == opPush) {
            stack[++top] = vec4(0.0);
        } else if (instruction.x >= opSolid) {
            vec4 source = layerColor(instruction.x, sections.w + instruction.w, point) * opacity;
            stack[top] = over(source, stack[top]);
        } else {
            vec4 source = stack[top--];
            if (instruction.x == opPop)
                stack[top] = blend(instruction.y, source * opacity, stack[top]);
            else
                stack[top] *= maskFactor(instruction.x, source);
        }
    }
    return stack[top];
}

// Premultiplied colour of a paint at a picture point.
vec4 paintColor(uint paint, vec2 point) {
    uvec4 texel = paintAt(paint);
    return isProgram(texel) ? runProgram(texel.x, texel.y, point) : uintBitsToFloat(texel);
}
