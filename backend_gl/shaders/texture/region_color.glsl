// Paints at one point, each evaluated once while it is one of the last two: the two sides of a chain of pieces.
// Requires: paint.glsl.
// Exports: Recent, nothingRecent, regionColor.

struct Recent {
    uint paint, older;
    vec4 color, olderColor;
};

Recent nothingRecent() { return Recent(0xFFFFFFFFu, 0xFFFFFFFFu, vec4(0.0), vec4(0.0)); }

vec4 regionColor(ASSET_IN inout Recent recent, uint paint, vec2 point, mat3x2 pixel) {
    if (paint != recent.paint) {
        vec4 color = recent.olderColor;
        if (paint != recent.older)
            color = paintColor(ASSET paint, point, pixel);
        recent = Recent(paint, recent.paint, color, recent.color);
    }
    return recent.color;
}
