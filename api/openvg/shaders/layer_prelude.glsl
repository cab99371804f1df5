// First part of every shader, after the version and the macros of its program. GLSL ES 3.00; without FETCHES
// it is WebGL 2's too.
#ifdef FETCHES
#extension GL_EXT_shader_framebuffer_fetch : require
#endif
precision highp float;
precision highp int;
precision highp sampler2D;

// Of each drawing call. Twin of: struct LayerBlock in api/openvg/gl/batch.hpp, which says what is in them.
struct TexelBlock {
    ivec4 area, how, base;
    vec4 map[3];
    vec4 fill, levels;
};
layout(std140) uniform LayerBlock {
    ivec4 frame;
    vec4 levels;
    ivec4 surface;
    ivec4 conversion;
    vec4 scale, bias;
    vec4 field[3];
    vec4 radial;
    ivec4 ramp;
    TexelBlock texels[2];
    vec4 matrix[4];
    vec4 added;
    ivec4 transform;
};
