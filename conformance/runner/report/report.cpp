#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <vtm/image/codec.hpp>
#include "conformance/runner/report/report.hpp"
#include "conformance/runner/suite/suite.hpp"

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

}  // namespace

void writeJson(const std::filesystem::path& file, const std::vector<Row>& rows) {
    nlohmann::ordered_json json{{"summary", summaryJson(summarize(rows))}};
    json["cases"] = nlohmann::ordered_json::array();
    for (const Row& row : rows)
        json["cases"].push_back(rowJson(row));
    writeText(file, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

namespace {

/// Characters that XML 1.0 has no way to write become question marks.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '"')
            result += "&quot;";
        else if (c == '\n')
            result += "&#10;";
        else
            result += std::uint8_t(c) < 0x20 ? '?' : c;
    return result;
}

std::string testcase(const Row& row) {
    const char* const element = row.verdict == Verdict::Failed ? "failure" : "skipped";
    std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                                   escaped(row.suite), escaped(row.name), row.seconds);
    if (row.verdict == Verdict::Passed)
        return text + "/>\n";
    return text + fmt::format("><{} message=\"{}: {}\"/></testcase>\n", element, nameOf(row.verdict),
                              escaped(row.message));
}

std::string testsuite(const std::string& suite, const std::vector<Row>& rows) {
    const Summary s = summarize(rows);
    double seconds = 0;
    std::string cases;
    for (const Row& row : rows) {
        seconds += row.seconds;
        cases += testcase(row);
    }
    return fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n{}"
        "  </testsuite>\n",
        escaped(suite), rows.size(), s.failed, s.skipped + s.expectedFailures, seconds, cases);
}

}  // namespace

void writeJunit(const std::filesystem::path& file, const std::vector<Row>& rows) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    for (auto first = rows.begin(); first != rows.end();) {
        const auto last =
            std::find_if(first, rows.end(), [&](const Row& row) { return row.suite != first->suite; });
        text += testsuite(first->suite, {first, last});
        first = last;
    }
    writeText(file, text + "</testsuites>\n");
}

namespace fs = std::filesystem;

namespace {

using image::Bitmap;
using image::Raster;

/// Black, blue, red, yellow, white for 0, 1, 4, 16, 64 and more of 255: a step is a factor of four.
void heatColour(double error, std::uint8_t* rgba) {
    constexpr double stops[][3] = {{0, 0, 0}, {40, 60, 200}, {220, 30, 40}, {250, 220, 40}, {255, 255, 255}};
    const double place = error < 1 ? error : std::min(4.0, 1 + std::log2(error) / 2);
    const int below = std::min(3, int(place));
    for (int c = 0; c < 3; ++c)
        rgba[c] = std::uint8_t(
            std::lround(stops[below][c] + (place - below) * (stops[below + 1][c] - stops[below][c])));
    rgba[3] = 255;
}

Bitmap heatMap(const Raster& a, const Raster& b) {
    Bitmap map{a.width, a.height, std::vector<std::uint8_t>(a.rgba.size())};
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        double worst = 0;
        for (std::size_t c = 0; c < 4; ++c)
            worst = std::max(worst, 255 * std::abs(double(a.rgba[i + c]) - double(b.rgba[i + c])));
        heatColour(std::isnan(worst) ? 255 : worst, &map.rgba[i]);
    }
    return map;
}

}  // namespace

Report::Report(fs::path folder) : folder_(std::move(folder)) { fs::create_directories(folder_); }

void Report::addPictures(Row& row) const {
    if (!row.outcome.pictures)
        return;
    const Pictures& shown = *row.outcome.pictures;
    const auto write = [&](const char* what, const Bitmap& bitmap) {
        const std::string name = fmt::format("{}.{}.png", row.name, what);
        image::writeFile((folder_ / name).string(), image::encodePng(bitmap));
        row.pictures.push_back(name);
    };
    write("expected", image::toBitmap(shown.expected));
    write("drawn", image::toBitmap(shown.drawn));
    if (shown.expected.width == shown.drawn.width && shown.expected.height == shown.drawn.height) {
        write("difference", compare::differencePicture(shown.expected, shown.drawn));
        write("heat", heatMap(shown.expected, shown.drawn));
    }
    row.outcome.pictures.reset();
}

void Report::writePage(const std::vector<Row>& rows) const {
    nlohmann::ordered_json data{{"summary", summaryJson(summarize(rows))}};
    data["cases"] = nlohmann::ordered_json::array();
    for (const Row& row : rows)
        data["cases"].push_back(rowJson(row));
    std::string json = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3)
        json.replace(at, 2, "<\\/");  // would end the script
    std::string page = readText(fs::path(VTM_SOURCE_DIR) / "conformance/runner/report.html");
    const std::string place = "/*DATA*/null";
    page.replace(page.find(place), place.size(), json);
    writeText(folder_ / "index.html", page);
}

}  // namespace vtm::conformance
