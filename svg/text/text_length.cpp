#include "svg/text/text_length.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace vtm::svg {
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
