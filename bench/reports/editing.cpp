#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/compiler/session.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "bench/engines/contest.hpp"
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

using scene::Item;
using scene::Point;
using scene::Scene;

constexpr std::size_t edited = 15;       ///< items of each file and kind of edit
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
    from.resize(std::min(from.size(), edited));
    return from;
}

void move(Item& item, const Item& from, double x, double y) {
    item.transform = scene::compose(scene::translation(x, y), from.transform);
}

/// Of one edit; CPU milliseconds.
struct Cost {
    double compiling = 0;  ///< the scene anew, in the same turn
    double session = 0;    ///< the session's update
    double scanner = 0;    ///< the scanner's, or the evaluator's
    double boxes = 0;      ///< drawing what may look different
    std::size_t blocks = 0;

    double updates() const { return session + scanner; }
    double shown() const { return session + scanner + boxes; }
    double percent() const { return 100 * session / compiling; }
};
using Costs = std::vector<Cost>;

template <class Value>
std::vector<double> each(const Costs& costs, Value value) {
    std::vector<double> values;
    for (const Cost& cost : costs)
        values.push_back(double(std::invoke(value, cost)));
    return values;
}

template <class Value>
double medianOf(const Costs& costs, Value value) {
    return median(each(costs, value));
}

template <class Value>
double worstOf(const Costs& costs, Value value) {
    return quantile(each(costs, value), 1);
}

double meanBlocks(const Costs& costs) {
    double sum = 0;
    for (const Cost& cost : costs)
        sum += double(cost.blocks);
    return sum / double(std::max<std::size_t>(costs.size(), 1));
}

/// A scene, its session, and pixels that follow it.
class Editor {
public:
    Editor(const File& file, int side)
        : scene(load(file)),
          view(wholePicture(scene, side)),
          session(scene),
          rowBytes_(std::size_t(view.width) * 4) {
        bytes_.resize(rowBytes_ * std::size_t(view.height));
    }

    /// From now on what is edited is shown. Throws std::invalid_argument if that cannot be.
    void show() {
        if (session.result().asset.filters.empty())
            scanner_.emplace(session.result().asset);
        else {
            whole_.emplace(session.result().asset);
            evaluator_.emplace(session.result().asset, asset::EvaluatorOptions{.keepsFilterResults = true});
            evaluator_->draw(view, target());
        }
        redraw();
    }
    bool shows() const { return scanner_ || evaluator_; }

    /// CPU milliseconds of drawing everything.
    double redraw() {
        return spentTime([&] {
            if (scanner_)
                scanner_->draw(view, target());
            else if (whole_)
                whole_->draw(view, target());
        });
    }

    /// After an edit of the scene.
    Cost follow() {
        Cost cost;
        cost.session = spentTime([&] { session.update(scene); });
        cost.blocks = session.lastUpdate().blocks;
        if (shows()) {
            cost.scanner = spentTime([&] { bringToSession(); });
            cost.boxes = spentTime([&] { drawChanges(); });
        }
        if (whole_)
            whole_->update(session.result().asset, session.difference());
        return cost;
    }

    Scene scene;
    const asset::View view;
    compiler::Session session;

private:
    asset::ByteTarget target() { return {bytes_.data(), rowBytes_}; }
    void bringToSession() {
        if (scanner_)
            scanner_->update(session.result().asset, session.difference());
        else
            evaluator_->update(session.result().asset, session.difference());
    }
    void drawChanges() {
        for (const asset::PixelBox& box : asset::changedPixels(view, session.difference()))
            if (scanner_)
                scanner_->drawBox(view, box, target());
            else
                evaluator_->drawBox(view, box, target());
    }

    std::size_t rowBytes_;
    std::vector<std::uint8_t> bytes_;
    std::optional<asset::Scanner> scanner_;
    // Where there are filters. Programs that show edits draw the whole once: a redraw must not bring up to
    // date what is kept for boxes.
    std::optional<asset::Evaluator> evaluator_, whole_;
};

/// There and back for each of the items. Copying scenes is not counted: it is for the caller to do or not.
/// `first`: done once for each item, between compiling and the edit, which finds its data cold.
template <class Edit>
Costs costsOf(Editor& editor, const std::vector<Item*>& which, const Edit& edit,
              const std::function<void()>& first) {
    Costs costs;
    for (Item* item : which) {
        const Item before = *item;
        const double compiling = spentTime([&] { compiler::compile(editor.scene); });
        first();
        for (const bool there : {true, false}) {
            if (there)
                edit(*item);
            else
                *item = before;
            costs.push_back(editor.follow());
            costs.back().compiling = compiling;
        }
    }
    return costs;
}

/// All items moved, each its own way, a picture after the other.
Costs morph(Editor& editor, const std::vector<Item*>& all, double by, int pictures) {
    std::vector<Item> before;
    for (const Item* item : all)
        before.push_back(*item);
    Costs costs;
    for (int picture = 0; picture < pictures; ++picture) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double angle = double(i) + 0.1 * (picture + 1);
            move(*all[i], before[i], by * std::cos(angle), by * std::sin(angle));
        }
        const double compiling = spentTime([&] { compiler::compile(editor.scene); });
        costs.push_back(editor.follow());
        costs.back().compiling = compiling;
    }
    return costs;
}

/// The engines beside us, which draw everything again.
class Peers {
public:
    Peers(const Options& options, std::vector<std::string>& notes)
        : patience_(patienceOf(options)), options_(options), notes_(notes), all_(contenders(options, notes)) {
        const std::string scan = reference(all_).engine->name();  // the others are compared with it
        std::erase_if(all_, [&](const Contender& one) { return one.ours && one.engine->name() != scan; });
    }

    void start(const LoadedFile& picture, const asset::View& view) {
        prepare(all_, picture, {}, options_, notes_);
        forget();
        turn(picture.file.name, view);  // not counted
        forget();
    }

    /// Until patience is spent, a drawing by each of those that have not failed.
    void turn(const std::string& file, const asset::View& view) {
        if (spent_ > patience_.budget && rounds_ >= patience_.fewest)
            return;
        ++rounds_;
        for (Contender& one : all_)
            if (!one.ours && one.able)
                draw(one, file, view);
    }

    /// Of a peer: how often an edit's time fits into its drawing. `edits`: by rounds.
    Json ratioOf(const Contender& one, const std::vector<double>& edits) const {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < std::min(one.times.size(), edits.size()); ++i)
            ratios.push_back(one.times[i] / edits[i]);
        return {{"ms", median(one.times)},         {"ratio", median(ratios)},
                {"low", quantile(ratios, 0.25)},   {"high", quantile(ratios, 0.75)},
                {"rounds", int(one.times.size())}, {"rms from ours", one.difference}};
    }

    /// The same of all that drew the picture, by name.
    Json ratios(const std::vector<double>& edits) const {
        Json by = Json::object();
        for (const Contender& one : all_)
            if (!one.times.empty() && !edits.empty())
                by[one.engine->name()] = ratioOf(one, edits);
        return by;
    }

    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const Contender& one : all_)
            if (!one.ours)
                names.push_back(one.engine->name());
        return names;
    }

private:
    void forget() {
        spent_ = 0;
        rounds_ = 0;
        for (Contender& one : all_)
            one.times.clear();
    }

    void draw(Contender& one, const std::string& file, const asset::View& view) {
        try {
            const double time = one.engine->draw(view);
            if (time > patience_.longest)
                throw std::runtime_error(fmt::format("it takes {:.1f} s", time / 1000));
            one.times.push_back(time);
            spent_ += time;
        } catch (const std::exception& error) {
            one.able = false;
            notes_.push_back(fmt::format("{}: not by {}: {}.", file, one.engine->name(), error.what()));
        }
    }

    Patience patience_;
    const Options& options_;
    std::vector<std::string>& notes_;
    Contenders all_;
    double spent_ = 0;  ///< CPU milliseconds
    int rounds_ = 0;
};

double bytesOf(const compiler::Result& result) { return double(asset::summarize(result.asset).bytes); }

/// What was measured with a file.
struct EditedFile {
    std::string file;
    std::size_t items = 0, blocks = 0;
    double start = 0, bytes = 0;  ///< of the session, by the compiler's
    bool shown = false;
    double redraw = 0;  ///< CPU milliseconds, by our scanner
    Costs recolours, moves, smallMoves, morphs;
    Json peers;
};

void startAll(Editor& editor, Peers& peers, const File& file, std::vector<std::string>& notes) {
    try {
        editor.show();
    } catch (const std::invalid_argument& reason) {
        notes.push_back(fmt::format("{}: edits are not shown: {}.", file.name, reason.what()));
        return;
    }
    peers.start({file, editor.scene}, editor.view);
}

struct Items {
    std::vector<Item*> all;
    std::vector<Item*> inside;  ///< those that lie in the picture
    std::vector<Item*> small;   ///< and are small
};

Items itemsOf(Scene& scene) {
    Items items;
    collect(scene.root, items.all);
    const double small = smallShare * std::max(scene.width, scene.height);
    for (Item* item : items.all) {
        const double size = sizeOf(*item, scene);
        if (size > 0)
            items.inside.push_back(item);
        if (size > 0 && size <= small)
            items.small.push_back(item);
    }
    return items;
}

/// Milliseconds of the edits that are shown, there and back, by items.
std::vector<double> shownByItem(const Costs& costs) {
    std::vector<double> times;
    for (std::size_t i = 0; i < costs.size(); i += 2)
        times.push_back((costs[i].shown() + costs[i + 1].shown()) / 2);
    return times;
}

/// Edits of each kind; the peers take turns with the moves.
void edit(Editor& editor, Peers& peers, int pictures, EditedFile& m) {
    const double by = moveShare * std::max(editor.scene.width, editor.scene.height);
    const auto aside = [by](Item& item) { move(item, item, by, 0); };
    std::vector<double> redraws;
    const auto redraw = [&] { redraws.push_back(editor.redraw()); };
    const auto turn = [&] {
        if (m.shown)
            peers.turn(m.file, editor.view);
        redraw();
    };
    const Items items = itemsOf(editor.scene);
    m.items = items.all.size();
    m.recolours = costsOf(editor, sample(items.inside), recolourItem, redraw);
    m.moves = costsOf(editor, sample(items.inside), aside, turn);
    m.smallMoves = costsOf(editor, sample(items.small), aside, redraw);
    m.morphs = morph(editor, items.all, by, pictures);
    m.redraw = median(redraws);
    if (m.shown)
        m.peers = peers.ratios(shownByItem(m.moves));
}

EditedFile measure(const File& file, Peers& peers, const Options& options, std::vector<std::string>& notes) {
    Editor editor(file, options.side);
    const compiler::Result fresh = compiler::compile(editor.scene);
    EditedFile m;
    m.file = file.name;
    m.blocks = editor.session.lastUpdate().blocksInAll;
    m.start = spentTime([&] { compiler::Session{editor.scene}; });
    m.bytes = bytesOf(editor.session.result()) / bytesOf(fresh);
    startAll(editor, peers, file, notes);
    m.shown = editor.shows();
    edit(editor, peers, options.quick ? 7 : 15, m);
    return m;
}

Json rowOf(const EditedFile& m) {
    const double compiling = medianOf(m.morphs, &Cost::compiling);
    const auto orNone = [](bool there, double value) { return there ? Json(value) : Json(nullptr); };
    const bool small = !m.smallMoves.empty();
    Json row = {{"file", m.file}, {"items", m.items}, {"compile ms", compiling}};
    const auto add = [&](const std::string& name, const Costs& costs) {
        row[name + " %"] = medianOf(costs, &Cost::percent);
        row["worst " + name + " %"] = worstOf(costs, &Cost::percent);
        row[name + " blocks"] = meanBlocks(costs);
        row[name + " ms"] = orNone(m.shown, medianOf(costs, &Cost::shown));
        row["worst " + name + " ms"] = orNone(m.shown, worstOf(costs, &Cost::shown));
        row[name + " session ms"] = medianOf(costs, &Cost::session);
        row[name + " scanner ms"] = orNone(m.shown, medianOf(costs, &Cost::scanner));
        row[name + " boxes ms"] = orNone(m.shown, medianOf(costs, &Cost::boxes));
        row["worst " + name + " updates ms"] = worstOf(costs, &Cost::updates);
    };
    add("recolour", m.recolours);
    add("move", m.moves);
    row["small move %"] = orNone(small, medianOf(m.smallMoves, &Cost::percent));
    row["small move ms"] = orNone(small && m.shown, medianOf(m.smallMoves, &Cost::shown));
    add("morph", m.morphs);
    row["redraw ms"] = orNone(m.shown, m.redraw);
    row["blocks"] = m.blocks;
    row["start / compile"] = m.start / compiling;
    row["bytes / compiler's"] = m.bytes;
    row["peers"] = m.peers;
    return row;
}

std::string number(const Json& value) {
    return value.is_null() ? "-" : fmt::format("{:.3g}", value.get<double>());
}

std::string peerCell(const Json& row, const std::string& name) {
    const Json& peers = row["peers"];
    if (!peers.contains(name))
        return "-";
    const bool other = peers[name]["rms from ours"] > otherPicture;
    return number(peers[name]["ratio"]) + (other ? " ≠" : "");
}

/// Milliseconds of an edit that is shown, the updates' part and the worst.
std::string shownCell(const EditedFile& m, const Costs& costs) {
    if (!m.shown || costs.empty())
        return "-";
    return fmt::format("{:.3g} ({:.2g}), {:.3g}", medianOf(costs, &Cost::shown),
                       medianOf(costs, &Cost::updates), worstOf(costs, &Cost::shown));
}

std::string percentCell(const Costs& costs) {
    if (costs.empty())
        return "-";
    return fmt::format("{:.3g}, {:.3g}", medianOf(costs, &Cost::percent), worstOf(costs, &Cost::percent));
}

Json lineOf(const EditedFile& m, const Json& row, const std::vector<std::string>& names) {
    Json line = {{"file", m.file},
                 {"items", m.items},
                 {"recolour ms", shownCell(m, m.recolours)},
                 {"move ms", shownCell(m, m.moves)},
                 {"redraw ms", number(row["redraw ms"])}};
    for (const std::string& name : names)
        line[name] = peerCell(row, name);
    line["compile ms"] = number(row["compile ms"]);
    line["recolour %"] = percentCell(m.recolours);
    line["move %"] = percentCell(m.moves);
    line["small move %"] = percentCell(m.smallMoves);
    line["morph %"] = percentCell(m.morphs);
    line["blocks"] = fmt::format("{:.3g} of {}", meanBlocks(m.moves), m.blocks);
    line["start"] = number(row["start / compile"]);
    line["bytes"] = number(row["bytes / compiler's"]);
    return line;
}

std::string textOf(int side) {
    return fmt::format(
        "A session per file ([session.md](../../docs/session.md)), shown at {} pixels. {} of the items that "
        "lie in the picture, taken at random, are recoloured and put back, and moved by 1/{:.0f} of the "
        "picture's side and put back. CPU milliseconds on one processor, medians. *recolour, "
        "move*: an edit until it is seen, that is the updates of session and scanner, or evaluator where "
        "there are filters (their part in brackets), and drawing the boxes that changed; then the worst. "
        "*redraw*: the same scanner draws "
        "everything. *The peers*: how many times as long as a move that is shown each of them takes to draw "
        "the whole picture from what it has prepared, item by item, in turns; ≠ marks a picture that "
        "differs from ours by more than {} of 255 (rms of means over 64ths of the side). *Percentages*: the "
        "session's update alone by compiling the scene anew in the same turn, median and worst; small items "
        "are at most 1/{:.0f} of the side across; *morph*: all items are moved, each its own way. *Blocks*: "
        "how many a move builds on average. Then what starting the session costs and the bytes of its "
        "asset, by the compiler's.",
        side, edited, 1 / moveShare, otherPicture, 1 / smallShare);
}

/// Over the files, of those that draw as we do.
Json mediansOf(const Json& rows, const std::vector<std::string>& names, const Json& like) {
    Json line;
    for (const auto& [key, value] : like.items())
        line[key] = "";
    line["file"] = "median of the ratios";
    for (const std::string& name : names) {
        std::vector<double> ratios;
        for (const Json& row : rows)
            if (row["peers"].contains(name) && row["peers"][name]["rms from ours"] <= otherPicture)
                ratios.push_back(row["peers"][name]["ratio"]);
        line[name] = ratios.empty() ? "-" : fmt::format("{:.3g}", median(ratios));
    }
    return line;
}

}  // namespace

Report editing(const Options& options) {
    Report report;
    report.name = "editing";
    report.title = "Editing, beside compiling and drawing anew";
    report.text = textOf(options.side);
    Peers peers(options, report.notes);
    for (const File& file : filesOf(options)) {
        fmt::print(stderr, "{}\n", file.name);
        const EditedFile m = measure(file, peers, options, report.notes);
        report.rows.push_back(rowOf(m));
        report.summary.push_back(lineOf(m, report.rows.back(), peers.names()));
    }
    if (!report.summary.empty())
        report.summary.push_back(mediansOf(report.rows, peers.names(), report.summary.front()));
    return report;
}

}  // namespace vtm::bench
