// The recursion of the paper mode as a loop: weights flow down the graph of nodes (rows 4, 5, 14).
// Requires: paint.glsl, paper_mask.glsl; SURFACE defined as 1 or 0; constants paperPending, paperNone, paperBounds.
// Twin of: paper/evaluate/evaluate.cpp.

#if SURFACE
in vec2 st;                   // in pictures, which repeat
#else
uniform vec4 pixelToPicture;  // linear part, by columns
uniform vec4 pictureAnchor;   // a picture point and the pixel position that shows it
#endif
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

#if !SURFACE
float frameCoverage(vec2 point) {
    vec2 inside = min(point, pictureSize - point);
    vec2 distances = inside / vec2(length(pixelNormals[0]), length(pixelNormals[1]));
    return clamp(0.5 + min(distances.x, distances.y), 0.0, 1.0);
}
#endif

// Whether masks within these bounds may cover something of the pixel.
bool isNear(uvec2 corners, vec2 point) {
    vec2 unit = pictureSize / 65535.0, reach = vec2(2.0 * pixelLonger);
    vec2 lower = unit * vec2(low(corners.x), high(corners.x)) - reach;
    vec2 upper = unit * vec2(low(corners.y), high(corners.y)) + reach;
    return all(greaterThan(point, lower)) && all(lessThan(point, upper));
}

// What a node shows in a share of the pixel: a paint (paperNone: nothing is written) over another node.
struct Side {
    uint paint, rest;
    float share;
};

// Takes the node of the largest index: a side that has a share, and the other one, which may have none.
void visit(vec2 point, out Side first, out Side second) {
    --pendingCount;
    float weight = pendingWeight[pendingCount];
    uint node = paperSections.y + 2u * pendingNode[pendingCount];
    uvec4 inside = dataAt(node), outside = dataAt(node + 1u);
    float b = uintBitsToFloat(inside.y);
    if (inside.x == paperBounds)
        b = isNear(outside.xy, point) ? 1.0 : 0.0;
    else if (b > 0.0 && inside.x != paperNone)
        b *= maskCoverage(inside.x, point);
    first = Side(inside.z, inside.w, weight * b);
    second = Side(outside.z, outside.w, weight * (1.0 - b));
    if (first.share <= 0.0) {
        first = second;
        second.share = 0.0;
    }
}

void main() {
#if SURFACE
    // To first order a pixel of a surface is one of a view.
    vec4 pixelToPicture = vec4(dFdx(st), dFdy(st)) * pictureSize.xyxy;
    pixelNormals = transpose(mat2(pixelToPicture.xy, pixelToPicture.zw));
    pixelLonger = max(length(pixelToPicture.xy), length(pixelToPicture.zw));
    vec2 point = fract(st) * pictureSize;
    const float frame = 1.0;
#else
    vec2 d = gl_FragCoord.xy - pictureAnchor.zw;
    vec2 point = pictureAnchor.xy + pixelToPicture.xy * d.x + pixelToPicture.zw * d.y;
    float frame = frameCoverage(point);
    if (frame == 0.0)
        discard;
#endif
    vec4 sum = vec4(0.0);
    bool discards = false, shows = false;
    Side side, other = Side(0u, paperNone, 0.0);
    addPending(rootNode, 1.0);
    // A paint a turn: drivers that run all of a loop's body for every pixel of a block do not paint at each node.
    bool found = true;
    while (found) {
        found = false;
        while (!found && (other.share > 0.0 || pendingCount > 0)) {
            if (other.share > 0.0) {
                side = other;
                other.share = 0.0;
            } else {
                visit(point, side, other);
            }
            discards = discards || side.paint == paperNone;
            shows = shows || side.paint != paperNone;
            found = side.paint != 0u && side.paint != paperNone;
            if (side.paint == 0u && side.rest != paperNone)
                addPending(side.rest, side.share);
        }
        if (found) {
            vec4 shade = paintColor(side.paint, point, mat3x2(pixelToPicture, point));
            sum += side.share * shade;
            if (side.rest != paperNone && shade.a < 1.0)
                addPending(side.rest, side.share * (1.0 - shade.a));
        }
    }
    if (discards && !shows)
        discard;
    color = sum * frame;
}
