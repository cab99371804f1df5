#include "tools/input/source.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/stroke.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/vtmtree.hpp>
#include "geometry/arc.hpp"
#include "geometry/box.hpp"
#include "geometry/cubic.hpp"
#include "scene/center_form.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

using geometry::Box;
using geometry::Cubic;
using scene::Affine;
using scene::Point;

/// The box of a mapped path. A MoveTo that nothing follows does not count.
class PathBox {
public:
    explicit PathBox(const Affine& transform) : transform_(transform) {}

    void operator()(const scene::MoveTo& move) { at_ = start_ = move.to; }
    void operator()(const scene::LineTo& line) { lineTo(line.to); }
    void operator()(const scene::QuadTo& quad) { curve(geometry::raised(at_, quad.control, quad.to)); }
    void operator()(const scene::CubicTo& cubic) { curve({at_, cubic.control1, cubic.control2, cubic.to}); }
    void operator()(const scene::ArcTo& arc) {
        if (const auto center = scene::centerForm(at_, arc))
            box_.add(geometry::bounds(geometry::mapped(*center, transform_)));
        lineTo(arc.to);
    }
    void operator()(const scene::Close&) { lineTo(start_); }
    const Box& box() const { return box_; }

private:
    Point map(Point p) const { return scene::apply(transform_, p); }
    void lineTo(Point to) {
        box_.add(map(at_));
        box_.add(map(to));
        at_ = to;
    }
    void curve(const Cubic& c) {
        box_.add(geometry::bounds(Cubic{map(c.p0), map(c.p1), map(c.p2), map(c.p3)}));
        at_ = c.p3;
    }

    const Affine transform_;
    Box box_;
    Point at_{0}, start_{0};
};

Box boxOf(const scene::Path& path, const Affine& transform) {
    PathBox box(transform);
    for (const scene::Command& command : path)
        std::visit(box, command);
    return box.box();
}

class SceneBox {
public:
    explicit SceneBox(double tolerance) : tolerance_(tolerance) {}

    void add(const scene::NodeList& nodes) {
        for (const scene::Node& node : nodes) {
            limits::check();
            std::visit([&](const auto& value) { add(value); }, node.value);
        }
    }
    const Box& box() const { return box_; }

private:
    void add(const scene::Item& item) { add(*item.path, item.transform, item.geometry); }
    void add(const scene::Group& group) { add(group.children); }
    void add(const scene::Select& select) {
        for (const scene::Group* side : {select.inside.get(), select.outside.get()})
            if (side)
                add(side->children);
    }
    void add(const scene::Path& path, const Affine& transform,
             const std::variant<scene::FillRule, scene::StrokeStyle>& geometry) {
        const auto* style = std::get_if<scene::StrokeStyle>(&geometry);
        box_.add(style ? boxOf(compiler::strokeOutline(path, *style, pathTolerance(transform)), transform)
                       : boxOf(path, transform));
    }
    /// In the path's units.
    double pathTolerance(const Affine& m) const {
        return tolerance_ / std::max({glm::length(m[0]), glm::length(m[1]), tolerance_});
    }

    const double tolerance_;
    Box box_;
};

/// The least rectangle round all fills and strokes within the picture, with joins, caps and dashes as they
/// are drawn; clips and masks cut nothing off. Strokes within 1/65536 of the picture's longer side. Nothing
/// where nothing is drawn.
std::optional<scene::Rect> drawnBounds(const scene::Scene& scene) {
    SceneBox drawn(compiler::Options().tolerance * std::max(scene.width, scene.height));
    drawn.add(scene.root.children);
    const Box box = drawn.box().intersection({Point(0), Point(scene.width, scene.height)});
    if (!(box.min.x < box.max.x && box.min.y < box.max.y))
        return std::nullopt;
    return scene::Rect{box.min.x, box.min.y, box.width(), box.height()};
}

// ---- What is left out -----------------------------------------------------------------------------

std::string placeOf(const svg::Location& where) {
    return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

// ---- Loading --------------------------------------------------------------------------------------

void loadAsset(Source& source, const Input& input, const SourceOptions& options) {
    if (options.paper)
        throw std::runtime_error("is a .vtm file; paper mode draws SVG and .vtmtree files only");
    if (!options.svg.exportId.empty() || !options.styleSheet.empty())
        throw std::runtime_error("is a .vtm file; --export-id and --stylesheet need an SVG file");
    source.asset = timed(source.stages, "parse", [&] { return asset::read(input.bytes); });
    if (options.mode && *options.mode != source.asset->mode)
        throw std::runtime_error("was compiled in another mode than --mode");
    source.width = source.asset->width;
    source.height = source.asset->height;
}

void parseTree(Source& source, const Input& input, const SourceOptions& options) {
    if (!options.svg.exportId.empty() || !options.styleSheet.empty())
        throw std::runtime_error("is a .vtmtree file; --export-id and --stylesheet need an SVG file");
    source.scene = timed(source.stages, "parse", [&] {
        return readTree(input.bytes, {input.name, input.folder}).toScene();
    });
    source.width = source.scene->width;
    source.height = source.scene->height;
}

std::string readStyleSheet(const std::string& path) {
    const Input sheet = readInput(path);
    return {sheet.bytes.begin(), sheet.bytes.end()};
}

scene::Rect exportedBounds(const svg::Document& document, const std::string& id) {
    if (const auto bounds = drawnBounds(document.scene))
        return *bounds;
    throw std::runtime_error(fmt::format("#{}: the element draws nothing inside the picture", id));
}

void parseSvg(Source& source, const Input& input, const SourceOptions& given) {
    svg::Options options = given.svg;
    if (!given.styleSheet.empty())
        options.styleSheet = readStyleSheet(given.styleSheet);
    options.fileName = input.name;
    options.resourceDirectory = input.folder;
    svg::Document document = timed(source.stages, "parse", [&] { return svg::load(input.bytes, options); });
    warnOf(source, document.warnings);
    source.width = document.scene.width;
    source.height = document.scene.height;
    if (!options.exportId.empty())
        source.exported = exportedBounds(document, options.exportId);
    source.scene = std::move(document.scene);
}

void compilePaper(Source& source, const compiler::Options& options) {
    paper::CompileOptions paper;
    paper.tolerance = options.tolerance;
    paper::CompileResult result =
        timed(source.stages, "compile", [&] { return paper::compile(*source.scene, paper); });
    for (const std::string& warning : result.warnings)
        warnOf(source, fmt::format("{}: warning: {}", source.name, warning));
    source.paper = std::move(result);
}

void compileScene(Source& source, const compiler::Options& options) {
    compiler::Result result =
        timed(source.stages, "compile", [&] { return compiler::compile(*source.scene, options); });
    take(source, std::move(result));
}

}  // namespace

Source loadSource(Input input, const SourceOptions& options, bool compile) {
    Source source;
    source.name = input.name;
    source.stages = std::move(input.stages);
    if (input.isAsset())
        loadAsset(source, input, options);
    else if (input.isTree())
        parseTree(source, input, options);
    else
        parseSvg(source, input, options);
    input.bytes = {};
    if (options.strict)
        refuseLeftOut(source);
    if (source.scene && compile)
        compileSource(source, options);
    return source;
}

void compileSource(Source& source, const SourceOptions& options) {
    options.paper ? compilePaper(source, options.compiler) : compileScene(source, options.compiler);
    if (options.strict)
        refuseLeftOut(source);
}

void take(Source& source, compiler::Result result) {
    for (const auto& [stage, milliseconds] : result.stages)
        source.stages.emplace_back(stage, milliseconds);
    for (const std::string& warning : result.warnings)
        warn(fmt::format("{}: warning: {}", source.name, warning));
    source.proof = Proof{result.provenError, std::move(result.unproven), result.sampledStrokes};
    source.asset = std::move(result.asset);
}

void warnOf(Source& source, const std::string& message) {
    warn(message);
    ++source.leftOut;
}

void warnOf(Source& source, const std::vector<svg::Warning>& warnings) {
    for (const svg::Warning& warning : warnings)
        warnOf(source, fmt::format("{}: warning: {}", placeOf(warning.where), warning.message));
}

void refuseLeftOut(const Source& source) {
    if (source.leftOut > 0)
        throw std::runtime_error("--strict: nothing is written, because something is left out or repaired");
}

}  // namespace vtm::tools
