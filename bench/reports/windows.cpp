// Frames on windows. Each size is a fresh process, on an X server of its own where DISPLAY names none.

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include <fmt/core.h>

#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

struct Size {
    int width, height;
};
constexpr std::array sizes{Size{1280, 720}, Size{1920, 1080}};
constexpr std::array kinds{"swap", "video", "video with alpha"};

/// The lines of bench_windows; empty where it cannot run.
[[maybe_unused]] std::string framesOf(const char* program, Size size, int frames) {
    const std::string run = fmt::format("'{}' {} {} {}", program, size.width, size.height, frames);
    const std::string command =
        "if [ -n \"$DISPLAY\" ]; then exec " + run +
        "; elif command -v xvfb-run >/dev/null; then exec xvfb-run -a -s '-screen 0 2048x1200x24' " + run +
        "; fi 2>/dev/null";
    std::FILE* const pipe = popen(("EGL_PLATFORM=x11; export EGL_PLATFORM; " + command).c_str(), "r");
    if (!pipe)
        throw std::runtime_error("no process could be started");
    std::string text;
    for (char buffer[4096]; std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe);)
        text.append(buffer, count);
    return pclose(pipe) == 0 ? text : "";
}

std::string columnOf(Size size, const std::string& kind) {
    return fmt::format("{}, {} × {}, ms", kind, size.width, size.height);
}

/// That of a format: the one that there is, or a new one.
Json& rowOf(const std::string& format, Report& report) {
    for (Json& row : report.rows)
        if (row["surface"] == format)
            return row;
    Json row{{"surface", format}};
    for (const Size& size : sizes)
        for (const char* kind : kinds)
            row[columnOf(size, kind)] = "";
    return report.rows.emplace_back(std::move(row));
}

void addFrames(const std::string& lines, Size size, Report& report) {
    std::istringstream stream(lines);
    std::string format, kind, time;
    while (std::getline(stream, format, '\t') && std::getline(stream, kind, '\t') &&
           std::getline(stream, time))
        rowOf(format, report)[columnOf(size, kind)] = std::stod(time);
}

}  // namespace

Report windows([[maybe_unused]] const Options& options) {
    Report report;
    report.name = "windows";
    report.title = "Frames on windows";
    report.text =
        "OpenVG by our EGL on an X server: CPU milliseconds of the program a frame, medians. Swap: a corner "
        "changes and the window is swapped. Video: an opaque image of the window's size is uploaded "
        "(vgImageSubData), drawn and shown, without alpha (VG_sXBGR_8888) and with an alpha of 1 "
        "(VG_sRGBA_8888). What the server takes is not counted.";
#ifdef VTM_BENCH_WINDOWS
    for (const Size& size : sizes) {
        const std::string lines = framesOf(VTM_BENCH_WINDOWS, size, options.quick ? 15 : 60);
        if (lines.empty())
            report.notes.push_back(fmt::format("{} × {}: missing, no X server could be used (xvfb, xauth).",
                                               size.width, size.height));
        addFrames(lines, size, report);
    }
#else
    report.notes.push_back("missing, built without Xlib (libx11-dev).");
#endif
    return report;
}

}  // namespace vtm::bench
