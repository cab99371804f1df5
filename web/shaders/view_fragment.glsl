// The picture on a plane that is seen in perspective. Follows vtm_sample's include.

uniform Vtm picture;
uniform mat3 toPicture;  // from (pixel, 1) to homogeneous (s, t)
uniform float fade;      // towards white, so that outlines show

out vec4 color;

void main() {
    vec3 stq = toPicture * vec3(gl_FragCoord.xy, 1.0);
    color = vec4(0.0);
    if (stq.z <= 0.0)
        return;  // behind the viewer
    // One parallelogram a pixel: it is off where the horizon is nearer than 64 pixels, and no picture goes so far.
    vec2 st = stq.xy / stq.z;
    vec2 dx = (toPicture[0].xy - st * toPicture[0].z) / stq.z, dy = (toPicture[1].xy - st * toPicture[1].z) / stq.z;
    color = mix(vtm_sample_grad(picture, st, dx, dy), vec4(1.0), fade);
}
