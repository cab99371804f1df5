#include "tools/commands/report.hpp"

#include <cmath>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace vtm::tools {

namespace {

std::string dumped(const Json& object, int indent) {
    return object.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string numberText(double number) {
    constexpr double small = 0.01;  // two decimals would not show it
    return number != 0 && std::abs(number) < small ? fmt::format("{:.3g}", number)
                                                   : fmt::format("{:.2f}", number);
}

std::string valueText(const Json& value) {
    if (value.is_number_float())
        return numberText(value.get<double>());
    return value.is_string() ? value.get<std::string>()
                             : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Json toJson(const Stages& stages) {
    Json json = Json::object();
    for (const auto& [stage, milliseconds] : stages)
        json[stage] = milliseconds;
    return json;
}

Json figures(const asset::Asset& asset) {
    const asset::Summary summary = asset::summarize(asset);
    const asset::PyramidSize& prefilter = asset.prefilter.size;
    return {{"bytes", summary.bytes},
            {"prefilter_bytes", summary.prefilterBytes},
            {"prefilter_width", prefilter.width},
            {"prefilter_height", prefilter.height},
            {"leaves", summary.leaves},
            {"solids", summary.solids},
            {"pieces", summary.pieces},
            {"fallback_leaves", asset.fallbackLeaves},
            {"regions", summary.regions},
            {"instances", summary.instances},
            {"glyphs", summary.glyphs},
            {"images", asset.images.size()},
            {"filters", asset.filters.size()},
            {"filter_pixels", asset.filterPixels},
            {"max_depth", summary.maxDepth}};
}

Json figures(const Proof& proof) {
    Json unproven = Json::array();
    for (const compiler::UnprovenSquare& s : proof.unproven)
        unproven.push_back({{"x", s.x}, {"y", s.y}, {"side", s.side}});
    return {{"proven_error", proof.error},
            {"unproven_squares", unproven},
            {"sampled_strokes", proof.sampledStrokes}};
}

Json figures(const paper::CompileResult& paper) {
    const paper::Summary summary = paper::summarize(paper.asset);
    return {{"bytes", summary.bytes},
            {"prefilter_bytes", summary.mipBytes},
            {"tree_bytes", summary.treeBytes},
            {"grid_bytes", summary.gridBytes},
            {"masks", summary.masks},
            {"nodes", summary.nodes},
            {"indirections", summary.indirections},
            {"cells", summary.cells},
            {"pieces", summary.pieces},
            {"approximated_cells", paper.approximatedCells()}};
}

Json perPixel(const paper::Cost& cost, std::uint64_t pixels) {
    const auto share = [&](std::uint64_t count) { return double(count) / double(pixels); };
    return {{"nodes", share(cost.nodes)},
            {"masks", share(cost.masks)},
            {"indirections", share(cost.indirections)},
            {"cells", share(cost.cells)},
            {"mips", share(cost.mips)},
            {"paints", share(cost.paints)}};
}

std::string jsonLine(const Json& object) { return dumped(object, -1); }
std::string jsonText(const Json& object) { return dumped(object, 2); }

std::string toText(const Json& object, int indent) {
    std::string text;
    for (const auto& [key, value] : object.items()) {
        const std::string line = fmt::format("{:{}}{}:", "", indent, key);
        if (value.is_object())
            text += line + "\n" + toText(value, indent + 2);
        else
            text += fmt::format("{} {}\n", line, valueText(value));
    }
    return text;
}

}  // namespace vtm::tools
