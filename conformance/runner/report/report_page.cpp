#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <vtm/image/codec.hpp>
#include "conformance/runner/report/report.hpp"
#include "conformance/runner/report/row_json.hpp"
#include "conformance/runner/suite/suite.hpp"

namespace vtm::conformance {
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
