#include "compiler/instances/repeats.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/hash.hpp"
#include "compiler/instances/alike_paths.hpp"
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Path;
using scene::Point;

/// A length in units of a kind. Where the kind has the path's own size it stays as it is, else it is rounded
/// to 14 bits, so that an image has the same one.
std::uint64_t lengthBits(double length, double scale) {
    if (scale == 1)
        return bits(length);
    int exponent = 0;
    const double mantissa = std::frexp(length / scale, &exponent);
    return bits(std::ldexp(std::round(std::ldexp(mantissa, 14)), exponent));
}

/// `scale`: of the path, in units of its kind.
std::uint64_t hashOf(const LayerOrigin& origin, double scale) {
    std::uint64_t h = hashCombine(unsigned(origin.isClip), std::uint64_t(origin.rule));
    if (!origin.stroke)
        return h;
    const scene::StrokeStyle& s = *origin.stroke;
    for (const std::uint64_t value : {lengthBits(s.width, scale), std::uint64_t(s.cap), std::uint64_t(s.join),
                                      bits(s.miterLimit), lengthBits(s.dashPhase, scale)})
        h = hashCombine(h, value);
    for (const double dash : s.dashes)
        h = hashCombine(h, lengthBits(dash, scale));
    return h;
}

class Shapes {
public:
    Shapes(std::span<const LayerOrigin> origins, const std::vector<bool>& isLeftOut,
           std::span<const double> weights, double slack)
        : origins_(origins), slack_(slack) {
        findUses(isLeftOut);
        shapes_.reserve(origins.size());
        for (std::uint32_t i = 0; i < origins.size(); ++i) {
            limits::check();
            if (i % summariesAtOnce == 0)
                findSummaries(i);
            shapes_.push_back(firstUse_[i] != noIndex ? shapeOf(i, weights[i]) : Shape{});
        }
    }
    std::vector<Shape> take() { return std::move(shapes_); }

private:
    static bool mayRepeat(const LayerOrigin& origin) {
        return origin.path && !origin.path->empty() && scene::inverse(origin.transform);
    }

    /// Which layers have one path, and how far it is stretched at most.
    void findUses(const std::vector<bool>& isLeftOut) {
        std::vector<std::uint32_t> order;
        order.reserve(origins_.size());
        for (std::uint32_t i = 0; i < origins_.size(); ++i)
            if (!isLeftOut[i] && mayRepeat(origins_[i]))
                order.push_back(i);
        const auto pathOf = [&](std::uint32_t i) { return origins_[i].path.get(); };
        std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
            const Path *const p = pathOf(a), *const q = pathOf(b);
            return p == q ? a < b : std::less<>()(p, q);
        });
        firstUse_.assign(origins_.size(), noIndex);
        stretches_.resize(origins_.size());
        isUsedAgain_.resize(origins_.size());
        std::uint32_t first = noIndex;
        for (const std::uint32_t i : order) {
            if (first == noIndex || pathOf(i) != pathOf(first))
                first = i;
            else
                isUsedAgain_[first] = true;
            firstUse_[i] = first;
            stretches_[first] = std::max(stretches_[first], largestStretch(origins_[i].transform));
        }
    }

    /// Of the layers from `first` on that are first uses, on all processors.
    void findSummaries(std::uint32_t first) {
        const std::size_t count = std::min<std::size_t>(summariesAtOnce, origins_.size() - first);
        summaries_.resize(count);
        constexpr std::size_t grain = 64;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                          [&, holding = limits::current()](const auto& range) {
                              const limits::Scope scope(holding);
                              for (std::size_t i = range.begin(); i < range.end(); ++i)
                                  if (firstUse_[first + i] == first + i)
                                      summaries_[i] = AlikePaths::summaryOf(*origins_[first + i].path);
                          });
    }

    Shape shapeOf(std::uint32_t i, double weight) {
        const LayerOrigin& origin = origins_[i];
        const AlikePaths::Image path = imageOf(firstUse_[i], i);
        const std::uint64_t key = hashCombine(hashOf(origin, path.scale), path.kind);
        return {key | 1, scene::compose(origin.transform, path.fromKind), path.size, weight};
    }

    AlikePaths::Image imageOf(std::uint32_t first, std::uint32_t use) {
        if (use != first)
            return images_.at(first);
        const AlikePaths::Image image = paths_.add(*origins_[first].path, summaries_[first % summariesAtOnce],
                                                   slack_ / stretches_[first]);
        if (isUsedAgain_[first])
            images_.emplace(first, image);
        return image;
    }

    static constexpr std::uint32_t summariesAtOnce = 1u << 13;

    const std::span<const LayerOrigin> origins_;
    const double slack_;
    AlikePaths paths_;
    std::vector<AlikePaths::Summary> summaries_;
    std::vector<std::uint32_t> firstUse_;  ///< by layer: the first one of its path; noIndex: may not repeat
    std::vector<double> stretches_;        ///< of first uses: largest of the path, into the picture
    std::vector<bool> isUsedAgain_;        ///< of first uses
    std::unordered_map<std::uint32_t, AlikePaths::Image> images_;  ///< by first use, of paths used again
    std::vector<Shape> shapes_;
};

// ---- Runs -----------------------------------------------------------------------------------------

/// What a repeat is to save.
enum class Saving {
    Layers,  ///< by weight; one that would reach its next occurrence ends there
    Records
};

/// A shape with the one that follows it, as they lie to each other: rounded to 14 bits, so that an image has
/// the same number in all likelihood.
std::uint64_t pairKey(const Shape& shape, const Shape& next) {
    const auto inverse = scene::inverse(shape.frame);
    if (shape.key == 0 || next.key == 0 || !inverse)
        return 0;
    constexpr double steps = 1 << 14;
    const Affine between = scene::compose(*inverse, next.frame);
    std::uint64_t key = hashCombine(shape.key, next.key);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 2; ++row)
            key = hashCombine(key, bits(std::round(between[column][row] * steps) + 0.0));  // -0 is 0
    return key | 1;
}

class Search {
public:
    Search(std::vector<Shape> shapes, double slack, Saving saving)
        : shapes_(std::move(shapes)),
          starts_(shapes_.size()),
          isTaken_(shapes_.size()),
          slack_(slack),
          saving_(saving) {
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
            if (saving == Saving::Layers)
                starts_[i] = shapes_[i].key;
            else if (i + 1 < shapes_.size())
                starts_[i] = pairKey(shapes_[i], shapes_[i + 1]);
        }
        findPlaces();
    }

    std::vector<Repeat> run() {
        std::vector<Repeat> repeats;
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
            limits::check();
            if (!isRepeated_[i] || isTaken_[i])
                continue;
            Repeat repeat = repeatFrom(i);
            if (repeat.occurrences.size() < 2)
                continue;
            for (const Repeat::Occurrence& o : repeat.occurrences)
                std::fill_n(isTaken_.begin() + o.first, repeat.count, true);
            repeats.push_back(std::move(repeat));
        }
        return repeats;
    }

private:
    /// Longer runs are not compared.
    static constexpr std::size_t maxLayers = 4096, maxRecords = 256;

    void findPlaces() {
        isRepeated_.resize(shapes_.size());
        for (std::uint32_t i = 0; i < shapes_.size(); ++i)
            if (starts_[i] != 0)
                places_.push_back(i);
        std::ranges::sort(places_, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(starts_[a], a) < std::pair(starts_[b], b);
        });
        const auto isAlone = [&](std::size_t p) {
            return (p == 0 || starts_[places_[p - 1]] != starts_[places_[p]]) &&
                   (p + 1 == places_.size() || starts_[places_[p + 1]] != starts_[places_[p]]);
        };
        for (std::size_t p = 0; p < places_.size(); ++p)
            isRepeated_[places_[p]] = !isAlone(p);
        std::erase_if(places_, [&](std::uint32_t i) { return !isRepeated_[i]; });
    }

    /// Where runs may begin that are like one from shape i on, ascending.
    std::span<const std::uint32_t> placesOf(std::uint32_t i) const {
        return std::ranges::equal_range(places_, starts_[i], {},
                                        [&](std::uint32_t place) { return starts_[place]; });
    }

    /// How many shapes from `to` on are images of those from `from` on, under one map.
    std::size_t matching(std::uint32_t from, std::uint32_t to, std::size_t maximum) const {
        const auto inverse = scene::inverse(shapes_[from].frame);
        if (!inverse)
            return 0;
        const Affine map = scene::compose(shapes_[to].frame, *inverse);
        std::size_t n = 0;
        while (n < maximum && to + n < shapes_.size() && !isTaken_[to + n] && !isTaken_[from + n] &&
               shapes_[from + n].key != 0 && shapes_[from + n].key == shapes_[to + n].key &&
               isImage(shapes_[from + n], map, shapes_[to + n]))
            ++n;
        return n;
    }

    bool isImage(const Shape& shape, const Affine& map, const Shape& image) const {
        const Affine frame = scene::compose(map, shape.frame);
        const auto isNear = [&](Point p) {
            const Point d = glm::abs(scene::apply(frame, p) - scene::apply(image.frame, p));
            return std::max(d.x, d.y) <= slack_;
        };
        return isNear({0, 0}) && isNear({shape.size, 0}) && isNear({0, shape.size});
    }

    /// The run from shape i on that saves most.
    Repeat repeatFrom(std::uint32_t i) const {
        const std::span<const std::uint32_t> places = placesOf(i);
        const auto next = std::find_if(std::ranges::upper_bound(places, i), places.end(),
                                       [&](std::uint32_t place) { return !isTaken_[place]; });
        if (next == places.end())
            return {};
        std::size_t longest = maxRecords;
        if (saving_ == Saving::Layers)
            longest = matching(i, *next, std::min<std::size_t>(*next - i, maxLayers));
        if (longest == 0)
            return {};
        std::vector<std::size_t> lengths;  // by place
        for (auto place = next; place != places.end(); ++place)
            lengths.push_back(matching(i, *place, std::min<std::size_t>(longest, *place - i)));
        const std::span others(next, places.end());
        const std::size_t length = saving_ == Saving::Layers ? lengthForLayers(i, lengths, longest)
                                                             : lengthForRecords(i, others, lengths);
        return length == 0 ? Repeat{} : occurrences(i, others, lengths, length);
    }

    /// As long as the next occurrence, or shorter where more places hold only the beginning.
    std::size_t lengthForLayers(std::uint32_t i, const std::vector<std::size_t>& lengths,
                                std::size_t longest) const {
        std::vector<std::size_t> atLeast(longest + 1);
        for (const std::size_t length : lengths)
            ++atLeast[length];
        double weight = 0;
        for (std::size_t k = 0; k < longest; ++k)
            weight += shapes_[i + k].weight;
        std::size_t best = longest, count = 0;
        double saved = 0;
        for (std::size_t length = longest; length > 0; --length) {
            count += atLeast[length];
            if (double(count) * weight > saved) {
                saved = double(count) * weight;
                best = length;
            }
            weight -= shapes_[i + length - 1].weight;
        }
        return best;
    }

    /// Of n runs of `length` records, n + length are left. 0 if none are saved.
    std::size_t lengthForRecords(std::uint32_t i, std::span<const std::uint32_t> places,
                                 const std::vector<std::size_t>& lengths) const {
        std::vector<bool> isLength(maxRecords + 1);
        for (const std::size_t length : lengths)
            isLength[length] = true;
        std::size_t best = 0, saved = 0;
        for (std::size_t length = 2; length <= maxRecords; ++length) {
            if (!isLength[length])
                continue;
            std::size_t count = 1;
            forEachOccurrence(i, places, lengths, length, [&](std::uint32_t) { ++count; });
            const std::size_t before = count * length, after = count + length;
            if (before > after && before - after > saved) {
                saved = before - after;
                best = length;
            }
        }
        return best;
    }

    /// Calls visit(place) for those that hold a run of that length and lie in no other that was visited.
    template <class Visit>
    static void forEachOccurrence(std::uint32_t i, std::span<const std::uint32_t> places,
                                  const std::vector<std::size_t>& lengths, std::size_t length,
                                  Visit&& visit) {
        std::size_t end = i + length;
        for (std::size_t p = 0; p < places.size(); ++p)
            if (lengths[p] >= length && places[p] >= end) {
                visit(places[p]);
                end = places[p] + length;
            }
    }

    Repeat occurrences(std::uint32_t i, std::span<const std::uint32_t> places,
                       const std::vector<std::size_t>& lengths, std::size_t length) const {
        Repeat repeat{std::uint32_t(length), {{i, scene::identity}}};
        const Affine inverse = *scene::inverse(shapes_[i].frame);
        forEachOccurrence(i, places, lengths, length, [&](std::uint32_t place) {
            repeat.occurrences.push_back({place, scene::compose(shapes_[place].frame, inverse)});
        });
        return repeat;
    }

    std::vector<Shape> shapes_;
    std::vector<std::uint64_t> starts_;  ///< what a run that begins with each of them may be like; 0: nothing
    std::vector<std::uint32_t> places_;  ///< of starts that stand at several, by start, then ascending
    std::vector<bool> isRepeated_;       ///< by shape: whether its start is one of these
    std::vector<bool> isTaken_;
    const double slack_;
    const Saving saving_;
};

}  // namespace

std::vector<Repeat> findRepeats(std::span<const LayerOrigin> origins, const std::vector<bool>& isLeftOut,
                                std::span<const double> weights, double slack) {
    return Search(Shapes(origins, isLeftOut, weights, slack).take(), slack, Saving::Layers).run();
}

std::vector<Repeat> findRuns(std::vector<Shape> shapes, double slack) {
    return Search(std::move(shapes), slack, Saving::Records).run();
}

}  // namespace vtm::compiler
