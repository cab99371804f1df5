/// \file
/// Input files: SVG, parsed and compiled here, or an asset that was compiled before.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "asset/asset.hpp"
#include "compiler/compile.hpp"
#include "compiler/paper.hpp"
#include "scene/scene.hpp"
#include "svg/load.hpp"
#include "tools/src/report.hpp"

namespace vtm::tools {

struct SourceOptions {
    svg::Options svg;
    compiler::Options compiler;
    /// As typed; an asset has its own mode, which must not contradict it.
    std::optional<asset::Mode> mode;
    bool paper = false;  ///< --mode paper, for SVG files only
    /// Of a picture's width and height: the tolerance to compile with when the one asked for takes too long;
    /// empty: there is none.
    std::function<double(double, double)> coarserTolerance = {};
};

/// --mode, --tolerance and what the importer needs: fonts, dpi, language.
void addSourceOptions(CLI::App& command, SourceOptions& options);

struct Source {
    double width = 0, height = 0;       ///< user units
    std::optional<scene::Scene> scene;  ///< not where the file is an asset
    std::optional<asset::Asset> asset;
    std::optional<compiler::PaperResult> paper;                     ///< in place of `asset` in paper mode
    std::optional<std::vector<compiler::UnprovenSquare>> unproven;  ///< not where the file is an asset
    std::optional<asset::PaperCost> cost;                           ///< of drawing `paper` on the CPU
    Json proof = Json::object();  ///< what the compiler proved; empty where the file is an asset
    Stages stages;
};

/// Reads `.vtm` files as assets and all others as SVG; warnings go to stderr. An SVG is compiled only
/// if `compile`. Throws the modules' exceptions.
Source loadSource(const std::string& path, const SourceOptions& options, bool compile = true);

}  // namespace vtm::tools
