#include "svg/text/chunks.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace vtm::svg {
namespace {

/// The control characters around an element's text. Source: CSS Writing Modes 4 section 2.4.2.
struct Controls {
    std::u32string_view open, close;
};

Controls controlsOf(const Style& style) {
    const bool rtl = style.rightToLeft;
    switch (style.unicodeBidi) {
        case UnicodeBidi::Normal:
            break;
        case UnicodeBidi::Embed:
            return {rtl ? U"\u202b" : U"\u202a", U"\u202c"};
        case UnicodeBidi::Isolate:
            return {rtl ? U"\u2067" : U"\u2066", U"\u2069"};
        case UnicodeBidi::Override:
            return {rtl ? U"\u202e" : U"\u202d", U"\u202c"};
        case UnicodeBidi::IsolateOverride:
            return {rtl ? U"\u2068\u202e" : U"\u2068\u202d", U"\u202c\u2069"};
        case UnicodeBidi::Plaintext:
            return {U"\u2068", U"\u2069"};
    }
    return {};
}

/// Makes the line of one chunk, and remembers which of its characters are the content's.
class LineBuilder {
public:
    static constexpr std::size_t control = static_cast<std::size_t>(-1);

    LineBuilder(const TextContent& content, const std::vector<ElementFont>& fonts, bool vertical)
        : content_(content), fonts_(fonts) {
        line_.rightToLeft = content.elements.front().scope.style.rightToLeft;
        line_.vertical = vertical;
    }

    void add(std::size_t index) {
        const TextCharacter& character = content_.characters[index];
        enter(character.element);
        append(character.code, index, character.element);
    }
    /// Closes all elements. The line's characters were [first, end) of the content.
    void finish(std::size_t first, std::size_t end) {
        leaveTo(0);
        for (std::size_t i = first; i > 0 && first - i < maxJoined && joinsBefore(i); --i)
            line_.before.insert(line_.before.begin(), content_.characters[i - 1].code);
        for (std::size_t i = end; i < content_.characters.size() && i - end < maxJoined && joinsBefore(i);
             ++i)
            line_.after.push_back(content_.characters[i].code);
    }

    const text::Line& line() const { return line_; }
    /// The content's character behind one of the line's, or `control`.
    std::size_t origin(std::size_t position) const { return origins_[position]; }

private:
    /// A letter joins with the next one, perhaps over marks.
    static constexpr std::size_t maxJoined = 5;

    /// Letters join over positions, but not with an element that begins another line: `tspan` elements are
    /// lines as a rule, without white space between them.
    bool joinsBefore(std::size_t index) const {
        const TextCharacter& character = content_.characters[index];
        const int before = content_.characters[index - 1].element;
        const bool moves =
            line_.vertical ? character.x || character.dx != 0 : character.y || character.dy != 0;
        return character.element == before || !moves;
    }

    void enter(int element) {
        std::vector<int> chain;  // outermost last
        for (int e = element; e >= 0; e = content_.elements[static_cast<std::size_t>(e)].parent)
            chain.push_back(e);
        std::size_t shared = 0;
        while (shared < open_.size() && shared < chain.size() &&
               open_[shared] == chain[chain.size() - 1 - shared])
            ++shared;
        leaveTo(shared);
        for (std::size_t i = shared; i < chain.size(); ++i) {
            const int opened = chain[chain.size() - 1 - i];
            open_.push_back(opened);
            appendControls(controls(opened).open, opened);
        }
    }

    void leaveTo(std::size_t depth) {
        while (open_.size() > depth) {
            appendControls(controls(open_.back()).close, open_.back());
            open_.pop_back();
        }
    }

    Controls controls(int element) const {
        return controlsOf(content_.elements[static_cast<std::size_t>(element)].scope.style);
    }

    void appendControls(std::u32string_view text, int element) {
        for (const char32_t code : text)
            append(code, control, element);
    }

    void append(char32_t code, std::size_t origin, int element) {
        if (line_.spans.empty() || element != spanElement_)
            line_.spans.push_back(spanOf(element));
        spanElement_ = element;
        line_.text.push_back(code);
        origins_.push_back(origin);
        line_.spans.back().end = line_.text.size();
    }

    text::Span spanOf(int element) const {
        const ElementFont& font = fonts_[static_cast<std::size_t>(element)];
        const TextElement& text = content_.elements[static_cast<std::size_t>(element)];
        return {0, font.query, font.features, text.language, text.scope.style.textOrientation};
    }

    const TextContent& content_;
    const std::vector<ElementFont>& fonts_;
    text::Line line_;
    std::vector<std::size_t> origins_;
    std::vector<int> open_;
    int spanElement_ = -1;
};

bool startsChunk(const TextContent& content, std::size_t index) {
    const TextCharacter& character = content.characters[index];
    if (index == 0)
        return true;
    const auto path = [&](std::size_t i) {
        return content.elements[static_cast<std::size_t>(content.characters[i].element)].path;
    };
    return path(index) != path(index - 1) || character.x || character.y;
}

bool isWordSeparator(char32_t code) { return code == ' ' || code == 0xa0; }

/// Nothing for clusters of control characters alone.
std::optional<ShapedCluster> fromLine(text::Cluster& cluster, const LineBuilder& builder,
                                      const TextContent& content, const std::vector<ElementFont>& fonts,
                                      std::size_t chunk) {
    ShapedCluster made;
    for (std::size_t i = cluster.first; i < cluster.first + cluster.count; ++i)
        if (const std::size_t origin = builder.origin(i); origin != LineBuilder::control) {
            made.first = made.count == 0 ? origin : made.first;
            made.count = origin - made.first + 1;
        }
    if (made.count == 0)
        return std::nullopt;
    const TextCharacter& character = content.characters[made.first];
    const TextElement& element = content.elements[static_cast<std::size_t>(character.element)];
    made.element = character.element;
    made.chunk = chunk;
    made.glyphs = std::move(cluster.glyphs);
    made.sideways = cluster.sideways;
    made.glyphAdvance = cluster.advance * fonts[static_cast<std::size_t>(character.element)].size;
    made.advance = made.glyphAdvance + (isWordSeparator(character.code) ? element.wordSpacing : 0);
    made.advance += cluster.cursive ? 0 : element.letterSpacing;
    return made;
}

/// Letter-spacing is between characters as they stand on the line (CSS Text 3 section 8.2): there is none
/// behind the chunk's last one, but a chunk without an x goes on behind it.
void removeLastLetterSpacing(ShapedCluster& last, const TextContent& content) {
    const bool spaced = last.advance != last.glyphAdvance;
    last.trailing = spaced ? content.elements[static_cast<std::size_t>(last.element)].letterSpacing : 0;
    last.advance -= last.trailing;
}

}  // namespace

std::vector<ShapedCluster> shapeChunks(const TextContent& content,
                                       const std::vector<ElementFont>& elementFonts, text::FontSet& fonts,
                                       bool vertical) {
    std::vector<ShapedCluster> clusters;
    std::size_t chunk = 0;
    for (std::size_t first = 0, end = 0; first < content.characters.size(); first = end, ++chunk) {
        LineBuilder builder(content, elementFonts, vertical);
        do
            builder.add(end++);
        while (end < content.characters.size() && !startsChunk(content, end));
        builder.finish(first, end);
        const std::size_t start = clusters.size();
        for (text::Cluster& cluster : text::shape(builder.line(), fonts))
            if (auto made = fromLine(cluster, builder, content, elementFonts, chunk))
                clusters.push_back(std::move(*made));
        if (clusters.size() > start)
            removeLastLetterSpacing(clusters.back(), content);
    }
    return clusters;
}

// ---- textLength and lengthAdjust ----------------------------------------------------------------

namespace {

/// The first and the last cluster of an element; first > last where it has none.
struct Range {
    std::size_t first, last;
};

class LengthAdjuster {
public:
    LengthAdjuster(const TextContent& content, std::vector<ShapedCluster>& clusters, bool vertical)
        : content_(content), clusters_(clusters), axis_(vertical ? 1 : 0), pending_(clusters.size() + 1, 0) {}

    /// Elements inside others first.
    void run() {
        const std::vector<Range> all = ranges();
        for (std::size_t element = content_.elements.size(); element-- > 0;)
            if (content_.elements[element].textLength && all[element].first <= all[element].last)
                adjust(static_cast<int>(element), all[element]);
        if (!clusters_.empty())
            settle({0, clusters_.size() - 1});
    }

private:
    const TextElement& elementOf(int index) const {
        return content_.elements[static_cast<std::size_t>(index)];
    }
    double& along(ShapedCluster& cluster) const { return cluster.at[axis_]; }

    std::vector<Range> ranges() const {
        std::vector<Range> made(content_.elements.size(), Range{clusters_.size(), 0});
        for (std::size_t i = 0; i < clusters_.size(); ++i)
            for (int element = clusters_[i].element; element >= 0; element = elementOf(element).parent) {
                Range& range = made[static_cast<std::size_t>(element)];
                range = {std::min(range.first, i), i};
            }
        return made;
    }

    /// Moves the clusters of the range by what is pending there; those behind wait for it.
    void settle(Range range) {
        double shift = 0;
        for (std::size_t i = range.first; i <= range.last; ++i)
            along(clusters_[i]) += shift += std::exchange(pending_[i], 0);
        pending_[range.last + 1] += shift;
    }

    bool isInside(const ShapedCluster& cluster, int ancestor) const {
        int element = cluster.element;
        while (element >= 0 && element != ancestor)
            element = elementOf(element).parent;
        return element >= 0;
    }

    /// The outermost element below `ancestor` and around `element` that has a length of its own; -1: none.
    int adjustedInside(int element, int ancestor) const {
        int found = -1;
        for (; element != ancestor; element = elementOf(element).parent)
            if (elementOf(element).textLength)
                found = element;
        return found;
    }

    /// Counts characters, and elements with a length of their own as one.
    class Units {
    public:
        Units(const LengthAdjuster& adjuster, int ancestor) : adjuster_(adjuster), ancestor_(ancestor) {}
        bool begins(const ShapedCluster& cluster) {
            const int before = std::exchange(unit_, adjuster_.adjustedInside(cluster.element, ancestor_));
            return unit_ < 0 || unit_ != before;
        }

    private:
        const LengthAdjuster& adjuster_;
        int ancestor_, unit_ = -1;
    };

    void adjust(int element, Range range) {
        settle(range);
        const auto clusters = std::span(clusters_).subspan(range.first, range.last - range.first + 1);
        const TextElement& text = elementOf(element);
        double from = std::numeric_limits<double>::infinity(), to = -from;
        std::size_t count = 0;
        Units units(*this, element);
        for (ShapedCluster& cluster : clusters)
            if (isInside(cluster, element)) {
                from = std::min(from, along(cluster));
                to = std::max(to, along(cluster) + cluster.advance);
                count += units.begins(cluster);
            }
        if (!(to > from) || (count < 2 && !text.stretchesGlyphs))
            return;
        if (text.stretchesGlyphs)
            stretch(element, clusters, from, *text.textLength / (to - from));
        else
            spread(element, clusters, (*text.textLength - (to - from)) / static_cast<double>(count - 1));
        const double missing = *text.textLength - (to - from);
        for (ShapedCluster& cluster : clusters)  // between its clusters in bidirectional text
            along(cluster) += isInside(cluster, element) ? 0 : missing;
        pending_[range.last + 1] += missing;
    }

    void stretch(int element, std::span<ShapedCluster> clusters, double from, double scale) const {
        for (ShapedCluster& cluster : clusters)
            if (isInside(cluster, element)) {
                along(cluster) += (along(cluster) - from) * (scale - 1);
                cluster.stretch *= scale;
                cluster.advance *= scale;
                cluster.glyphAdvance *= scale;
            }
    }

    void spread(int element, std::span<ShapedCluster> clusters, double step) const {
        double shift = -step;
        Units units(*this, element);
        for (ShapedCluster& cluster : clusters)
            if (isInside(cluster, element))
                along(cluster) += shift += units.begins(cluster) ? step : 0;
    }

    const TextContent& content_;
    std::vector<ShapedCluster>& clusters_;
    const int axis_;
    /// By cluster: how far it and all behind it have yet to move.
    std::vector<double> pending_;
};

}  // namespace

void adjustLengths(const TextContent& content, std::vector<ShapedCluster>& clusters, bool vertical) {
    LengthAdjuster(content, clusters, vertical).run();
}

}  // namespace vtm::svg
