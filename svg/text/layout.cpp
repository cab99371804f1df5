#include "svg/text/layout.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "svg/geometry/transform.hpp"
#include "svg/text/chunks.hpp"
#include "svg/text/decoration.hpp"
#include "svg/text/element_font.hpp"

namespace vtm::svg {
namespace {

/// The steps of SVG 2 section 11.5 in their order, on clusters in the order in which they stand on the line.
/// Along: the direction of the line; across: down from it, or left of it where it is vertical.
class Layout {
public:
    Layout(const TextContent& content, text::FontSet& fonts)
        : content_(content),
          fonts_(elementFonts(content.elements, fonts)),
          vertical_(content.elements.front().scope.style.writingMode != WritingMode::Horizontal),
          clusters_(shapeChunks(content, fonts_, fonts, vertical_)) {}

    TextLayout run() {
        placeOnOneLine();
        adjustLengths(content_, clusters_, vertical_);
        placeChunks();
        TextLayout layout;
        for (const ShapedCluster& cluster : clusters_)
            place(cluster, layout);
        layout.lines = decorationLines(content_, fonts_, layout.clusters, vertical_);
        return layout;
    }

private:
    const TextElement& elementOf(const ShapedCluster& cluster) const {
        return content_.elements[static_cast<std::size_t>(cluster.element)];
    }
    const ElementFont& fontOf(const ShapedCluster& cluster) const {
        return fonts_[static_cast<std::size_t>(cluster.element)];
    }
    glm::dvec2 shiftAt(std::size_t character) const {
        return {content_.characters[character].dx, content_.characters[character].dy};
    }

    /// Advances in visual order, then dx and dy summed in logical order.
    void placeOnOneLine() {
        std::vector<glm::dvec2> shifts;
        glm::dvec2 sum(0);
        for (std::size_t i = 0; i < content_.characters.size(); ++i)
            shifts.push_back(sum += shiftAt(i));
        double pen = 0;
        for (ShapedCluster& cluster : clusters_) {
            cluster.at = alongBy(pen) + shifts[cluster.first];
            pen += cluster.advance + cluster.trailing;
        }
    }

    double along(glm::dvec2 v) const { return vertical_ ? v.y : v.x; }
    glm::dvec2 alongBy(double distance) const {
        return vertical_ ? glm::dvec2(0, distance) : glm::dvec2(distance, 0);
    }

    /// x and y: every chunk to where its first character shall stand, and what follows goes on from its end;
    /// then what `text-anchor` says.
    void placeChunks() {
        const bool toLeft = !vertical_ && content_.elements.front().scope.style.rightToLeft;
        glm::dvec2 shift(0), pathEnd(0);
        double chunkEnd = 0;  // on the line
        int path = -1;
        for (std::size_t first = 0, end = 0; first < clusters_.size(); first = end) {
            while (end < clusters_.size() && clusters_[end].chunk == clusters_[first].chunk)
                ++end;
            const ShapedCluster& start = firstInText(first, end);
            const TextCharacter& character = content_.characters[start.first];
            const glm::dvec2 moved = shiftAt(start.first);
            const glm::dvec2 begin = beginOf(first, end, start, toLeft);
            if (toLeft)
                shift += alongBy(chunkEnd - along(begin) + along(moved));
            const int before = std::exchange(path, elementOf(start).path);
            if (path != before)
                shift = (path < 0 ? pathEnd : glm::dvec2(0)) + moved - begin;
            // On a path there is no place across the line.
            if (character.x && !(path >= 0 && vertical_))
                shift.x = *character.x + moved.x - begin.x;
            if (character.y && !(path >= 0 && !vertical_))
                shift.y = *character.y + moved.y - begin.y;
            chunkEnd = along(clusters_[first].at);
            for (std::size_t i = first; i < end; ++i)
                clusters_[i].at += shift;
            anchor(first, end, elementOf(start).scope.style, along(begin + shift));
            if (path >= 0)
                pathEnd = endOf(content_.paths[static_cast<std::size_t>(path)]).value_or(pathEnd);
        }
    }

    /// Where a chunk begins on the line: at its left end whatever its letters' direction, in lines from right
    /// to left at its right end. Across the line its first character counts.
    glm::dvec2 beginOf(std::size_t first, std::size_t end, const ShapedCluster& start, bool toLeft) const {
        const double place =
            toLeft ? along(clusters_[end - 1].at) + clusters_[end - 1].advance : along(clusters_[first].at);
        return start.at + alongBy(place - along(start.at));
    }

    const ShapedCluster& firstInText(std::size_t first, std::size_t end) const {
        return *std::min_element(clusters_.begin() + static_cast<std::ptrdiff_t>(first),
                                 clusters_.begin() + static_cast<std::ptrdiff_t>(end),
                                 [](const auto& a, const auto& b) { return a.first < b.first; });
    }

    /// Where text that follows a path goes on; nothing where the path has no length.
    static std::optional<glm::dvec2> endOf(const TextPath& path) {
        const double length = path.measure.length();
        return length > 0 ? std::optional(path.measure.at(path.right ? 0 : length).at) : std::nullopt;
    }

    /// The right end of text is where it is anchored, unless the middle is.
    static bool startsAtRight(const Style& style) {
        return (style.anchor == TextAnchor::Start) == style.rightToLeft;
    }

    void anchor(std::size_t first, std::size_t end, const Style& style, double begin) {
        double from = std::numeric_limits<double>::infinity(), to = -from;
        for (std::size_t i = first; i < end; ++i) {
            from = std::min(from, along(clusters_[i].at));
            to = std::max(to, along(clusters_[i].at) + clusters_[i].advance);
        }
        double place = (from + to) / 2;
        if (style.anchor != TextAnchor::Middle)
            place = startsAtRight(style) ? to : from;
        for (std::size_t i = first; i < end; ++i)
            clusters_[i].at += alongBy(begin - place);
    }

    /// The frame of a cluster on the straight line: at its element's baseline, turned by `rotate`.
    scene::Affine lineFrame(const ShapedCluster& cluster) const {
        const double degrees = content_.characters[cluster.first].rotate + (vertical_ ? 90 : 0);
        const double down = fontOf(cluster).baseline();
        const glm::dvec2 at = cluster.at + (vertical_ ? glm::dvec2(-down, 0) : glm::dvec2(0, down));
        return scene::compose(scene::translation(at.x, at.y), rotation(degrees));
    }

    /// Text goes round a closed path once: from its start, to its end or to both sides. `circuits`: how far
    /// from startOffset.
    static bool isOnCircuit(double circuits, const Style& style) {
        const double first = style.anchor == TextAnchor::Middle ? -0.5 : startsAtRight(style) ? -1 : 0;
        return circuits >= first && circuits <= first + 1;
    }

    /// The frame on the cluster's path; nothing beyond the path's ends.
    std::optional<scene::Affine> pathFrame(const ShapedCluster& cluster, const TextPath& path) const {
        const double length = path.measure.length();
        const double onLine = along(cluster.at) + cluster.glyphAdvance / 2;
        double middle = onLine + path.startOffset;
        if (!(length > 0))
            return std::nullopt;
        if (path.measure.closed() && isOnCircuit(onLine / length, elementOf(cluster).scope.style))
            middle -= std::floor(middle / length) * length;
        else if (path.measure.closed() || !(middle >= 0 && middle <= length))
            return std::nullopt;
        PathMeasure::Place place = path.measure.at(path.right ? length - middle : middle);
        if (path.right)
            place.direction = -place.direction;
        const glm::dvec2 down(-place.direction.y, place.direction.x);
        const glm::dvec2 origin =
            place.at - place.direction * (cluster.glyphAdvance / 2) +
            down * (fontOf(cluster).baseline() + (vertical_ ? -cluster.at.x : cluster.at.y));
        const scene::Affine frame{place.direction.x, place.direction.y, down.x, down.y, origin.x, origin.y};
        return scene::compose(frame, rotation(content_.characters[cluster.first].rotate));
    }

    void place(const ShapedCluster& cluster, TextLayout& layout) const {
        const int path = elementOf(cluster).path;
        const std::optional<scene::Affine> frame =
            path < 0 ? lineFrame(cluster)
                     : pathFrame(cluster, content_.paths[static_cast<std::size_t>(path)]);
        if (!frame)
            return;
        const ElementFont& font = fontOf(cluster);
        PlacedCluster placed{cluster.element, cluster.first, cluster.count, {}, *frame, {}};
        // The central baseline of vertical text is its alphabetic one turned, so far above it.
        const double baseline = vertical_ ? font.central() : 0;
        placed.cell.add({0, baseline - font.ascent()});
        placed.cell.add({cluster.advance, baseline + font.descent()});
        double pen = 0;
        for (const text::Glyph& glyph : cluster.glyphs) {
            const double unit = font.size / glyph.font->unitsPerEm();
            scene::Affine inLine = scene::scaling(cluster.stretch, 1);
            if (vertical_ && !cluster.sideways)  // stands upright: the frame's turn is taken back
                inLine = scene::compose(inLine, scene::compose(scene::translation(pen, 0), rotation(-90)));
            else
                inLine = scene::compose(inLine, scene::translation(pen, baseline));
            inLine = scene::compose(inLine, scene::translation(glyph.x * font.size, glyph.y * font.size));
            placed.glyphs.push_back(
                {glyph.font, glyph.id,
                 scene::compose(*frame, scene::compose(inLine, scene::scaling(unit, unit))), cluster.first});
            pen += glyph.advance * font.size;
        }
        layout.clusters.push_back(std::move(placed));
    }

    const TextContent& content_;
    const std::vector<ElementFont> fonts_;
    const bool vertical_;
    std::vector<ShapedCluster> clusters_;
};

}  // namespace

TextLayout layOut(const TextContent& content, text::FontSet& fonts) {
    if (content.characters.empty())
        return {};
    return Layout(content, fonts).run();
}

}  // namespace vtm::svg
