#include <fmt/core.h>

#include "bench/engines/contest.hpp"
#include "bench/measure/measure.hpp"

namespace vtm::bench {

Report sides(const Options& options) {
    Report report;
    report.name = "sides";
    report.title = "Growth over the number of pixels";
    Contenders all = contenders(options, report.notes);
    report.text = fmt::format(
        "One file, turning as in `drawing`, on rasters of 64² to 8192² pixels: CPU milliseconds, all taking "
        "turns; "
        "in brackets how many times as long as `{}`, median of the rounds.",
        reference(all).engine->name());
    for (const File& file : oneFileOf(options)) {
        const LoadedFile picture{file, load(file)};
        prepare(all, picture, {}, options, report.notes);
        for (int side = 64; side <= 8192; side *= 2) {
            fmt::print(stderr, "{} at {}\n", file.name, side);
            const Kind kind{.name = "turning"};
            takeTurns(all, picture, kind, side, patienceOf(options), report.notes);
            Json line = {{"file", file.name}, {"side", side}};
            for (const Contender& one : all) {
                line[one.engine->name()] = "-";
                if (one.times.empty() || reference(all).times.empty())
                    continue;
                std::vector<double> ratios;
                for (std::size_t i = 0; i < std::min(one.times.size(), reference(all).times.size()); ++i)
                    ratios.push_back(one.times[i] / reference(all).times[i]);
                line[one.engine->name()] = fmt::format("{:.3g} ({:.3g})", median(one.times), median(ratios));
                report.rows.push_back({{"file", file.name},
                                       {"side", side},
                                       {"engine", one.engine->name()},
                                       {"ms", median(one.times)},
                                       {"low", quantile(one.times, 0.25)},
                                       {"high", quantile(one.times, 0.75)},
                                       {"ratio", median(ratios)},
                                       {"rounds", one.times.size()}});
            }
            report.summary.push_back(line);
        }
    }
    return report;
}

}  // namespace vtm::bench
