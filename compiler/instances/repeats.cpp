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

/// What a layer shows, wherever it lies.
struct Shape {
    std::uint64_t key = 0;  ///< 0: of no other layer's kind
    Affine frame{};         ///< from the outline's own space to the picture
    double size = 0;        ///< of the outline there
};

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

// ---- Runs of layers -------------------------------------------------------------------------------

/// Longer runs of layers are not compared.
constexpr std::size_t maxRun = 4096;

class Search {
public:
    Search(std::vector<Shape> shapes, double side)
        : shapes_(std::move(shapes)), isTaken_(shapes_.size()), slack_(std::ldexp(side, -20)) {
        for (std::uint32_t i = 0; i < shapes_.size(); ++i)
            if (shapes_[i].key != 0)
                places_[shapes_[i].key].push_back(i);
    }

    std::vector<Repeat> run() {
        std::vector<Repeat> repeats;
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
            limits::check();
            if (shapes_[i].key == 0 || isTaken_[i] || places_[shapes_[i].key].size() < 2)
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
    /// How many layers from `to` on are images of those from `from` on, under one map.
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

    /// The run from layer i on that saves most layers: as long as its next occurrence, or shorter where more
    /// places hold only its beginning.
    Repeat repeatFrom(std::uint32_t i) const {
        const std::vector<std::uint32_t>& places = places_.at(shapes_[i].key);
        const auto next = std::ranges::upper_bound(places, i);
        if (next == places.end())
            return {};
        const std::size_t longest = matching(i, *next, std::min<std::size_t>(*next - i, maxRun));
        if (longest == 0)
            return {};
        std::vector<std::size_t> lengths;  // by place
        for (auto place = next; place != places.end(); ++place)
            lengths.push_back(matching(i, *place, longest));
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
        return occurrences(i, {next, places.end()}, lengths, best);
    }

    Repeat occurrences(std::uint32_t i, std::span<const std::uint32_t> places,
                       const std::vector<std::size_t>& lengths, std::size_t length) const {
        Repeat repeat{std::uint32_t(length), {{i, scene::identity}}};
        const Affine inverse = *scene::inverse(shapes_[i].frame);
        std::uint32_t end = i + repeat.count;
        for (std::size_t p = 0; p < places.size(); ++p)
            if (lengths[p] >= length && places[p] >= end) {
                repeat.occurrences.push_back({places[p], scene::compose(shapes_[places[p]].frame, inverse)});
                end = places[p] + repeat.count;
            }
        return repeat;
    }

    std::vector<Shape> shapes_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> places_;  ///< by key
    std::vector<bool> isTaken_;
    const double slack_;
};

}  // namespace

std::vector<Repeat> findRepeats(std::span<const LayerOrigin> origins, double side) {
    return Search(Shapes(origins).take(), side).run();
}

}  // namespace vtm::compiler
