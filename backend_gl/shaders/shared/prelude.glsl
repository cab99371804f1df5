#version 300 es
// First part of every shader. GLSL ES 3.00, so that WebGL 2 runs the same text. Everything highp:
// leaf coordinates need 16 bits and pixel coordinates add their own.
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
