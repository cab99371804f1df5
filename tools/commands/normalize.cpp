#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <vtm/svg/write.hpp>
#include <vtm/vtmtree.hpp>
#include "tools/commands/commands.hpp"
#include "tools/input/input.hpp"
#include "tools/input/source.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

struct NormalizeOptions {
    std::string input, output;
    SourceOptions source;
};

Tree treeOf(const Source& source) {
    const scene::Rect part = source.exported.value_or(scene::Rect{0, 0, source.width, source.height});
    return {part.width, part.height,
            Vtm::fromScene(*source.scene).placed(scene::translation(-part.x, -part.y))};
}

void writeNormalForm(const NormalizeOptions& options) {
    const Source source = loadSource(readInput(options.input), options.source, false);
    if (!source.scene)
        throw std::runtime_error("is compiled; normalize needs an SVG or a .vtmtree file");
    const bool asTree = suffixOf(options.output) == ".vtmtree";
    const std::string text =
        asTree ? writeTree(treeOf(source)) : svg::write(*source.scene, {.part = source.exported});
    writeOutput(options.output, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

int normalize(const NormalizeOptions& options) {
    requireSuffix(options.output, {".svg", ".vtmtree"});
    refuseLoss({options.input}, {options.output});
    const PictureLimits limits(nameOf(options.input), true);
    try {
        writeNormalForm(options);
    } catch (...) {
        say(describeError(nameOf(options.input)));
        return badInput;
    }
    return done;
}

}  // namespace

void addNormalize(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<NormalizeOptions>();
    CLI::App* command = app.add_subcommand(
        "normalize",
        "Write an SVG as plain SVG or as a tree of VTMs: paths, groups, gradients; text as outlines");
    command->add_option("IN", options->input, "SVG or .vtmtree file, or - for standard input")->required();
    command
        ->add_option("-o,--output", options->output,
                     "The .svg or .vtmtree file, or - for standard output (SVG)")
        ->required();
    addImportOptions(*command, options->source);
    addExportId(*command, options->source.svg.exportId,
                "Write only the element with this id; the file is as large as its bounds");
    command->footer(
        "Examples:\n  vtm normalize poster.svg -o outlines.svg\n  vtm normalize poster.svg -o logo.svg "
        "--export-id logo\n  vtm normalize poster.svg -o poster.vtmtree\n  vtm normalize - -o - < in.svg > "
        "out.svg");
    command->callback([options, &exitCode] { exitCode = normalize(*options); });
}

}  // namespace vtm::tools
