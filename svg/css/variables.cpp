#include "svg/css/variables.hpp"

#include <algorithm>

#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

/// Where the next var( begins; npos if there is none.
std::size_t findVariable(std::string_view text, std::size_t from) {
    constexpr std::string_view name = "var(";
    for (std::size_t i = from; i + name.size() <= text.size(); ++i)
        if (equalsIgnoringCase(text.substr(i, name.size()), name) && (i == 0 || !isIdentifier(text[i - 1])))
            return i;
    return text.npos;
}

constexpr std::size_t maxLength = 1u << 16;  ///< of a value

}  // namespace

bool hasVariables(std::string_view value) { return findVariable(value, 0) != value.npos; }

std::optional<std::string> Variables::substituted(std::string_view value) const {
    Work work;
    return substituted(value, work);
}

std::optional<std::string> Variables::substituted(std::string_view value, Work& work) const {
    if (work.depth == 0)
        return std::nullopt;
    --work.depth;
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = findVariable(value, 0); at != value.npos; at = findVariable(value, done)) {
        result += value.substr(done, at - done);
        const std::string_view inner = value.substr(at + 4);
        const std::size_t size = extentOf(inner, ")");
        const auto replaced = valueOf(inner.substr(0, size), work);
        if (!replaced || result.size() + replaced->size() > maxLength)
            return std::nullopt;
        result += *replaced;
        done = std::min(value.size(), at + 4 + size + 1);
    }
    ++work.depth;
    return result += value.substr(done);
}

std::optional<std::string> Variables::valueOf(std::string_view reference, Work& work) const {
    const std::size_t comma = reference.find(',');
    const int depth = work.depth;
    if (auto value = find(trim(reference.substr(0, comma)), work))
        return value;
    work.depth = depth;
    return comma == reference.npos ? std::nullopt : substituted(trim(reference.substr(comma + 1)), work);
}

std::optional<std::string> Variables::find(std::string_view name, Work& work) const {
    if (--work.lookups < 0)
        return std::nullopt;
    for (const Variables* level = this; level; level = level->parent_.get())
        if (const auto found = level->own_.find(name); found != level->own_.end())
            return level->replaced(*found, work);
    return std::nullopt;
}

/// In its own element's surroundings. All variables of a circle have no value, whatever their fallbacks.
std::optional<std::string> Variables::replaced(const Declared& variable, Work& work) const {
    const std::pair self(this, variable.first);
    const std::size_t index = work.open.size();
    if (const auto same = std::ranges::find(work.open, self); same != work.open.end()) {
        work.circle = std::min(work.circle, static_cast<std::size_t>(same - work.open.begin()));
        return std::nullopt;
    }
    work.open.push_back(self);
    auto value = substituted(variable.second, work);
    work.open.pop_back();
    const bool isInCircle = work.circle <= index;
    if (work.circle == index)
        work.circle = Work::none;
    return isInCircle ? std::nullopt : std::move(value);
}

}  // namespace vtm::svg
