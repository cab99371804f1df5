/// \file
/// Places and warnings.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include <vtm/limits/limits.hpp>
#include <vtm/svg/load.hpp>
#include "svg/xml/element.hpp"

namespace vtm::svg {

/// Maps offsets in the parsed text to lines and columns of the file. Entities make the two differ:
/// what an entity expands to lies where its reference stands.
class SourceMap {
public:
    SourceMap() = default;
    SourceMap(std::string fileName, std::string_view source);

    /// From `parsed` on, the parsed text corresponds to the source from `source` on; if `fixed`, all
    /// of it to that very place.
    void addPiece(std::size_t parsed, std::size_t source, bool fixed) {
        pieces_.push_back({parsed, source, fixed});
    }
    Location at(std::size_t parsedOffset) const;
    Location atSource(std::size_t sourceOffset) const;
    const std::string& fileName() const { return fileName_; }

private:
    struct TextPart {
        std::size_t parsed, source;
        bool fixed;
    };
    std::string fileName_;
    std::vector<std::size_t> lineStarts_;
    std::vector<TextPart> pieces_;
};

/// `"text"` on one line, cut short if it is long.
std::string quoted(std::string_view text);

/// Collects warnings, each once a place, up to a limit.
class Reporter {
public:
    static constexpr std::size_t maxWarnings = 1000;

    Reporter(const SourceMap& map, std::vector<Warning>& warnings) : map_(map), warnings_(warnings) {}

    /// `<name>: what`
    void warn(Warning::Kind kind, const Element& element, const std::string& what);
    /// `<name>: attribute="value" is not valid; it is ignored`
    void warnInvalid(const Element& element, std::string_view attribute, std::string_view value);
    /// Of an element in the file, for messages.
    limits::Place placeOf(const Element& element) const;
    std::vector<Warning>& warnings() const { return warnings_; }

private:
    bool wasSeen(const Element& element, const std::string& message);
    bool isFull() const;

    const SourceMap& map_;
    std::vector<Warning>& warnings_;
    std::unordered_set<std::string> seen_;
};

}  // namespace vtm::svg
