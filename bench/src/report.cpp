// bench_report SUBCOMMAND [--examples] [--only NAME] [--font FILE] [--largest N] [--output FOLDER] ...

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include <fmt/core.h>

#include "bench/src/reports.hpp"

namespace vtm::bench {
namespace {

constexpr const char* usage =
    "bench_report peers|drawing|compression|editing|openvg|paper|scaling|sweep [OPTIONS]\n\n"
    "  --examples        our own drawings only, not the corpus\n"
    "  --only NAME       this file only\n"
    "  --font FILE       the font whose glyphs are compressed (a DejaVu Sans, if there is one)\n"
    "  --largest N       curves of the largest scene of `scaling` (1000000)\n"
    "  --side N          pixels of the longer side in `drawing` and `paper` (1024)\n"
    "  --pictures FOLDER where `drawing` and `paper` write what they draw (nowhere)\n"
    "  --node FOLDER     holds node_modules with peers of `drawing` ($VTM_BENCH_NODE)\n"
    "  --peer COMMAND    one more peer process of `drawing`; may be repeated\n"
    "  --output FOLDER   where the results go (bench/results)\n";

struct Arguments {
    std::string subcommand, only, font, output = VTM_SOURCE_DIR "/bench/results";
    bool examples = false;
    std::size_t largest = 1'000'000;
    DrawingOptions drawing;
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    if (argc < 2)
        throw std::invalid_argument("a subcommand is missing");
    a.subcommand = argv[1];
    if (const char* folder = std::getenv("VTM_BENCH_NODE"))
        a.drawing.nodeModules = folder;
    for (int i = 2; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "--examples") {
            a.examples = true;
            continue;
        }
        if (++i == argc)
            throw std::invalid_argument(option + ": its value is missing");
        if (option == "--only")
            a.only = argv[i];
        else if (option == "--font")
            a.font = argv[i];
        else if (option == "--output")
            a.output = argv[i];
        else if (option == "--largest")
            a.largest = std::stoul(argv[i]);
        else if (option == "--side")
            a.drawing.side = std::stoi(argv[i]);
        else if (option == "--pictures")
            a.drawing.pictures = argv[i];
        else if (option == "--node")
            a.drawing.nodeModules = argv[i];
        else if (option == "--peer")
            a.drawing.peers.emplace_back(argv[i]);
        else
            throw std::invalid_argument(option + " is no option");
    }
    return a;
}

std::vector<File> filesOf(const Arguments& a) {
    std::vector<File> files = exampleFiles();
    if (!a.examples)
        for (const File& file : corpusFiles())
            files.push_back(file);
    if (!a.only.empty())
        std::erase_if(files, [&](const File& file) { return file.name != a.only; });
    return files;
}

Report reportOf(const Arguments& a) {
    if (a.subcommand == "peers")
        return peers(filesOf(a));
    if (a.subcommand == "drawing")
        return drawing(filesOf(a), a.drawing);
    if (a.subcommand == "compression")
        return compression(filesOf(a), a.font);
    if (a.subcommand == "editing")
        return editing(filesOf(a));
    if (a.subcommand == "openvg")
        return openvg(filesOf(a));
    if (a.subcommand == "paper")
        return paper(a.drawing);
    if (a.subcommand == "scaling")
        return scaling(a.largest);
    if (a.subcommand == "sweep")
        return sweep(filesOf(a));
    throw std::invalid_argument(a.subcommand + " is no subcommand");
}

}  // namespace
}  // namespace vtm::bench

int main(int argc, char** argv) {
    try {
        const auto arguments = vtm::bench::parse(argc, argv);
        vtm::bench::write(vtm::bench::reportOf(arguments), arguments.output);
        return 0;
    } catch (const std::invalid_argument& error) {
        fmt::print(stderr, "bench_report: {}\n\n{}", error.what(), vtm::bench::usage);
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_report: {}\n", error.what());
        return 1;
    }
}
