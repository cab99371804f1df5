#include "tools/src/report.hpp"

#include <cmath>
#include <exception>
#include <new>

#include <fmt/core.h>

#include "tools/src/limits.hpp"
#include "tools/src/progress.hpp"

namespace vtm::tools {

namespace {

std::string withPath(const std::string& path, const std::string& what) {
    return what.find(path) != std::string::npos ? what : path + ": " + what;
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
            {"max_depth", summary.maxDepth}};
}

Json figures(const compiler::Result& result) {
    Json unproven = Json::array();
    for (const compiler::UnprovenSquare& s : result.unproven)
        unproven.push_back({{"x", s.x}, {"y", s.y}, {"side", s.side}});
    return {{"proven_error", result.provenError},
            {"unproven_squares", unproven},
            {"sampled_strokes", result.sampledStrokes}};
}

Json figures(const compiler::PaperResult& paper) {
    const asset::PaperSummary summary = asset::summarize(paper.asset);
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

Json perPixel(const asset::PaperCost& cost, std::uint64_t pixels) {
    const auto share = [&](std::uint64_t count) { return double(count) / double(pixels); };
    return {{"nodes", share(cost.nodes)},
            {"masks", share(cost.masks)},
            {"indirections", share(cost.indirections)},
            {"cells", share(cost.cells)},
            {"mips", share(cost.mips)},
            {"paints", share(cost.paints)}};
}

void printText(const Json& object, int indent) {
    for (const auto& [key, value] : object.items()) {
        if (value.is_object()) {
            fmt::print("{:{}}{}:\n", "", indent, key);
            printText(value, indent + 2);
        } else if (value.is_number_float()) {
            const double number = value.get<double>();
            constexpr double small = 0.01;  // two decimals would not show it
            if (number != 0 && std::abs(number) < small)
                fmt::print("{:{}}{}: {:.3g}\n", "", indent, key, number);
            else
                fmt::print("{:{}}{}: {:.2f}\n", "", indent, key, number);
        } else {
            fmt::print("{:{}}{}: {}\n", "", indent, key,
                       value.is_string() ? value.get<std::string>() : value.dump());
        }
    }
}

void printWarning(const std::string& message) {
    clearProgress();
    fmt::print(stderr, "{}\n", message);
}

std::string describeError(const std::string& path) {
    try {
        throw;
    } catch (const limits::Exceeded& exceeded) {
        return describe(path, exceeded);
    } catch (const std::bad_alloc&) {
        return path + ": not enough memory";
    } catch (const std::exception& error) {
        return withPath(path, error.what());
    }
}

}  // namespace vtm::tools
