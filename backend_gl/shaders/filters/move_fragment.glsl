// Primitives that show their input elsewhere. Requires: layer.glsl, store.glsl, colors.glsl; constants variant, the
// primitive, primitive*.
// Twin of: raster/filter/move.cpp.

uniform vec2 by;                  // Offset: pixels; DisplacementMap: pixels for a colour of 1 less than one of 0
uniform vec4 channelX, channelY;  // DisplacementMap: 1 in the one that is read
uniform vec4 tile;                // its corner, from the result's first pixel's; its size
uniform vec2 tilePhase;           // from a tile's corner to the result's first pixel's

vec4 displaced(ivec2 p) {
    vec4 map = straightened(secondAt(p));
    return firstBetween(vec2(p) + 0.5 + by * (vec2(dot(map, channelX), dot(map, channelY)) - 0.5));
}

vec4 tiled(ivec2 p) {
    vec2 v = tilePhase + vec2(p) + 0.5;
    return firstAt(ivec2(floor(tile.xy + v - tile.zw * floor(v / tile.zw))));
}

void main() {
    ivec2 p = pixel();
    store(variant == primitiveOffset ? firstBetween(vec2(p) + 0.5 - by)
                                       : variant == primitiveTile ? tiled(p) : displaced(p));
}
