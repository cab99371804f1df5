#include "svg/text/flow.hpp"

#include <algorithm>

#include "svg/text/chunks.hpp"
#include "svg/text/element_font.hpp"
#include "text/shape.hpp"

namespace vtm::svg {
namespace {

struct LineExtent {
    double above = 0, below = 0;  ///< of the baseline

    /// CSS 2.2 section 10.8.1: half of what the line is higher than its letters stands above them.
    void add(const TextElement& element, const ElementFont& font) {
        const double letters = font.ascent() + font.descent();
        const double leading = element.scope.style.lineHeight * font.size - letters;
        above = std::max(above, font.ascent() + leading / 2);
        below = std::max(below, font.descent() + leading / 2);
    }
};

class Flow {
public:
    Flow(TextContent& content, const FlowArea& area, text::FontSet& fonts)
        : content_(content), area_(area), fonts_(elementFonts(content.elements, fonts)), y_(area.top) {
        std::u32string text;
        for (const TextCharacter& character : content.characters)
            text += character.code;
        breaks_ = text::lineBreaks(text, content.elements.front().language);
        advances_.resize(text.size(), 0);
        for (const ShapedCluster& cluster : shapeChunks(content, fonts_, fonts, false))
            advances_[cluster.first] += cluster.advance;
        kept_.resize(text.size(), true);
    }

    void add(const Paragraph& paragraph, std::size_t end) {
        if (paragraph.first == end) {
            LineExtent extent;
            extent.add(elementAt(paragraph.element), fontAt(paragraph.element));
            y_ += extent.above + extent.below;
        }
        for (std::size_t first = paragraph.first; first < end;) {
            const std::size_t next = lineEnd(first, end);
            place(first, next);
            first = next;
        }
    }

    void finish() {
        std::size_t i = 0;
        std::erase_if(content_.characters, [&](const TextCharacter&) { return !kept_[i++]; });
    }

private:
    const TextElement& elementAt(int element) const {
        return content_.elements[static_cast<std::size_t>(element)];
    }
    const ElementFont& fontAt(int element) const { return fonts_[static_cast<std::size_t>(element)]; }
    /// Made small capitals do not make a line lower.
    int styledAt(std::size_t i) const {
        const TextElement& element = elementAt(content_.characters[i].element);
        return element.smallCaps ? element.parent : content_.characters[i].element;
    }
    bool isSpace(std::size_t i) const { return content_.characters[i].code == ' '; }

    /// Greedy: as many words as fit; spaces at the end may stick out.
    std::size_t lineEnd(std::size_t first, std::size_t end) const {
        double width = 0;
        std::size_t allowed = first;
        for (std::size_t i = first; i < end; ++i) {
            width += advances_[i];
            if (width > area_.width && !isSpace(i) && allowed > first)
                return allowed;
            allowed = breaks_[i] ? i + 1 : allowed;
        }
        return end;
    }

    void place(std::size_t first, std::size_t end) {
        LineExtent extent;
        for (std::size_t i = first; i < end; ++i)
            extent.add(elementAt(styledAt(i)), fontAt(styledAt(i)));
        const bool fits = y_ + extent.above + extent.below <= area_.bottom;
        for (std::size_t i = first; i < end && !fits; ++i)
            kept_[i] = false;
        for (std::size_t i = end; i > first && isSpace(i - 1); --i)
            kept_[i - 1] = false;
        content_.characters[first].x = area_.x;
        content_.characters[first].y = y_ + extent.above;
        y_ += extent.above + extent.below;
    }

    TextContent& content_;
    const FlowArea area_;
    const std::vector<ElementFont> fonts_;
    std::vector<bool> breaks_, kept_;
    std::vector<double> advances_;  ///< of the cluster that begins at a character
    double y_;
};

}  // namespace

void flow(TextContent& content, const std::vector<Paragraph>& paragraphs, const FlowArea& area,
          text::FontSet& fonts) {
    if (content.elements.empty())
        return;
    Flow flow(content, area, fonts);
    for (std::size_t i = 0; i < paragraphs.size(); ++i)
        flow.add(paragraphs[i],
                 i + 1 < paragraphs.size() ? paragraphs[i + 1].first : content.characters.size());
    flow.finish();
}

double firstAscent(const TextContent& content, text::FontSet& fonts) {
    LineExtent extent;
    extent.add(content.elements.front(), elementFonts(content.elements, fonts).front());
    return extent.above;
}

}  // namespace vtm::svg
