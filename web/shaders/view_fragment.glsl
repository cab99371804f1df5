// The picture on a plane that is seen in perspective. Follows vtm_sample's include.

uniform Vtm picture;
uniform mat3 toPicture;  // from (pixel, 1) to homogeneous (s, t)
uniform float fade;      // towards white, so that outlines show

out vec4 color;

void main() {
    vec3 stq = toPicture * vec3(gl_FragCoord.xy, 1.0);
    vec4 sampled = vtm_sample_proj(picture, stq);
    if (stq.z <= 0.0)
        sampled = vec4(0.0);  // behind the viewer
    color = mix(sampled, vec4(1.0), fade);
}
