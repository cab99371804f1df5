/// \file
/// Figures as text or JSON.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include <vtm/asset/asset.hpp>
#include "paper/compile.hpp"
#include "tools/input/source.hpp"
#include "tools/process/stages.hpp"

namespace vtm::tools {

/// Keys keep the order in which they were given.
using Json = nlohmann::ordered_json;

Json toJson(const Stages& stages);

/// The figures that `compile`, `info` and `render` share.
Json figures(const asset::Asset& asset);
/// How far boundaries may be off, and where that could not be proven.
Json figures(const Proof& proof);
/// Those of paper mode.
Json figures(const paper::CompileResult& paper);
/// What a pixel's lookup touched, on the mean.
Json perPixel(const paper::Cost& cost, std::uint64_t pixels);

/// As JSON with a line end: on one line, or indented. What is no UTF-8, in names of files, is replaced.
std::string jsonLine(const Json& object);
std::string jsonText(const Json& object);

/// One `key: value` a line; nested objects indented.
std::string toText(const Json& object, int indent = 0);

}  // namespace vtm::tools
