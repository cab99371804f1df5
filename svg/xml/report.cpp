#include "svg/xml/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "svg/css/cursor.hpp"

namespace vtm::svg {

namespace {

constexpr const char* moreAreLeftOut = "more warnings are left out";

}  // namespace

ParseError::ParseError(Location where, const std::string& what)
    : Error(fmt::format("{}:{}:{}: {}", where.file, where.line, where.column, what)),
      where_(std::move(where)) {}

SourceMap::SourceMap(std::string fileName, std::string_view source)
    : fileName_(std::move(fileName)), lineStarts_{0} {
    for (std::size_t i = source.find('\n'); i != source.npos; i = source.find('\n', i + 1))
        lineStarts_.push_back(i + 1);
}

Location SourceMap::atSource(std::size_t sourceOffset) const {
    const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), sourceOffset);
    return {fileName_, static_cast<int>(next - lineStarts_.begin()),
            static_cast<int>(sourceOffset - next[-1]) + 1};
}

Location SourceMap::at(std::size_t parsedOffset) const {
    const auto next =
        std::upper_bound(pieces_.begin(), pieces_.end(), parsedOffset,
                         [](std::size_t offset, const TextPart& piece) { return offset < piece.parsed; });
    if (next == pieces_.begin())
        return atSource(parsedOffset);
    const TextPart& piece = next[-1];
    return atSource(piece.source + (piece.fixed ? 0 : parsedOffset - piece.parsed));
}

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::size_t size = std::min(text.size(), longest);
    const auto isInsideCharacter = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
    while (size < text.size() && size > 0 && isInsideCharacter(text[size]))
        --size;
    std::string shown(text.substr(0, size));
    std::replace_if(shown.begin(), shown.end(), isSpace, ' ');
    return fmt::format("\"{}{}\"", shown, size < text.size() ? "…" : "");
}

void Reporter::warnInvalid(const Element& element, std::string_view attribute, std::string_view value) {
    warn(Warning::Kind::Value, element,
         fmt::format("{}={} is not valid; it is ignored", attribute, quoted(value)));
}

limits::Place Reporter::placeOf(const Element& element) const {
    const Location at = map_.at(element.offset);
    return {static_cast<std::uint32_t>(at.line), static_cast<std::uint32_t>(at.column), nameOf(element.tag)};
}

bool Reporter::wasSeen(const Element& element, const std::string& message) {
    return !seen_.insert(fmt::format("{} {}", element.offset, message)).second;
}

bool Reporter::isFull() const { return !warnings_.empty() && warnings_.back().message == moreAreLeftOut; }

void Reporter::warn(Warning::Kind kind, const Element& element, const std::string& what) {
    if (isFull())
        return;
    const std::string message = fmt::format("<{}>: {}", element.name, what);
    if (wasSeen(element, message))
        return;
    warnings_.push_back({kind, map_.at(element.offset), message});
    if (warnings_.size() >= maxWarnings)
        warnings_.back() = {Warning::Kind::Limit, warnings_.back().where, moreAreLeftOut};
}

}  // namespace vtm::svg
