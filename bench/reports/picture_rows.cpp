#include "bench/reports/picture_rows.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "bench/measure/measure.hpp"

namespace vtm::bench {
namespace {

constexpr const char* absent = "-";

}  // namespace

void removeEmptyColumns(const Contenders& all, Json& rows) {
    for (const Contender& one : all) {
        const std::string& name = one.engine->name();
        if (std::ranges::all_of(rows, [&](const Json& row) { return row[name] == absent; }))
            for (Json& row : rows)
                row.erase(name);
    }
}

Json pictureRow(Contenders& all, const LoadedFile& picture, const Kind& kind, const std::string& heading,
                const Options& options, std::vector<std::string>& notes) {
    prepare(all, picture, {&kind, 1}, options, notes);
    takeTurns(all, picture, kind, options.side, patienceOf(options), notes);
    Json row{{heading, picture.file.name}};
    const double ours = median(reference(all).times);
    for (const Contender& one : all) {
        const double time = median(one.times);
        row[one.engine->name()] = one.times.empty() ? absent
                                  : one.ours        ? fmt::format("{:.3g}", time)
                                                    : fmt::format("{:.3g} ({:.3g})", time, time / ours);
    }
    return row;
}

std::string descriptionsOf(const Contenders& all) {
    std::string text;
    for (const Contender& one : all)
        text += fmt::format("\n- `{}`: {}", one.engine->name(), one.engine->description());
    return text + "\n";
}

}  // namespace vtm::bench
