// Any entry whose paints include programs. Requires: leaf_placement.glsl, fetch.glsl, paint.glsl.

out vec4 color;

// The last two paints evaluated: the two sides of a chain of pieces.
uint recentPaint = 0xFFFFFFFFu, olderPaint = 0xFFFFFFFFu;
vec4 recentColor = vec4(0.0), olderColor = vec4(0.0);

vec4 regionColor(uint paint, vec2 point) {
    if (paint == recentPaint)
        return recentColor;
    uint swappedPaint = recentPaint;
    vec4 swappedColor = recentColor;
    recentColor = paint == olderPaint ? olderColor : paintColor(paint, point);
    recentPaint = paint;
    olderPaint = swappedPaint;
    olderColor = swappedColor;
    return recentColor;
}

uvec4 leafTexel() {
    uint payload = leafEntry >> 2;
    if ((leafEntry & 3u) == kindSolid)
        return uvec4(0u, 0u, uvec2(payload | payload << 16));
    return texelAt(sections.x + payload);
}

uint cornerPaint(uvec4 leaf, uint k) {
    uint word = k < 2u ? leaf.z : leaf.w;
    return (k & 1u) == 0u ? low(word) : high(word);
}

// One loop over the four corners and both sides of every piece, so that the paint interpreter, which
// compilers inline, stands in the program once.
void main() {
    Frame frame = leafFrame();
    Overlap overlap = overlapOf(frame);
    if (overlap.empty)
        discard;
    vec2 point = picturePoint(overlap);
    uvec4 leaf = leafTexel(), piece = uvec4(0u);
    vec4 sum = vec4(0.0);
    float weight = 0.0;
    uint terms = 4u + 2u * low(leaf.y);
    for (uint i = 0u; i < terms; ++i) {
        uint paint = high(piece.w);
        if (i < 4u) {
            weight = seg(cornerOf(frame, int(i)), cornerOf(frame, int((i + 1u) & 3u)));
            paint = cornerPaint(leaf, i);
        } else if ((i & 1u) == 0u) {
            piece = texelAt(sections.y + leaf.x + (i - 4u) / 2u);
            weight = pieceSum(frame, piece);
            paint = low(piece.w);
        } else {
            weight = -weight;
        }
        if (weight != 0.0)
            sum += weight * regionColor(paint, point);
    }
    color = leafOrigin.z * sum;
}
