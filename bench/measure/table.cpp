#include "bench/measure/table.hpp"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/core.h>

#include <vtm/gl/context.hpp>
#include <vtm/image/codec.hpp>

namespace vtm::bench {

namespace {

/// What follows `key` and the separator in the first line that begins with it.
std::string valueOf(const char* file, const std::string& key, char separator) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(key))
            if (const auto at = line.find(separator); at != line.npos) {
                const auto first = line.find_first_not_of(" \t\"", at + 1);
                return first == line.npos ? ""
                                          : line.substr(first, line.find_last_not_of(" \t\"") - first + 1);
            }
    return "unknown";
}

std::string driver() {
    try {
        const gl::Context context;
        return context.renderer() + ", " + context.version();
    } catch (const gl::GlError&) {
        return "none";
    }
}

std::string date() {
    char text[32];
    const std::time_t now = std::time(nullptr);
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
    return text;
}

/// Processor, cores, memory, system, compiler, driver of OpenGL, load and date, as an object of strings and
/// numbers. Nothing that names a machine or its user.
Json machineFacts() {
    double load = -1;
    getloadavg(&load, 1);
    return {{"processor", valueOf("/proc/cpuinfo", "model name", ':')},
            {"cores", std::thread::hardware_concurrency()},
            {"memory", valueOf("/proc/meminfo", "MemTotal", ':')},
            {"system", valueOf("/etc/os-release", "PRETTY_NAME", '=')},
            {"compiler", "C++ compiler " __VERSION__},
            {"driver", driver()},
            {"load", load},
            {"date", date()}};
}

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
