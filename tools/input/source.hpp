/// \file
/// Input files: SVG or a text of VTMs, parsed and compiled here, or an asset that was compiled before.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/draw_view.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/svg/load.hpp>
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"
#include "tools/input/input.hpp"
#include "tools/process/stages.hpp"

namespace vtm::tools {

struct SourceOptions {
    svg::Options svg;
    compiler::Options compiler;
    /// As typed; an asset has its own mode, which must not contradict it.
    std::optional<asset::Mode> mode;
    bool paper = false;         ///< --mode paper, not for assets
    bool hasTolerance = false;  ///< given by the user
    std::string styleSheet;     ///< --stylesheet: a file
    bool strict = false;        ///< --strict: what was left out is an error
};

/// How far boundaries may be off, and where that could not be proven (compiler::Result).
struct Proof {
    double error = 0;
    std::vector<compiler::UnprovenSquare> unproven;
    std::size_t sampledStrokes = 0;
};

struct Source {
    std::string name;                                      ///< for messages
    std::size_t leftOut = 0;                               ///< warnings of warnOf()
    double width = 0, height = 0;                          ///< user units
    std::optional<scene::Rect> exported;                   ///< what --export-id draws
    std::optional<scene::Scene> scene;                     ///< not where the file is an asset
    std::unique_ptr<const compiler::ViewDrawing> drawing;  ///< in place of `asset` for one view
    std::optional<asset::Asset> asset;
    std::optional<paper::CompileResult> paper;  ///< in place of `asset` in paper mode
    std::optional<Proof> proof;                 ///< not where the file is an asset
    std::optional<paper::Cost> cost;            ///< of drawing `paper` on the CPU
    Stages stages;
};

/// Its bytes say what it is; warnings go to stderr. SVG and .vtmtree files are compiled only if `compile`.
/// Throws the modules' exceptions, and std::runtime_error where --strict forbids what was left out.
Source loadSource(Input input, const SourceOptions& options, bool compile = true);

/// Compiles a source that was only parsed.
void compileSource(Source& source, const SourceOptions& options);
/// What came of compiling it.
void take(Source& source, compiler::Result result);

/// Says that something was left out of the source, and counts it. `message` names the source, and the place
/// if it has one.
void warnOf(Source& source, const std::string& message);

/// The importer's warnings; text and filters together in one line.
void warnOf(Source& source, const std::vector<svg::Warning>& warnings);

/// --strict: throws std::runtime_error if anything was left out.
void refuseLeftOut(const Source& source);

}  // namespace vtm::tools
