#include "bench/measure/table.hpp"

#include <fmt/core.h>

#include <vtm/image/codec.hpp>
#include "bench/measure/machine.hpp"

namespace vtm::bench {
namespace {

std::string cell(const Json& value) {
    if (value.is_number_float())
        return fmt::format("{:.4g}", value.get<double>());
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string said(const Json& value) { return value.get<std::string>(); }

std::string markdown(const Report& report) {
    const Json& rows = report.summary.empty() ? report.rows : report.summary;
    std::string text = "# " + report.title + "\n\n" + report.text + "\n";
    if (!rows.empty()) {
        std::string rule = "|";
        text += "\n|";
        for (const auto& [key, value] : rows[0].items()) {
            text += " " + key + " |";
            rule += value.is_string() ? "---|" : "--:|";
        }
        text += "\n" + rule + "\n";
    }
    for (const Json& row : rows) {
        text += "|";
        for (const Json& value : row)
            text += " " + cell(value) + " |";
        text += "\n";
    }
    for (const std::string& note : report.notes)
        text += "\n" + note + "\n";
    return text;
}

void writeText(const std::filesystem::path& path, const std::string& text) {
    image::writeFile(path.string(), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace

void write(const Report& report, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const Json machine = machineFacts();
    const std::string text =
        markdown(report) + fmt::format("\n{}; {}; {}; {}{}.\n", said(machine["processor"]),
                                       said(machine["system"]), said(machine["driver"]),
                                       said(machine["date"]), report.quick ? "; a quick run" : "");
    const Json json = {{"name", report.name},   {"title", report.title},     {"text", report.text},
                       {"rows", report.rows},   {"summary", report.summary}, {"notes", report.notes},
                       {"quick", report.quick}, {"seconds", report.seconds}, {"machine", machine}};
    writeText(folder / (report.name + ".md"), text);
    writeText(folder / (report.name + ".json"), json.dump(2) + "\n");
    fmt::print("{}\n", text);
}

}  // namespace vtm::bench
