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

bool isInside(const TextContent& content, int element, int ancestor) {
    for (; element >= 0; element = content.elements[static_cast<std::size_t>(element)].parent)
        if (element == ancestor)
            return true;
    return false;
}

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
        for (std::size_t element = content_.elements.size(); element-- > 0;)
            adjustLength(static_cast<int>(element));
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
            cluster.at = (vertical_ ? glm::dvec2(0, pen) : glm::dvec2(pen, 0)) + shifts[cluster.first];
            pen += cluster.advance;
        }
    }

    double along(glm::dvec2 v) const { return vertical_ ? v.y : v.x; }
    glm::dvec2 alongBy(double distance) const {
        return vertical_ ? glm::dvec2(0, distance) : glm::dvec2(distance, 0);
    }

    /// `textLength` of one element, those inside it adjusted already: they move as a whole.
    void adjustLength(int element) {
        const TextElement& text = content_.elements[static_cast<std::size_t>(element)];
        if (!text.textLength)
            return;
        double from = std::numeric_limits<double>::infinity(), to = -from;
        std::size_t gaps = 0;
        int unit = -1;
        const auto inside = [&](const ShapedCluster& cluster) {
            return isInside(content_, cluster.element, element);
        };
        for (const ShapedCluster& cluster : clusters_)
            if (inside(cluster)) {
                from = std::min(from, along(cluster.at));
                to = std::max(to, along(cluster.at) + cluster.advance);
                const int own = adjustedInside(cluster.element, element);
                gaps += own < 0 || own != unit;
                unit = own;
            }
        if (!(to > from) || (gaps < 2 && !text.stretchesGlyphs))
            return;
        const double missing = *text.textLength - (to - from), scale = *text.textLength / (to - from);
        const double step = text.stretchesGlyphs ? 0 : missing / static_cast<double>(gaps - 1);
        double shift = -step;
        bool started = false;
        unit = -1;
        for (ShapedCluster& cluster : clusters_) {
            if (!inside(cluster)) {
                cluster.at += alongBy(started ? missing : 0);
                continue;
            }
            started = true;
            const int own = adjustedInside(cluster.element, element);
            shift += own < 0 || own != unit ? step : 0;
            unit = own;
            if (text.stretchesGlyphs) {
                cluster.at += alongBy((along(cluster.at) - from) * (scale - 1));
                cluster.stretch *= scale;
                cluster.advance *= scale;
                cluster.glyphAdvance *= scale;
            } else {
                cluster.at += alongBy(shift);
            }
        }
    }

    /// The outermost element below `ancestor` and around `element` that has a length of its own; -1: none.
    int adjustedInside(int element, int ancestor) const {
        int found = -1;
        for (; element != ancestor; element = content_.elements[static_cast<std::size_t>(element)].parent)
            if (content_.elements[static_cast<std::size_t>(element)].textLength)
                found = element;
        return found;
    }

    /// x and y: every chunk to where its first character shall stand, and what follows with it; then what
    /// `text-anchor` says.
    void placeChunks() {
        glm::dvec2 shift(0), pathEnd(0);
        int path = -1;
        for (std::size_t first = 0, end = 0; first < clusters_.size(); first = end) {
            while (end < clusters_.size() && clusters_[end].chunk == clusters_[first].chunk)
                ++end;
            const ShapedCluster& start = firstInText(first, end);
            const TextCharacter& character = content_.characters[start.first];
            const glm::dvec2 moved = shiftAt(start.first);
            const int before = std::exchange(path, elementOf(start).path);
            if (path != before)
                shift = (path < 0 ? pathEnd : glm::dvec2(0)) + moved - start.at;
            // On a path there is no place across the line.
            if (character.x && !(path >= 0 && vertical_))
                shift.x = *character.x + moved.x - start.at.x;
            if (character.y && !(path >= 0 && !vertical_))
                shift.y = *character.y + moved.y - start.at.y;
            for (std::size_t i = first; i < end; ++i)
                clusters_[i].at += shift;
            anchor(first, end);
            if (path >= 0)
                pathEnd =
                    endOnPath(first, end, content_.paths[static_cast<std::size_t>(path)]).value_or(pathEnd);
        }
    }

    const ShapedCluster& firstInText(std::size_t first, std::size_t end) const {
        return *std::min_element(clusters_.begin() + static_cast<std::ptrdiff_t>(first),
                                 clusters_.begin() + static_cast<std::ptrdiff_t>(end),
                                 [](const auto& a, const auto& b) { return a.first < b.first; });
    }

    /// Where text that follows a path goes on: behind the last character on it.
    std::optional<glm::dvec2> endOnPath(std::size_t first, std::size_t end, const TextPath& path) const {
        for (std::size_t i = end; i-- > first;)
            if (const auto frame = pathFrame(clusters_[i], path))
                return scene::apply(*frame, {clusters_[i].advance, 0});
        return std::nullopt;
    }

    void anchor(std::size_t first, std::size_t end) {
        double from = std::numeric_limits<double>::infinity(), to = -from;
        for (std::size_t i = first; i < end; ++i) {
            from = std::min(from, along(clusters_[i].at));
            to = std::max(to, along(clusters_[i].at) + clusters_[i].advance);
        }
        const ShapedCluster& start = firstInText(first, end);
        const Style& style = elementOf(start).scope.style;
        const bool rightToLeft = content_.elements.front().scope.style.rightToLeft;
        double place = (from + to) / 2;
        if (style.anchor != TextAnchor::Middle)
            place = (style.anchor == TextAnchor::Start) == rightToLeft ? to : from;
        const glm::dvec2 shift = alongBy(along(start.at) - place);
        for (std::size_t i = first; i < end; ++i)
            clusters_[i].at += shift;
    }

    /// The frame of a cluster on the straight line: at its element's baseline, turned by `rotate`.
    scene::Affine lineFrame(const ShapedCluster& cluster) const {
        const double degrees = content_.characters[cluster.first].rotate + (vertical_ ? 90 : 0);
        const double down = fontOf(cluster).baseline();
        const glm::dvec2 at = cluster.at + (vertical_ ? glm::dvec2(-down, 0) : glm::dvec2(0, down));
        return scene::compose(scene::translation(at.x, at.y), rotation(degrees));
    }

    /// The frame on the cluster's path; nothing beyond the path's ends.
    std::optional<scene::Affine> pathFrame(const ShapedCluster& cluster, const TextPath& path) const {
        const double length = path.measure.length();
        double middle = along(cluster.at) + path.startOffset + cluster.glyphAdvance / 2;
        if (!(length > 0))
            return std::nullopt;
        if (path.measure.closed() && middle >= -length && middle <= 2 * length)
            middle -= std::floor(middle / length) * length;
        if (!(middle >= 0 && middle <= length))
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
