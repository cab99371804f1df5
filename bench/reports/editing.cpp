#include <algorithm>
#include <limits>
#include <random>

#include <fmt/core.h>

#include <vtm/compiler/session.hpp>
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

using scene::Item;
using scene::Point;
using scene::Scene;

constexpr std::size_t items = 15;        ///< edited in each file
constexpr double smallShare = 1.0 / 32;  ///< of the picture's side: larger items are not small
constexpr double moveShare = 1.0 / 256;  ///< of the picture's side: how far they are moved

void collect(scene::Group& group, std::vector<Item*>& into) {
    for (scene::Node& node : group.children) {
        if (auto* inner = std::get_if<scene::Group>(&node.value))
            collect(*inner, into);
        else if (auto* item = std::get_if<Item>(&node.value))
            into.push_back(item);
    }
}

/// The larger side of the box round the ends of the path's commands, in the picture; 0 if the item lies
/// outside.
double sizeOf(const Item& item, const Scene& scene) {
    constexpr double far = std::numeric_limits<double>::max();
    Point low{far, far}, high{-far, -far};
    for (const scene::Command& command : *item.path)
        if (const auto end = scene::endOf(command)) {
            const Point p = scene::apply(item.transform, *end);
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    const bool inside = high.x > 0 && high.y > 0 && low.x < scene.width && low.y < scene.height;
    return inside ? std::max(high.x - low.x, high.y - low.y) : 0;
}

/// A colour in place of the item's, as translucent.
void recolourItem(Item& item) {
    const auto set = [](scene::Color& c) { c = {1 - c.r, c.b, c.g, c.a}; };
    std::visit(
        [&](auto& paint) {
            using Paint = std::decay_t<decltype(paint)>;
            if constexpr (std::is_same_v<Paint, scene::Color>)
                set(paint);
            else if constexpr (requires { paint.stops; })
                for (scene::GradientStop& stop : paint.stops)
                    set(stop.color);
        },
        item.paint);
}

std::vector<Item*> sample(std::vector<Item*> from) {
    std::mt19937 random(1);
    std::ranges::shuffle(from, random);
    from.resize(std::min(from.size(), items));
    return from;
}

/// What the edits of some items cost; percentages of encoding the scene anew in the same turn.
struct Costs {
    std::vector<double> shares, encodings;  ///< encodings: CPU milliseconds
    std::size_t blocks = 0;                 ///< built, added up

    double worst() const { return shares.empty() ? 0 : *std::ranges::max_element(shares); }
    double meanBlocks() const { return shares.empty() ? 0 : double(blocks) / double(shares.size()); }
};

/// There and back for each of the items. Copying scenes is not counted: it is for the caller to do or not.
template <class Edit>
Costs costsOf(compiler::Session& session, Scene& scene, const std::vector<Item*>& which, const Edit& edit) {
    Costs costs;
    for (Item* item : which) {
        const Item before = *item;
        const double encoding = cpuTime([&] { compiler::compile(scene); });
        costs.encodings.push_back(encoding);
        for (const bool there : {true, false}) {
            if (there)
                edit(*item);
            else
                *item = before;
            costs.shares.push_back(100 * cpuTime([&] { session.update(scene); }) / encoding);
            costs.blocks += session.lastUpdate().blocks;
        }
    }
    return costs;
}

double bytesOf(const compiler::Result& result) { return double(asset::summarize(result.asset).bytes); }

void addFile(const File& file, Report& report) {
    Scene scene = load(file);
    const double side = std::max(scene.width, scene.height);
    std::vector<Item*> all, small;
    collect(scene.root, all);
    for (Item* item : all)
        if (const double size = sizeOf(*item, scene); size > 0 && size <= side * smallShare)
            small.push_back(item);

    compiler::Session session(scene);
    const compiler::Result fresh = compiler::compile(scene);
    const double start = cpuTime([&] { compiler::Session{scene}; });
    const std::size_t blocks = session.lastUpdate().blocksInAll;
    const double bytes = bytesOf(session.result()) / bytesOf(fresh);
    const Costs recolour = costsOf(session, scene, sample(all), recolourItem);
    const Costs move = costsOf(session, scene, sample(small), [&](Item& item) {
        item.transform = scene::compose(scene::translation(side * moveShare, 0), item.transform);
    });
    const double encoding = median(recolour.encodings);
    const auto orNone = [&](double value) { return small.empty() ? Json("none is small") : Json(value); };
    report.rows.push_back({{"file", file.name},
                           {"items", all.size()},
                           {"encode ms", encoding},
                           {"recolour %", median(recolour.shares)},
                           {"worst", recolour.worst()},
                           {"blocks built", recolour.meanBlocks()},
                           {"move %", orNone(median(move.shares))},
                           {"worst move", orNone(move.worst())},
                           {"blocks moved", orNone(move.meanBlocks())},
                           {"of blocks", blocks},
                           {"start / encode", start / encoding},
                           {"bytes / encoder's", bytes}});
}

}  // namespace

Report editing(const Options& options) {
    Report report;
    report.name = "editing";
    report.title = "Editing against encoding anew";
    report.text = fmt::format(
        "A session per file ([session.md](../../docs/session.md)). {} of its items, taken at random, are "
        "recoloured "
        "and put back; so are moved by 1/{:.0f} of the picture's side as many of those that are at most "
        "1/{:.0f} of it "
        "across. CPU time of all threads in percent of that of encoding the scene anew, the two taking "
        "turns: the "
        "median of the edits and the worst. Blocks: how many an edit builds on average, and of how many. "
        "Then what "
        "starting the session costs, and the bytes of its asset, by the encoder's.",
        items, 1 / moveShare, 1 / smallShare);
    for (const File& file : filesOf(options))
        addFile(file, report);
    return report;
}

}  // namespace vtm::bench
