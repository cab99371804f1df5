// The paper's Hermite function (row 1). Requires: nothing. Twin of: paper/evaluate/cell.cpp.
// Exports: hermite.

// t(u) = mA u (1 - u)² - mB u² (1 - u) and its slope, continued along its end tangents. Without branches, since some
// drivers run both sides of every one.
vec2 hermite(vec2 m, float u) {
    float c = clamp(u, 0.0, 1.0), w = 1.0 - c;
    float slope = m.x * w * (1.0 - 3.0 * c) - m.y * c * (2.0 - 3.0 * c);
    return vec2((m.x * w - m.y * c) * c * w + slope * (u - c), slope);
}
