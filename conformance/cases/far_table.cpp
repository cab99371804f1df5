// Lists drawn points that lie far from every true outline: there are none in a sound asset.
// conformance_far [--points N] [--tolerance T] [FILE.svg...], of the corpus and the examples without files

#include <algorithm>
#include <exception>
#include <string_view>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/pick.hpp>
#include "asset/walk.hpp"
#include "conformance/cases/distances.hpp"
#include "conformance/cases/support.hpp"

namespace {

using namespace vtm;
using namespace vtm::cases;

struct Arguments {
    int points = 20'000;
    compiler::Options options;
    std::vector<std::filesystem::path> files;
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--points" && i + 1 < argc)
            a.points = std::stoi(argv[++i]);
        else if (word == "--tolerance" && i + 1 < argc)
            a.options.tolerance = std::stod(argv[++i]);
        else
            a.files.emplace_back(word);
    }
    if (a.files.empty())
        for (const auto& directory : {sharedDirectory() / "corpus", examplesDirectory()})
            if (std::filesystem::exists(directory))
                for (const auto& entry : std::filesystem::directory_iterator(directory))
                    if (entry.path().extension() == ".svg")
                        a.files.push_back(entry.path());
    std::sort(a.files.begin(), a.files.end());
    return a;
}

/// The leaf that a point lies in, and the topmost item there.
std::string describe(scene::Point p, const asset::Asset& asset, const compiler::PickMap& items) {
    const asset::Map& map = asset.maps.front();
    const asset::SquareAt at = asset::squareAt(asset, map.root, (p - scene::Point(map.x, map.y)) / map.side);
    const auto item = compiler::itemAt(items, p);
    const bool isStroke = item && std::holds_alternative<scene::StrokeStyle>(items.items[*item]->geometry);
    return fmt::format("{:.9g},{:.9g}  leaf {} of level {} at {},{}  {} {}", p.x, p.y,
                       at.entry.kind() == asset::Entry::Kind::Leaf ? int(at.entry.payload()) : -1,
                       at.cell.level, at.cell.x, at.cell.y, isStroke ? "stroke" : "fill",
                       item ? int(*item) : -1);
}

void printFile(const std::filesystem::path& file, const Arguments& a) {
    constexpr std::uint64_t seed = 1;
    const scene::Scene scene = loadScene(file);
    const asset::Asset asset = compiler::compile(scene, a.options).asset;
    const double tolerance = a.options.tolerance * std::max(scene.width, scene.height);
    const FarPoints far = farPoints(scene, asset, tolerance, seed, a.points);
    fmt::print("{:<16} {:>7} {:>7}\n", file.stem().string(), far.looked, far.at.size());
    if (far.at.empty())
        return;
    const compiler::PickMap items = compiler::compilePickMap(scene, a.options);
    for (const scene::Point& p : far.at)
        fmt::print("    {}\n", describe(p, asset, items));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Arguments arguments = parse(argc, argv);
        fmt::print("{:<16} {:>7} {:>7}\n", "file", "points", "far");
        for (const std::filesystem::path& file : arguments.files)
            printFile(file, arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "conformance_far: {}\n", error.what());
        return 1;
    }
    return 0;
}
