// Light on a surface whose height is the first input's alpha.
// Requires: layer.glsl, store.glsl, colors.glsl, numbers.glsl; constants light*. Twin of: raster/filter/lighting.cpp.

uniform ivec4 region;         // of the input: min, max, in the result's pixels
uniform vec3 position, axis;  // of a light: where it is, and where a spot's points
uniform bool isLight;

float alphaAt(int x, int y) { return firstAt(ivec2(x, y)).a; }

// Sobel's kernels, and those of the specification's table at the border of the input's region.
vec3 normalAt(ivec2 p, float scale) {
    int left = p.x > region.x ? -1 : 0, right = p.x < region.z - 1 ? 1 : 0;
    int top = p.y > region.y ? -1 : 0, bottom = p.y < region.w - 1 ? 1 : 0;
    vec2 slope = vec2(0.0), weight = vec2(0.0);
    for (int dy = top; dy <= bottom; ++dy) {
        float w = dy == 0 ? 2.0 : 1.0;
        slope.x += w * (alphaAt(p.x + right, p.y + dy) - alphaAt(p.x + left, p.y + dy));
        weight.x += w;
    }
    for (int dx = left; dx <= right; ++dx) {
        float w = dx == 0 ? 2.0 : 1.0;
        slope.y += w * (alphaAt(p.x + dx, p.y + bottom) - alphaAt(p.x + dx, p.y + top));
        weight.y += w;
    }
    // The table's factors: differences over two pixels, the mean of them.
    vec2 factor = 2.0 / (weight * max(vec2(1.0), vec2(right - left, bottom - top)));
    return normalize(vec3(-scale * factor * slope, 1.0));
}

// To the light, from a place of the surface.
vec3 directionFrom(vec3 place, uint kind) {
    if (kind == lightDistant) {
        float azimuth = radians(number(8u)), elevation = radians(number(9u));
        return vec3(cos(azimuth) * cos(elevation), sin(azimuth) * cos(elevation), sin(elevation));
    }
    vec3 to = position - place;
    float distance = length(to);
    return distance > 0.0 ? to / distance : vec3(0.0, 0.0, 1.0);
}

// Of the light that comes from direction `to`, so many pixels away.
float shareOfLight(vec3 to, float distance, uint kind) {
    if (kind != lightSpot)
        return 1.0;
    float along = -dot(to, axis);
    if (along <= 0.0)
        return 0.0;
    float power = pow(along, number(14u)), cone = abs(number(15u));
    if (cone >= 180.0)
        return power;
    // The cone's border is smoothed over a pixel: so much the cosine changes from one to the next.
    float sine = sqrt(max(0.0, 1.0 - along * along));
    float smoothing = max(sine / max(distance, 1.0), 1.0e-6);
    return power * clamp((along - cos(radians(cone))) / smoothing + 0.5, 0.0, 1.0);
}

void main() {
    ivec2 p = pixel();
    bool specular = number(0u) != 0.0;
    float scale = number(1u);
    uint kind = uint(number(7u));
    vec3 color = vec3(number(4u), number(5u), number(6u));
    if (isLight)
        color = linearLight(color);
    vec3 normal = normalAt(p, scale), place = vec3(vec2(p) + 0.5, scale * alphaAt(p.x, p.y));
    vec3 to = directionFrom(place, kind);
    float amount = max(0.0, dot(normal, to));
    if (specular) {
        vec3 halfway = to + vec3(0.0, 0.0, 1.0);
        float size = length(halfway), along = size > 0.0 ? dot(normal, halfway) / size : 0.0;
        amount = along > 0.0 ? pow(along, number(3u)) : 0.0;
    }
    float share = shareOfLight(to, length(position - place), kind);
    vec3 lit = clamp(number(2u) * amount * share * color, 0.0, 1.0);
    store(vec4(lit, specular ? max(lit.r, max(lit.g, lit.b)) : 1.0));
}
