// Colour spaces and premultiplied colours (specification section 3.4). Requires: nothing.
// Twin of: api/openvg/paint/color.cpp. Exports: exactly, premultiplied, unpremultiplied, encoded, decoded, converted, respaced.

// Bytes hold numbers of channels with fewer levels up to a rounding.
vec4 exactly(vec4 c, vec4 levelsOfChannels) {
    return levelsOfChannels == vec4(255.0) ? c : floor(c * levelsOfChannels + 0.5) / levelsOfChannels;
}

vec4 premultiplied(vec4 c) { return vec4(c.rgb * c.a, c.a); }
// Colours are clamped to [0, alpha] first, and 0 where alpha is.
vec4 unpremultiplied(vec4 c) { return c.a > 0.0 ? vec4(clamp(c.rgb, 0.0, c.a) / c.a, c.a) : vec4(0.0); }

vec4 encoded(vec4 c) {
    vec3 x = max(c.rgb, 0.0);
    vec3 curve = 1.0556 * pow(max(x, 1e-9), vec3(1.0 / 2.4)) - 0.0556;
    return vec4(mix(curve, 12.92 * x, vec3(lessThanEqual(x, vec3(0.00304)))), c.a);
}
vec4 decoded(vec4 c) {
    vec3 x = max(c.rgb, 0.0);
    vec3 curve = pow((x + 0.0556) / 1.0556, vec3(2.4));
    return vec4(mix(curve, x / 12.92, vec3(lessThanEqual(x, vec3(0.03928)))), c.a);
}

// Not premultiplied, from one space to another; spaces are (linear, luminance).
vec4 converted(vec4 c, ivec2 from, ivec2 to) {
    if (from == to)
        return c;
    bool isLinear = from.x != 0, toGrey = to.y != 0 && from.y == 0;
    if (!isLinear && (toGrey || to.x != 0)) {
        c = decoded(c);
        isLinear = true;
    }
    if (toGrey)
        c.rgb = vec3(dot(c.rgb, vec3(0.2126, 0.7152, 0.0722)));
    return isLinear && to.x == 0 ? encoded(c) : c;
}

// The same, premultiplied or not.
vec4 respaced(vec4 c, ivec2 from, bool isPremultiplied, ivec2 to, bool toPremultiplied) {
    if (from == to && isPremultiplied == toPremultiplied)
        return c;
    c = converted(isPremultiplied ? unpremultiplied(c) : c, from, to);
    return toPremultiplied ? premultiplied(c) : c;
}
