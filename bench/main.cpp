// vtm-bench [REPORT...] [OPTIONS]: docs/benchmarks.md.

#include <sys/auxv.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/gl/context.hpp>
#include "bench/engines/engine.hpp"
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

enum class Conditions { Steady, Usual };

struct Entry {
    const char *name, *text;
    Report (*run)(const Options&);
    Conditions conditions;
    bool slow = false;  ///< not among all in a quick run
};

constexpr Entry entries[] = {
#define REPORT(name, text, conditions, slow) {#name, text, name, conditions, slow},
#include "bench/reports/reports.inc"
#undef REPORT
};

constexpr const char* usage =
    "vtm-bench [REPORT...] [OPTIONS]: these reports, or all, each in a process of its own\n\n"
    "  --list            lists reports and files\n"
    "  --quick           fewer files and rounds: all in ten minutes on two cores; without `sweep`\n"
    "  --examples        our own drawings only, not the corpus\n"
    "  --wall            wall time instead of CPU time in `texture` and `paper`: for GPUs\n"
    "  --only NAME       this file only\n"
    "  --file FILE       this SVG file instead; may be repeated\n"
    "  --filter REGEX    cases of Google Benchmark in `micro` and `pipeline`\n"
    "  --font FILE       the font whose glyphs are compressed (a DejaVu Sans, if there is one)\n"
    "  --largest N       curves of the largest scene of `scaling` (1000000)\n"
    "  --side N          pixels of the longer side (1024)\n"
    "  --pictures FOLDER where `drawing` and `paper` write what they draw (nowhere)\n"
    "  --node FOLDER     holds node_modules with peers ($VTM_BENCH_NODE)\n"
    "  --peer COMMAND    one more peer process; may be repeated\n"
    "  --output FOLDER   where the results go (build/bench)\n";

struct Arguments {
    Options options;
    std::vector<std::string> names;
    std::vector<std::string> rest;  ///< all that is not a name
    std::string output = VTM_SOURCE_DIR "/build/bench";
    bool list = false;
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    Options& o = a.options;
    // As the kernel was asked for it: /proc/self/exe is not everywhere.
    o.program = std::filesystem::absolute(reinterpret_cast<const char*>(getauxval(AT_EXECFN))).string();
    if (const char* folder = std::getenv("VTM_BENCH_NODE"))
        o.nodeModules = folder;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (!option.starts_with("--")) {
            a.names.push_back(option);
            continue;
        }
        a.rest.push_back(option);
        bool* flag = option == "--list"       ? &a.list
                     : option == "--quick"    ? &o.quick
                     : option == "--examples" ? &o.examples
                     : option == "--wall"     ? &o.wall
                                              : nullptr;
        if (flag) {
            *flag = true;
            continue;
        }
        if (++i == argc)
            throw std::invalid_argument(option + ": its value is missing");
        const std::string value = a.rest.emplace_back(argv[i]);
        if (option == "--only")
            o.only = value;
        else if (option == "--file")
            o.files.push_back(std::filesystem::absolute(value).string());
        else if (option == "--filter")
            o.filter = value;
        else if (option == "--font")
            o.font = value;
        else if (option == "--output")
            a.output = value;
        else if (option == "--largest")
            o.largest = std::stoul(value);
        else if (option == "--side")
            o.side = std::stoi(value);
        else if (option == "--pictures")
            o.pictures = value;
        else if (option == "--node")
            o.nodeModules = value;
        else if (option == "--peer")
            o.peers.push_back(value);
        else
            throw std::invalid_argument(option + " is no option");
    }
    return a;
}

const Entry& entryOf(const std::string& name) {
    const auto* found = std::ranges::find_if(entries, [&](const Entry& e) { return name == e.name; });
    if (found == std::end(entries))
        throw std::invalid_argument(name + " is no report");
    return *found;
}

void list(const Options& options) {
    for (const Entry& entry : entries)
        fmt::print("{:<12} {}{}\n", entry.name, entry.text, entry.slow ? " (not in a quick run)" : "");
    fmt::print("\nfiles:");
    for (const File& file : filesOf(options))
        fmt::print(" {}", file.name);
    fmt::print("\n");
}

/// This program again with one report: peaks of memory and faults stay apart. Whether it succeeded.
bool runAlone(const std::string& name, const Arguments& a) {
    std::vector<std::string> words{a.options.program, name};
    words.insert(words.end(), a.rest.begin(), a.rest.end());
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    fmt::print(stderr, "-- {}\n", name);
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        execv(pointers[0], pointers.data());
        _exit(127);
    }
    int status = -1;
    return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

int runAll(std::vector<std::string> names, const Arguments& a) {
    if (names.empty())
        for (const Entry& entry : entries)
            if (!a.options.quick || !entry.slow)
                names.emplace_back(entry.name);
    for (const std::string& name : names)
        entryOf(name);
    int failed = 0;
    for (const std::string& name : names)
        if (!runAlone(name, a)) {
            fmt::print(stderr, "vtm-bench: {} failed\n", name);
            ++failed;
        }
    return failed == 0 ? 0 : 1;
}

/// Ours and the libraries that are linked in, as a peer process.
void serveOne(const std::string& name) {
    std::vector<std::string> missing;
    Engines engines = name == "scan"      ? scanEngines()
                      : name == "cairo"   ? cairoEngines(missing)
                      : name == "librsvg" ? rsvgEngines(missing)
                                          : glEngines();
    std::erase_if(engines, [&](const auto& engine) { return engine->name() != name; });
    for (const std::string& note : missing)
        fmt::print("missing {}\n", note);
    std::fflush(stdout);
    serve(std::move(engines));
}

int run(const Arguments& a) {
    if (a.options.wall)
        measureWallTime();
    if (a.list) {
        list(a.options);
        return 0;
    }
    if (a.names.size() == 1 && a.names[0] == "driver") {
        fmt::print("{}\n", gl::Context().renderer());
        return 0;
    }
    if (a.names.size() == 2 && a.names[0] == "serve") {
        serveOne(a.names[1]);
        return 0;
    }
    if (a.names.size() == 2 && a.names[0] == "start") {
        startOnce(a.names[1], a.options);
        return 0;
    }
    if (a.names.size() != 1)
        return runAll(a.names, a);
    const Entry& entry = entryOf(a.names[0]);
    if (entry.conditions == Conditions::Steady && !a.options.wall)
        useSteadyConditions();
    const double start = wallMilliseconds();
    Report report = entry.run(a.options);
    report.seconds = (wallMilliseconds() - start) / 1000;
    report.quick = a.options.quick;
    if (a.options.wall)
        report.notes.push_back("Times are wall time.");
    write(report, a.output);
    return 0;
}

}  // namespace
}  // namespace vtm::bench

int main(int argc, char** argv) {
    try {
        return vtm::bench::run(vtm::bench::parse(argc, argv));
    } catch (const std::invalid_argument& error) {
        fmt::print(stderr, "vtm-bench: {}\n\n{}", error.what(), vtm::bench::usage);
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "vtm-bench: {}\n", error.what());
        return 1;
    }
}
