#include "svg/css/conditions.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "svg/css/cursor.hpp"
#include "svg/css/selectors.hpp"
#include "svg/css/style.hpp"

namespace vtm::svg {
namespace {

/// A word that ends where a bracket or a space follows.
bool consumeWord(Cursor& cursor, std::string_view word) {
    Cursor ahead = cursor;
    if (!equalsIgnoringCase(ahead.identifier(), word))
        return false;
    cursor = ahead;
    cursor.skipSpaces();
    return true;
}

/// What stands between brackets, the cursor at the opening one.
std::optional<std::string_view> bracketed(Cursor& cursor) {
    if (!cursor.consume('('))
        return std::nullopt;
    const std::string_view inner = cursor.rest().substr(0, extentOf(cursor.rest(), ")"));
    cursor.advance(inner.size());
    if (!cursor.consume(')'))
        return std::nullopt;
    cursor.skipSpaces();
    return trim(inner);
}

/// `name: value`, or a name alone.
struct Feature {
    std::string_view name, value;
};

Feature featureOf(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    return {trim(text.substr(0, colon)),
            colon < text.size() ? trim(text.substr(colon + 1)) : std::string_view{}};
}

/// Nothing where the feature is unknown.
std::optional<bool> mediaFeature(std::string_view text) {
    struct Known {
        std::string_view name, value;
    };
    static constexpr Known known[]{{"prefers-color-scheme", "light"},
                                   {"prefers-reduced-motion", "no-preference"},
                                   {"prefers-contrast", "no-preference"},
                                   {"forced-colors", "none"},
                                   {"color-gamut", "srgb"},
                                   {"scripting", "none"},
                                   {"update", "none"},
                                   {"hover", "none"},
                                   {"any-hover", "none"},
                                   {"pointer", "none"},
                                   {"any-pointer", "none"},
                                   {"grid", "0"},
                                   {"monochrome", "0"}};
    const Feature feature = featureOf(text);
    if (equalsIgnoringCase(feature.name, "color") && feature.value.empty())
        return true;
    const auto found =
        std::ranges::find_if(known, [&](const Known& k) { return equalsIgnoringCase(k.name, feature.name); });
    if (found == std::end(known))
        return std::nullopt;
    const bool isNone = found->value == "none" || found->value == "no-preference" || found->value == "0";
    return feature.value.empty() ? !isNone : equalsIgnoringCase(feature.value, found->value);
}

/// With something behind it.
bool consumeAnd(Cursor& cursor) { return consumeWord(cursor, "and") && !cursor.atEnd(); }

/// One query without commas. What cannot be read holds never, negated or not.
bool queryHolds(std::string_view text) {
    Cursor cursor(trim(text));
    const bool isNegated = consumeWord(cursor, "not");
    if (!isNegated)
        consumeWord(cursor, "only");
    bool holds = true;
    if (cursor.peek() != '(') {
        const std::string_view type = cursor.identifier();
        if (type.empty())
            return false;
        holds = equalsIgnoringCase(type, "all") || equalsIgnoringCase(type, "screen");
        cursor.skipSpaces();
        if (!cursor.atEnd() && !consumeAnd(cursor))
            return false;
    }
    while (!cursor.atEnd()) {
        const auto inner = bracketed(cursor);
        const auto feature = inner ? mediaFeature(*inner) : std::nullopt;
        if (!feature || (!cursor.atEnd() && !consumeAnd(cursor)))
            return false;
        holds = holds && *feature;
    }
    return holds != isNegated;
}

constexpr int maxBrackets = 16;  ///< of brackets in each other

bool supports(std::string_view text, int depth);

/// In brackets.
bool supportsTerm(Cursor& cursor, int depth) {
    if (consumeWord(cursor, "not"))
        return !supportsTerm(cursor, depth);
    if (cursor.consume("selector")) {
        const auto selectors = bracketed(cursor);
        return selectors && parseSelectors(*selectors);
    }
    const auto inner = bracketed(cursor);
    if (!inner)
        return cursor = Cursor({}), false;
    if (inner->starts_with('(') || equalsIgnoringCase(inner->substr(0, 4), "not "))
        return supports(*inner, depth + 1);
    const Feature declaration = featureOf(*inner);
    const Property* property = findDeclared(declaration.name);
    return declaration.name.starts_with("--") || (property && isValid(*property, declaration.value));
}

bool supports(std::string_view text, int depth) {
    if (depth > maxBrackets)
        return false;
    Cursor cursor(trim(text));
    bool holds = supportsTerm(cursor, depth);
    while (!cursor.atEnd()) {
        if (consumeWord(cursor, "and"))
            holds = supportsTerm(cursor, depth) && holds;
        else if (consumeWord(cursor, "or"))
            holds = supportsTerm(cursor, depth) || holds;
        else
            return false;
    }
    return holds;
}

}  // namespace

bool mediaHolds(std::string_view queries) {
    if (trim(queries).empty())
        return true;
    bool holds = false;
    for (Cursor cursor(queries); !cursor.atEnd() && !holds;)
        holds = queryHolds(cursor.until(','));
    return holds;
}

bool supportsHolds(std::string_view condition) { return supports(condition, 0); }

}  // namespace vtm::svg
