/// \file
/// Input files: SVG, parsed and compiled here, or an asset that was compiled before.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/svg/load.hpp>
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"
#include "tools/src/input.hpp"
#include "tools/src/report.hpp"

namespace vtm::tools {

struct SourceOptions {
    svg::Options svg;
    compiler::Options compiler;
    /// As typed; an asset has its own mode, which must not contradict it.
    std::optional<asset::Mode> mode;
    bool paper = false;         ///< --mode paper, for SVG files only
    bool hasTolerance = false;  ///< given by the user
    std::string styleSheet;     ///< --stylesheet: a file
    bool strict = false;        ///< --strict: what was left out is an error
};

/// --mode, --tolerance, --strict and what the importer needs: fonts, dpi, language.
void addSourceOptions(CLI::App& command, SourceOptions& options);

struct Source {
    std::string name;                     ///< for messages
    std::size_t leftOut = 0;              ///< warnings of left_out.hpp
    double width = 0, height = 0;         ///< user units
    std::optional<scene::Rect> exported;  ///< what --export-id draws
    std::optional<scene::Scene> scene;    ///< not where the file is an asset
    std::optional<asset::Asset> asset;
    std::optional<paper::CompileResult> paper;                      ///< in place of `asset` in paper mode
    std::optional<std::vector<compiler::UnprovenSquare>> unproven;  ///< not where the file is an asset
    std::optional<paper::Cost> cost;                                ///< of drawing `paper` on the CPU
    Json proof = Json::object();  ///< what the compiler proved; empty where the file is an asset
    Stages stages;
};

/// Whether it is SVG or an asset, its bytes say; warnings go to stderr. An SVG is compiled only if `compile`.
/// Throws the modules' exceptions, and std::runtime_error where --strict forbids what was left out.
Source loadSource(Input input, const SourceOptions& options, bool compile = true);

/// Compiles a source that was only parsed.
void compileSource(Source& source, const SourceOptions& options);
/// What came of compiling it.
void take(Source& source, compiler::Result result);

}  // namespace vtm::tools
