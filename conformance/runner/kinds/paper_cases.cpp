// Rows of the paper: ROW-what.svg or .vtmtree is drawn in paper mode, by its evaluator and its shader, and
// what the row promises beyond a picture is tried.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/session.hpp>
#include <vtm/font/typesetter.hpp>
#include <vtm/gl/text_texture.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/vtmtree.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/reference/reference.hpp"
#include "conformance/runner/judge/judge.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"
#include "conformance/runner/kinds/svg_files.hpp"
#include "conformance/runner/suite/case.hpp"
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/pattern.hpp"
#include "paper/gl/renderer.hpp"
#include "trace/trace.hpp"

namespace vtm::conformance {

namespace {

using image::Raster;

/// By the row's number; null where the row is a picture and nothing else. Throws what the modules throw.
using RowCheck = Outcome (*)(const scene::Scene& scene);

using paper::Asset;
using scene::Scene;

constexpr int raster = 128;

Outcome expect(bool holds, const std::string& otherwise) {
    return holds ? Outcome::passed() : Outcome::failed(otherwise);
}

paper::Asset paperOf(const Scene& scene) { return paper::compile(scene).asset; }

bool anyCell(const paper::Asset& asset, const std::function<bool(const paper::Cell&)>& holds) {
    return std::ranges::any_of(asset.masks,
                               [&](const auto& m) { return std::ranges::any_of(m.cells, holds); });
}

bool bends(const paper::Piece& piece) { return piece.slopeA != 0 && piece.slopeB != 0; }

/// 1: cells hold cubics with slopes at both ends.
Outcome cubics(const Scene& scene) {
    return expect(
        anyCell(paperOf(scene), [](const auto& cell) { return cell.count == 1 && bends(cell.pieces[0]); }),
        "no cell holds a bent piece");
}

/// 2: corners take two functions, with both operators.
Outcome twoFunctions(const Scene& scene) {
    const paper::Asset paper = paperOf(scene);
    for (const auto combine : {paper::Operator::Intersection, paper::Operator::Union})
        if (!anyCell(paper, [&](const auto& cell) { return cell.count == 2 && cell.combine == combine; }))
            return Outcome::failed(combine == paper::Operator::Union ? "no union" : "no intersection");
    return Outcome::passed();
}

/// 5: nodes refer to nodes, an item's mask each, down to all items; long sequences are composed as trees,
/// which draw the same picture and visit fewer nodes.
Outcome nested(const Scene& scene) {
    const paper::Asset paper = paperOf(scene);
    std::set<std::uint32_t> reached{paper.root};
    std::size_t masks = 0;
    while (!reached.empty()) {
        const paper::Node& node = paper.nodes[*reached.rbegin()];
        reached.erase(std::prev(reached.end()));
        masks += node.mask != paper::noIndex;
        for (const paper::Side* side : {&node.inside, &node.outside})
            if (side->rest != paper::noIndex)
                reached.insert(side->rest);
    }
    if (masks < scene.root.children.size())
        return Outcome::failed(fmt::format("{} nodes with masks follow each other", masks));
    const paper::Asset chain = paper::compile(scene, {.balanced = false}).asset;
    for (const double zoom : {1.0, 0.1, 6.0}) {
        asset::View view = cases::wholePicture(scene, raster);
        view.toPixels *= zoom;
        paper::Cost tree, sequence;
        const double d =
            compare::compare(paper::evaluate(paper, view, &tree), paper::evaluate(chain, view, &sequence))
                .max;
        if (d != 0 || tree.nodes > sequence.nodes * 3 / 2)
            return Outcome::failed(fmt::format("tree and sequence differ by {}; {} and {} nodes", d,
                                               tree.nodes, sequence.nodes));
    }
    return Outcome::passed();
}

paper::Cost costOf(const Scene& scene, const asset::View& view) {
    paper::Cost cost;
    paper::evaluate(paperOf(scene), view, &cost);
    return cost;
}

/// A view of `units` of the picture round a point.
asset::View closeUp(glm::dvec2 centre, double units) {
    const double scale = raster / units;
    return {raster,
            raster,
            {scale, 0, 0, scale, raster / 2.0 - scale * centre.x, raster / 2.0 - scale * centre.y}};
}

/// 4: where the mask is 0 or 1 over a pixel, one side is evaluated, on the boundary both.
Outcome neededSideOnly(const Scene& scene) {
    const double pixels = raster * raster;
    const asset::View inside = closeUp({scene.width / 2, scene.height / 2}, scene.width / 64);
    const paper::Cost cost = costOf(scene, inside), all = costOf(scene, cases::wholePicture(scene, raster));
    if (double(cost.paints) != pixels)
        return Outcome::failed(fmt::format("{} paints for {} pixels inside", cost.paints, pixels));
    return expect(double(all.paints) < 1.5 * pixels,
                  fmt::format("{} paints for {} pixels", all.paints, pixels));
}

/// 7: thin rings keep their ink on the mean, however small they are drawn.
Outcome keepsInk(const Scene& scene) {
    const paper::Asset paper = paperOf(scene);
    constexpr int places = 8;
    for (const double scale : {0.05, 0.1, 0.2}) {
        double drawn = 0, truth = 0;
        for (int i = 0; i < places * places; ++i) {
            const asset::View view{64, 64, {scale, 0, 0, scale, 3 + i % places / 8.0, 5 + i / places / 8.0}};
            const Raster a = paper::evaluate(paper, view),
                         b = reference::render(scene, {view.width, view.height, view.toPixels});
            for (std::size_t p = 3; p < a.rgba.size(); p += 4)
                drawn += double(a.rgba[p]), truth += double(b.rgba[p]);
        }
        if (std::abs(drawn - truth) > 0.02 * truth)
            return Outcome::failed(fmt::format("{:.3f} of the ink at a scale of {}", drawn / truth, scale));
    }
    return Outcome::passed();
}

/// 8: the paper's tree is 8 times smaller than its grid.
Outcome compressed(const Scene& scene) {
    const paper::Summary summary = paper::summarize(paperOf(scene));
    const double ratio = double(summary.gridBytes) / double(summary.treeBytes);
    return expect(ratio >= 7, fmt::format("the grid is {:.2f} times as large", ratio));
}

/// 9: far from boundaries no cell is read.
Outcome earlyOut(const Scene& scene) {
    const paper::Cost inside = costOf(scene, closeUp({scene.width / 2, scene.height / 2}, scene.width / 64));
    const paper::Cost edge = costOf(scene, cases::wholePicture(scene, raster));
    return expect(inside.cells == 0 && edge.cells > 0,
                  fmt::format("{} cells inside, {} in the whole", inside.cells, edge.cells));
}

std::size_t countOf(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++count;
    return count;
}

/// 10: a lookup reads one cell and no more levels than the tree has; the linear form is the shorter shader.
Outcome lookup(const Scene& scene) {
    const asset::View view = cases::wholePicture(scene, raster);
    const paper::Cost cost = costOf(scene, view);
    const std::uint64_t pixels = std::uint64_t(view.width) * std::uint64_t(view.height);
    if (cost.cells > pixels || cost.indirections > pixels * paper::CompileOptions().maxDepth)
        return Outcome::failed(
            fmt::format("{} cells, {} levels for {} pixels", cost.cells, cost.indirections, pixels));
    const auto fetches = [](paper::PatternForm form) {
        return countOf(paper::patternShader(form, 2), "texelFetch");
    };
    return expect(fetches({false, true, false}) <= fetches({true, true, false}),
                  "the grid's shader fetches more");
}

/// 11: the four forms draw one pattern: compressed or not alike, filtered or not where pixels are small.
Outcome fourForms(const Scene& scene) {
    renderer();  // a current context
    const paper::Asset paper = paperOf(scene);
    const asset::View view{raster, raster, {50, 20, -20, 50, 3.3, 5.7}};
    const auto draw = [&](bool tree, bool filtered) {
        return paper::Pattern(paper.masks.at(0), {tree, filtered, false}).render(view);
    };
    if (const double d = compare::compare(draw(true, true), draw(false, true)).max; !(d <= 2))
        return Outcome::failed(fmt::format("filtered, tree and grid differ by {}", d));
    if (const double d = compare::compare(draw(true, false), draw(false, false)).max; !(d <= 2))
        return Outcome::failed(fmt::format("unfiltered, tree and grid differ by {}", d));
    const double mean = compare::compare(draw(true, true), draw(true, false)).mean;
    return expect(mean > 0 && mean < 20, fmt::format("filtering changes {} on the mean", mean));
}

/// 14: outside of the mask nothing is written.
Outcome primitive(const Scene& scene) {
    paper::Asset paper = paperOf(scene);
    const asset::View view = cases::wholePicture(scene, raster);
    const paper::Footprint pixel(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    if (paper::sample(paper, {1, 1}, pixel).color.a != 0)
        return Outcome::failed("the outside has alpha");
    paper.nodes[paper.root].outside = {0, paper::noIndex, true};
    return expect(paper::sample(paper, {1, 1}, pixel).discarded &&
                      !paper::sample(paper, {scene.width / 2, scene.height / 2}, pixel).discarded,
                  "the outside is not discarded, or the inside is");
}

/// 15: a bitmap of the scene, vectorised, looks like the scene but for the edges' pixels.
Outcome traced(const Scene& scene) {
    if (!trace::available())
        return Outcome::skipped("built without potrace");
    constexpr int size = 256;
    const auto exact = [&](const Scene& s) {
        const asset::View view = cases::wholePicture(s, size);
        return reference::render(s, {view.width, view.height, view.toPixels});
    };
    const Raster bitmap = exact(scene);
    const double mean =
        compare::compare(exact(trace::trace(image::toBitmap(bitmap), {.colors = 2})), bitmap).mean;
    return expect(mean < 2.5, fmt::format("mean {}", mean));
}

Scene moved(Scene scene) {
    auto& item = std::get<scene::Item>(scene.root.children.front().value);
    item.transform = scene::compose(scene::translation(7.25, -3.5), item.transform);
    return scene;
}

/// 16: a mask remade is the mask made anew; so is a session's picture.
Outcome dynamic(const Scene& scene) {
    const Scene changed = moved(scene);
    const asset::View view = cases::wholePicture(scene, raster);
    paper::CompileResult paper = paper::compile(scene);
    paper::rebuildMask(paper, 0, std::get<scene::Item>(changed.root.children.front().value));
    if (const double d =
            compare::compare(paper::evaluate(paper.asset, view), paper::evaluate(paperOf(changed), view)).max;
        d != 0)
        return Outcome::failed(fmt::format("the remade mask differs by {}", d));
    compiler::Session session(scene);
    const double d = compare::compare(asset::evaluate(session.update(changed).asset, view),
                                      asset::evaluate(compiler::compile(changed).asset, view))
                         .max;
    return expect(d <= 2, fmt::format("the session's picture differs by {}", d));
}

/// 18: the compiler chooses: one map, one lookup a pixel, smaller than the paper's masks.
Outcome automatic(const Scene& scene) {
    const asset::Asset asset = compiler::compile(scene).asset;
    const std::size_t ours = asset::summarize(asset).bytes, papers = paper::summarize(paperOf(scene)).bytes;
    return expect(asset.maps.size() == 1 && ours < papers,
                  fmt::format("{} maps, {} bytes, the paper's {}", asset.maps.size(), ours, papers));
}

/// 17: an author's tree is a text, which reads back as the same tree.
Outcome authored(const Scene& scene) {
    const std::string text = writeTree({scene.width, scene.height, Vtm::fromScene(scene)});
    const Tree back = readTree({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    if (scene::dump(back.toScene()) != scene::dump(scene))
        return Outcome::failed("the text reads back as another scene");
    return expect(writeTree(back) == text, "the text is not written as it was read");
}

/// 13: 256 characters of a font take the paper's 128 KB, a page of text 8 bytes a character, cells of one
/// size 1 byte; the scene's lines, set again, look the same.
Outcome fontEngine(const Scene& scene) {
    constexpr const char* file = "/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf";
    if (!std::filesystem::exists(file))
        return Outcome::skipped(fmt::format("{} is not installed", file));
    font::FontMaps font(image::readFile(file));
    std::u32string latin;
    for (char32_t c = U' '; latin.size() < 256; ++c)
        if (font.advanceOf(c))
            latin += c;
    font.addCharacters(latin);
    if (const std::size_t bytes = asset::write(font.asset()).size(); bytes > 128 << 10)
        return Outcome::failed(fmt::format("256 glyphs take {} bytes", bytes));

    font::Typesetter lines(font, scene.width, scene.height);
    constexpr double size = 56, lineHeight = 72;
    lines.add(U"Vector\nTexture\nMaps", {16, lineHeight - font.ascent() * size, scene.width, scene.height},
              {.size = size, .lineHeight = lineHeight / size});
    const asset::View view = cases::wholePicture(scene, raster);
    const Raster drawn = asset::Scanner(asset::pageAsset(lines.page(), font.asset())).draw(view);
    if (const double d =
            compare::compare(drawn, reference::render(scene, {view.width, view.height, view.toPixels})).max;
        !(d <= 4))
        return Outcome::failed(fmt::format("the lines differ by {}", d));

    font::Typesetter page(font, 600, 800);
    std::u32string text;
    while (text.size() < 5000)
        text += U"Pages of text are tables over one font. ";
    page.add(text, {40, 40, 520, 720}, {.size = 10});
    font::CellText cells{.columns = 100, .rows = 50, .text = text.substr(0, 5000)};
    const std::vector<asset::TextPage> pages{page.page(), font::Typesetter::cells(font, cells)};
    renderer();  // a current context
    const gl::TextTexture texture(font.asset(), pages);
    constexpr double symbolBytes = 48;  // at most: a page's symbols stand beside its characters
    for (const auto& [i, bytes] : {std::pair<std::size_t, double>(0, 8), {1, 1}})
        if (const double each =
                (double(texture.bytes(i)) - symbolBytes * double(pages[i].symbols.size())) / 5000;
            each > bytes * 1.05)
            return Outcome::failed(fmt::format("{:.2f} bytes a character instead of {}", each, bytes));
    return Outcome::passed();
}

RowCheck checkOfRow(int row) {
    constexpr RowCheck checks[] = {cubics,     twoFunctions, nullptr,  neededSideOnly, nested,    nullptr,
                                   keepsInk,   compressed,   earlyOut, lookup,         fourForms, nullptr,
                                   fontEngine, primitive,    traced,   dynamic,        authored,  automatic};
    return row >= 1 && row <= int(std::size(checks)) ? checks[row - 1] : nullptr;
}

class PaperSubject : public Subject {
public:
    PaperSubject(const scene::Scene& scene, const SceneSettings& settings, const std::string& salt)
        : scene_(scene),
          settings_(settings),
          views_(viewsOf(settings.views, scene_, salt)),
          paper_(paper::compile(scene_).asset) {}

    std::size_t views() const override { return views_.size(); }
    std::string labelOf(std::size_t view) const override { return views_[view].label; }
    std::vector<Engine> engines(std::size_t) const override { return {Engine::Asset, Engine::Gl}; }
    Bounds bounds(Engine) const override { return settings_.bounds; }
    Raster expected(std::size_t view) override {
        const asset::View& v = views_[view].view;
        return reference::render(scene_, {v.width, v.height, v.toPixels});
    }
    Raster drawn(std::size_t view, Engine engine) override {
        if (engine == Engine::Asset)
            return paper::evaluate(paper_, views_[view].view);
        renderer();  // a current context
        return paper::Renderer().render(paper::Texture(paper_), views_[view].view);
    }

private:
    scene::Scene scene_;
    SceneSettings settings_;
    std::vector<LabelledView> views_;
    paper::Asset paper_;
};

Outcome run(const SvgCase& made, int row, const SceneSettings& settings, const Setting& setting) {
    const scene::Scene scene = made.scene();
    if (const RowCheck check = checkOfRow(row))
        if (const Outcome outcome = check(scene); outcome.status != Outcome::Status::Passed)
            return outcome;
    PaperSubject subject(scene, settings, made.name);
    return judge(subject, setting);
}

/// The number at the front of a file's name.
int rowOf(const SvgCase& made) {
    const std::string name = made.file.filename().string();
    if (!std::isdigit(static_cast<unsigned char>(name[0])))
        throw SuiteError(made.file.string() + ": the name does not begin with the row's number");
    return std::stoi(name);
}

}  // namespace

std::vector<Case> paperCases(const Folder& folder) {
    return svgCases(folder, [](const SvgCase& made) {
        SvgCase own = made;
        // Bounds differ from row to row: "rows" has settings by number.
        const int row = rowOf(made);
        const Settings rows = own.settings.value("rows", Settings::object());
        if (rows.contains(std::to_string(row)))
            own.settings.merge_patch(rows.at(std::to_string(row)));
        const SceneSettings settings = sceneSettings(own.settings);
        return [=](const Setting& setting) { return run(own, row, settings, setting); };
    });
}

}  // namespace vtm::conformance
