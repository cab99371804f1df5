#include "compiler/instances/repeats.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <glm/common.hpp>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/hash.hpp"

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Path;
using scene::Point;

/// A path but for where it lies: its coordinates relative to its first point, in steps of 2^-22 of its size,
/// so that the roundings of whoever wrote it do not tell equal outlines apart.
constexpr int sizeBits = 22;

class PathHash {
public:
    PathHash(const Path& path, Point origin) : origin_(origin) {
        double size = 0;
        forEachPoint(path, [&](Point p) {
            size = std::max({size, std::abs(p.x - origin.x), std::abs(p.y - origin.y)});
        });
        size_ = std::ldexp(1.0, std::ilogb(std::max(size, 0x1p-200)) + 1);
        add(bits(size_));
        for (const scene::Command& command : path) {
            add(command.index());
            std::visit([&](const auto& c) { addCommand(c); }, command);
        }
    }
    std::uint64_t hash() const { return hash_; }
    double size() const { return size_; }

private:
    template <class Visit>
    static void forEachPoint(const Path& path, Visit&& visit) {
        for (const scene::Command& command : path)
            if (const auto end = scene::endOf(command))
                visit(*end);
    }

    void add(std::uint64_t value) { hash_ = hashCombine(hash_, value); }
    void length(double value) { add(std::uint64_t(std::llround(std::ldexp(value / size_, sizeBits)))); }
    void point(Point p) {
        length(p.x - origin_.x);
        length(p.y - origin_.y);
    }
    void addCommand(const scene::MoveTo& c) { point(c.to); }
    void addCommand(const scene::LineTo& c) { point(c.to); }
    void addCommand(const scene::QuadTo& c) {
        point(c.control);
        point(c.to);
    }
    void addCommand(const scene::CubicTo& c) {
        point(c.control1);
        point(c.control2);
        point(c.to);
    }
    void addCommand(const scene::ArcTo& c) {
        length(c.radii.x);
        length(c.radii.y);
        add(bits(c.rotation));
        add(2u * unsigned(c.largeArc) + unsigned(c.sweep));
        point(c.to);
    }
    void addCommand(const scene::Close&) {}

    const Point origin_;
    double size_ = 1;
    std::uint64_t hash_ = 0;
};

std::uint64_t hashOf(const LayerOrigin& origin, scene::FillRule rule) {
    std::uint64_t h = hashCombine(unsigned(origin.isClip), std::uint64_t(rule));
    if (!origin.stroke)
        return h;
    const scene::StrokeStyle& s = *origin.stroke;
    for (const std::uint64_t value :
         {bits(s.width), std::uint64_t(s.cap), std::uint64_t(s.join), bits(s.miterLimit), bits(s.dashPhase)})
        h = hashCombine(h, value);
    for (const double dash : s.dashes)
        h = hashCombine(h, bits(dash));
    return h;
}

class Shapes {
public:
    explicit Shapes(std::span<const LayerOrigin> origins) {
        shapes_.reserve(origins.size());
        for (const LayerOrigin& origin : origins) {
            limits::check();
            shapes_.push_back(shapeOf(origin));
        }
    }
    std::vector<Shape> take() { return std::move(shapes_); }

private:
    struct Known {
        std::uint64_t hash;
        Point origin;
        double size;
    };

    Shape shapeOf(const LayerOrigin& origin) {
        if (!origin.path || origin.path->empty() || !scene::inverse(origin.transform))
            return {};
        const auto [known, isNew] = paths_.try_emplace(origin.path.get());
        if (isNew) {
            const Point start = std::get<scene::MoveTo>(origin.path->front()).to;
            const PathHash hash(*origin.path, start);
            known->second = {hash.hash(), start, hash.size()};
        }
        const Known& path = known->second;
        const std::uint64_t key = hashCombine(hashOf(origin, origin.rule), path.hash);
        return {key | 1, scene::compose(origin.transform, scene::translation(path.origin.x, path.origin.y)),
                path.size};
    }

    std::unordered_map<const Path*, Known> paths_;
    std::vector<Shape> shapes_;
};

// ---- Runs -----------------------------------------------------------------------------------------

/// What a repeat is to save.
enum class Saving {
    Layers,  ///< one that lies in its next occurrence is cut short there
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
            if (starts_[i] != 0)
                places_[starts_[i]].push_back(i);
        }
    }

    std::vector<Repeat> run() {
        std::vector<Repeat> repeats;
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
            limits::check();
            if (starts_[i] == 0 || isTaken_[i] || places_[starts_[i]].size() < 2)
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
        const std::vector<std::uint32_t>& places = places_.at(starts_[i]);
        const auto next = std::ranges::upper_bound(places, i);
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
        const std::size_t length = saving_ == Saving::Layers ? lengthForLayers(lengths, longest)
                                                             : lengthForRecords(i, others, lengths);
        return length == 0 ? Repeat{} : occurrences(i, others, lengths, length);
    }

    /// As long as the next occurrence, or shorter where more places hold only the beginning.
    static std::size_t lengthForLayers(const std::vector<std::size_t>& lengths, std::size_t longest) {
        std::vector<std::size_t> atLeast(longest + 1);
        for (const std::size_t length : lengths)
            ++atLeast[length];
        std::size_t best = 1, saved = 0, count = 0;
        for (std::size_t length = longest; length > 0; --length) {
            count += atLeast[length];
            if (count * length > saved) {
                saved = count * length;
                best = length;
            }
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
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> places_;  ///< by start
    std::vector<bool> isTaken_;
    const double slack_;
    const Saving saving_;
};

}  // namespace

std::vector<Repeat> findRepeats(std::span<const LayerOrigin> origins, double side) {
    return Search(Shapes(origins).take(), std::ldexp(side, -20), Saving::Layers).run();
}

std::vector<Repeat> findRuns(std::vector<Shape> shapes, double slack) {
    return Search(std::move(shapes), slack, Saving::Records).run();
}

}  // namespace vtm::compiler
