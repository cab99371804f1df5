#include <cmath>

#include <vtm/image/codec.hpp>
#include "conformance/runner/report/report.hpp"
#include "conformance/runner/report/row_json.hpp"

namespace vtm::conformance {
namespace {

/// JSON has no infinity.
nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json("infinite");
}

nlohmann::ordered_json figureJson(const Figure& figure) {
    return {{"engine", figure.engine},
            {"view", figure.view},
            {"max", number(figure.difference.max)},
            {"mean", number(figure.difference.mean)},
            {"rms", number(figure.difference.rms)},
            {"p999", number(figure.difference.p999)},
            {"flat", number(figure.flat)},
            {"broken", figure.broken}};
}

}  // namespace

nlohmann::ordered_json rowJson(const Row& row) {
    nlohmann::ordered_json json{
        {"name", row.name},       {"suite", row.suite}, {"verdict", nameOf(row.verdict)},
        {"message", row.message}, {"about", row.about}, {"seconds", row.seconds}};
    json["worst"] = nlohmann::ordered_json::array();
    for (const Figure& figure : row.outcome.figures)
        json["worst"].push_back(figureJson(figure));
    if (!row.pictures.empty())
        json["pictures"] = row.pictures;
    return json;
}

nlohmann::ordered_json summaryJson(const Summary& summary) {
    return {{"passed", summary.passed},
            {"failed", summary.failed},
            {"skipped", summary.skipped},
            {"expected_failures", summary.expectedFailures}};
}

void writeText(const std::filesystem::path& file, const std::string& text) {
    image::writeFile(file.string(), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void writeJson(const std::filesystem::path& file, const std::vector<Row>& rows) {
    nlohmann::ordered_json json{{"summary", summaryJson(summarize(rows))}};
    json["cases"] = nlohmann::ordered_json::array();
    for (const Row& row : rows)
        json["cases"].push_back(rowJson(row));
    writeText(file, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace vtm::conformance
