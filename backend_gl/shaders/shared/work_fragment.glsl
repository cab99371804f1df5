// Arithmetic and nothing else, to be timed. Twin of backend_gl/core/software_driver.cpp.

uniform int turns;

out vec4 color;

void main() {
    vec4 v = fract(gl_FragCoord.xyxy * vec4(0.37, 0.11, 0.23, 0.71)) * 0.8 + 0.1;
    for (int i = 0; i < turns; ++i)
        v = 3.7 * v * (1.0 - v);
    color = v;
}
