#include "bench/measure/machine.hpp"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include <vtm/gl/context.hpp>

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

}  // namespace

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

}  // namespace vtm::bench
