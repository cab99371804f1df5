// The recursion of the paper mode as a loop: weights flow down the graph of nodes (rows 4, 5, 14).
// Requires: paint.glsl, paper_mask.glsl; constants paperPending, paperNone, paperBounds.
// Twin of: paper/evaluate/evaluate.cpp.

uniform vec4 pixelToPicture;  // linear part, by columns
uniform vec4 pictureAnchor;   // a picture point and the pixel position that shows it
uniform vec2 pictureSize;
uniform uint rootNode;

out vec4 color;

// Nodes that still have a share of the pixel, smallest index first.
uint pendingNode[paperPending];
float pendingWeight[paperPending];
int pendingCount = 0;

void addPending(uint node, float weight) {
    int at = pendingCount;
    while (at > 0 && pendingNode[at - 1] > node)
        --at;
    if (at > 0 && pendingNode[at - 1] == node) {
        pendingWeight[at - 1] += weight;
        return;
    }
    for (int i = pendingCount; i > at; --i) {
        pendingNode[i] = pendingNode[i - 1];
        pendingWeight[i] = pendingWeight[i - 1];
    }
    pendingNode[at] = node;
    pendingWeight[at] = weight;
    ++pendingCount;
}

float frameCoverage(vec2 point) {
    vec2 inside = min(point, pictureSize - point);
    vec2 distances = inside / vec2(length(pixelNormals[0]), length(pixelNormals[1]));
    return clamp(0.5 + min(distances.x, distances.y), 0.0, 1.0);
}

// Whether masks within these bounds may cover something of the pixel.
bool isNear(uvec2 corners, vec2 point) {
    vec2 unit = pictureSize / 65535.0, reach = vec2(2.0 * pixelLonger);
    vec2 lower = unit * vec2(low(corners.x), high(corners.x)) - reach;
    vec2 upper = unit * vec2(low(corners.y), high(corners.y)) + reach;
    return all(greaterThan(point, lower)) && all(lessThan(point, upper));
}

void main() {
    vec2 d = gl_FragCoord.xy - pictureAnchor.zw;
    vec2 point = pictureAnchor.xy + pixelToPicture.xy * d.x + pixelToPicture.zw * d.y;
    float frame = frameCoverage(point);
    if (frame == 0.0)
        discard;
    vec4 sum = vec4(0.0);
    bool discards = false, shows = false;
    addPending(rootNode, 1.0);
    while (pendingCount > 0) {
        --pendingCount;
        float weight = pendingWeight[pendingCount];
        uint node = paperSections.y + 2u * pendingNode[pendingCount];
        uvec4 inside = dataAt(node), outside = dataAt(node + 1u);
        float b = uintBitsToFloat(inside.y);
        if (inside.x == paperBounds)
            b = isNear(outside.xy, point) ? 1.0 : 0.0;
        else if (b > 0.0 && inside.x != paperNone)
            b *= maskCoverage(inside.x, point);
        for (int i = 0; i < 2; ++i) {
            float share = weight * (i == 0 ? b : 1.0 - b);
            uvec2 side = i == 0 ? inside.zw : outside.zw;
            if (share <= 0.0)
                continue;
            if (side.x == paperNone) {
                discards = true;
                continue;
            }
            float through = 1.0;
            if (side.x != 0u) {
                vec4 shade = paintColor(side.x, point, mat3x2(pixelToPicture, point));
                sum += share * shade;
                through = 1.0 - shade.a;
            }
            shows = true;
            if (side.y != paperNone && through > 0.0)
                addPending(side.y, share * through);
        }
    }
    if (discards && !shows)
        discard;
    color = sum * frame;
}
