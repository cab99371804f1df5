#include "tools/src/left_out.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vtm::tools {

namespace {

using Kind = svg::Warning::Kind;

std::string placeOf(const svg::Location& where) {
    return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

bool isNotDrawnYet(const svg::Warning& warning) {
    return warning.kind == Kind::Text || warning.kind == Kind::Filter;
}

std::string counted(const svg::Warning& warning) {
    const char* one = warning.kind == Kind::Text ? "text element" : "filter";
    return fmt::format("{} {}{}", warning.count, one, warning.count == 1 ? "" : "s");
}

/// Named at the first in the file.
void warnOfNotDrawnYet(Source& source, const std::vector<svg::Warning>& warnings) {
    std::vector<std::string> what;
    const svg::Warning* first = nullptr;
    std::size_t count = 0;
    for (const svg::Warning& warning : warnings) {
        if (!isNotDrawnYet(warning))
            continue;
        // Text before filters, whichever comes first.
        what.insert(warning.kind == Kind::Text ? what.begin() : what.end(), counted(warning));
        if (!first || std::pair(warning.where.line, warning.where.column) <
                          std::pair(first->where.line, first->where.column))
            first = &warning;
        count += warning.count;
    }
    if (first)
        warnOf(source, fmt::format("{}: warning: {} {} not drawn yet", placeOf(first->where),
                                   fmt::join(what, " and "), count == 1 ? "is" : "are"));
}

}  // namespace

void warnOf(Source& source, const std::string& message) {
    warn(message);
    ++source.leftOut;
}

void warnOf(Source& source, const std::vector<svg::Warning>& warnings) {
    warnOfNotDrawnYet(source, warnings);
    for (const svg::Warning& warning : warnings)
        if (!isNotDrawnYet(warning))
            warnOf(source, fmt::format("{}: warning: {}", placeOf(warning.where), warning.message));
}

void refuseLeftOut(const Source& source) {
    if (source.leftOut > 0)
        throw std::runtime_error("--strict: something is left out, see above");
}

}  // namespace vtm::tools
