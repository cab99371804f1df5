// Squares of the plane, as triangles of whole patches or runs of them.
// Exports, flat: what patch_fragment.glsl and patch_programs_fragment.glsl need to know of the patch.

layout(location = 0) in vec2 position;  // pixels
layout(location = 1) in vec2 origin;    // the patch's least corner, pixels
layout(location = 2) in uvec3 texelsOf;  // first texel, first cell; 1 + paint of a patch without texels, else 0
layout(location = 3) in vec4 picture;   // the least corner in picture coordinates; z: picture units a patch

uniform vec2 targetSize;

flat out vec2 patchOrigin;
flat out uvec3 patchTexels;
flat out vec4 patchPicture;

void main() {
    gl_Position = vec4(position / targetSize * 2.0 - 1.0, 0.0, 1.0);
    patchOrigin = origin;
    patchTexels = texelsOf;
    patchPicture = picture;
}
