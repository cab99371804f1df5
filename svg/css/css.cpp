#include "svg/css/css.hpp"

#include <algorithm>

#include <vtm/limits/limits.hpp>
#include <vtm/svg/load.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {

// ---- Selectors ----------------------------------------------------------------------------------

namespace {

std::optional<ConditionKind> attributeOperator(Cursor& cursor) {
    if (cursor.consume('='))
        return ConditionKind::AttributeIs;
    if (cursor.consume("~="))
        return ConditionKind::AttributeHasWord;
    if (cursor.consume("|="))
        return ConditionKind::AttributeHasDash;
    if (cursor.consume("^="))
        return ConditionKind::AttributeStarts;
    if (cursor.consume("$="))
        return ConditionKind::AttributeEnds;
    if (cursor.consume("*="))
        return ConditionKind::AttributeContains;
    return std::nullopt;
}

std::string_view readValue(Cursor& cursor) {
    if (cursor.consume('"'))
        return cursor.until('"');
    if (cursor.consume('\''))
        return cursor.until('\'');
    return cursor.identifier();
}

/// Behind `[`.
std::optional<Condition> readAttribute(Cursor& cursor) {
    cursor.skipSpaces();
    Condition condition{ConditionKind::HasAttribute, cursor.identifier(), {}};
    cursor.skipSpaces();
    if (const auto kind = attributeOperator(cursor)) {
        cursor.skipSpaces();
        condition.kind = *kind;
        condition.value = readValue(cursor);
        cursor.skipSpaces();
    }
    return !condition.name.empty() && cursor.consume(']') ? std::optional(condition) : std::nullopt;
}

/// Behind `:`.
std::optional<Condition> readPseudoClass(Cursor& cursor) {
    const std::string_view name = cursor.identifier();
    if (equalsIgnoringCase(name, "first-child"))
        return Condition{ConditionKind::FirstChild, {}, {}};
    if (equalsIgnoringCase(name, "last-child"))
        return Condition{ConditionKind::LastChild, {}, {}};
    return std::nullopt;
}

std::optional<Condition> readCondition(Cursor& cursor) {
    const bool id = cursor.consume('#');
    if (id || cursor.consume('.')) {
        const std::string_view name = cursor.identifier();
        const ConditionKind kind = id ? ConditionKind::Id : ConditionKind::Class;
        return name.empty() ? std::nullopt : std::optional(Condition{kind, {}, name});
    }
    if (cursor.consume('['))
        return readAttribute(cursor);
    return cursor.consume(':') ? readPseudoClass(cursor) : std::nullopt;
}

bool startsCondition(char c) { return c == '#' || c == '.' || c == '[' || c == ':'; }

std::optional<Compound> readCompound(Cursor& cursor) {
    Compound compound;
    const bool universal = cursor.consume('*');
    if (!universal)
        compound.type = cursor.identifier();
    while (startsCondition(cursor.peek())) {
        const auto condition = readCondition(cursor);
        if (!condition)
            return std::nullopt;
        compound.conditions.push_back(*condition);
    }
    const bool empty = !universal && compound.type.empty() && compound.conditions.empty();
    return empty ? std::nullopt : std::optional(std::move(compound));
}

Combinator readCombinator(Cursor& cursor) {
    cursor.skipSpaces();
    Combinator combinator = Combinator::Descendant;
    if (cursor.consume('>'))
        combinator = Combinator::Child;
    else if (cursor.consume('+'))
        combinator = Combinator::NextSibling;
    else if (cursor.consume('~'))
        combinator = Combinator::LaterSibling;
    cursor.skipSpaces();
    return combinator;
}

int specificityOf(const Compound& compound) {
    int specificity = compound.type.empty() ? 0 : 1;
    for (const Condition& condition : compound.conditions)
        specificity += condition.kind == ConditionKind::Id ? 10000 : 100;
    return specificity;
}

std::optional<Selector> parseSelector(std::string_view text) {
    Selector selector;
    Combinator combinator = Combinator::None;
    for (Cursor cursor(trim(text)); !cursor.atEnd() || selector.compounds.empty();) {
        auto compound = readCompound(cursor);
        if (!compound)
            return std::nullopt;
        selector.specificity += specificityOf(*compound);
        compound->combinator = combinator;
        selector.compounds.push_back(std::move(*compound));
        if (selector.compounds.size() > Limits::maxCompounds)
            return std::nullopt;
        combinator = cursor.atEnd() ? Combinator::None : readCombinator(cursor);
    }
    return selector;
}

bool hasWord(std::string_view list, std::string_view word) {
    for (Cursor cursor(list); !cursor.atEnd();) {
        cursor.skipSpaces();
        const std::string_view rest = cursor.rest();
        const auto end = std::find_if(rest.begin(), rest.end(), isSpace);
        const std::size_t size = static_cast<std::size_t>(end - rest.begin());
        if (size > 0 && rest.substr(0, size) == word)
            return true;
        cursor.advance(size);
    }
    return false;
}

bool attributeMatches(const Condition& condition, const Element& element) {
    const auto attribute = element.find(condition.name);
    if (!attribute)
        return false;
    const std::string_view value = condition.value;
    switch (condition.kind) {
        case ConditionKind::HasAttribute:
            return true;
        case ConditionKind::AttributeIs:
            return *attribute == value;
        case ConditionKind::AttributeHasWord:
            return hasWord(*attribute, value);
        case ConditionKind::AttributeHasDash:
            return attribute->starts_with(value) &&
                   (attribute->size() == value.size() || (*attribute)[value.size()] == '-');
        case ConditionKind::AttributeStarts:
            return !value.empty() && attribute->starts_with(value);
        case ConditionKind::AttributeEnds:
            return !value.empty() && attribute->ends_with(value);
        case ConditionKind::AttributeContains:
            return !value.empty() && attribute->find(value) != attribute->npos;
        default:
            return false;
    }
}

bool conditionMatches(const Condition& condition, const Element& element) {
    switch (condition.kind) {
        case ConditionKind::Id:
            return element.get("id") == condition.value;
        case ConditionKind::Class:
            return hasWord(element.get("class"), condition.value);
        case ConditionKind::FirstChild:
            return element.parent && !element.previous;
        case ConditionKind::LastChild:
            return element.parent && !element.next;
        default:
            return attributeMatches(condition, element);
    }
}

bool compoundMatches(const Compound& compound, const Element& element) {
    return (compound.type.empty() || compound.type == element.name) &&
           std::all_of(compound.conditions.begin(), compound.conditions.end(),
                       [&](const Condition& condition) { return conditionMatches(condition, element); });
}

/// About how many machine words a comparison reads.
long costOf(const Compound& compound, const Element& element) {
    const std::size_t perCondition = element.attributes.size() + element.get("class").size() / 16;
    return 1 + static_cast<long>(compound.conditions.size() * perCondition);
}

/// Whether compounds 0 to `last` match, the last one being put on `element`.
bool matchesUpTo(const std::vector<Compound>& compounds, std::size_t last, const Element& element,
                 long& steps) {
    limits::check();
    steps -= costOf(compounds[last], element);
    if (steps <= 0 || !compoundMatches(compounds[last], element))
        return false;
    const auto anyOf = [&](const Element* candidate, auto next) {
        for (; candidate; candidate = next(*candidate))
            if (matchesUpTo(compounds, last - 1, *candidate, steps))
                return true;
        return false;
    };
    switch (compounds[last].combinator) {
        case Combinator::None:
            return true;
        case Combinator::Child:
            return element.parent && matchesUpTo(compounds, last - 1, *element.parent, steps);
        case Combinator::Descendant:
            return anyOf(element.parent, [](const Element& e) { return e.parent; });
        case Combinator::NextSibling:
            return element.previous && matchesUpTo(compounds, last - 1, *element.previous, steps);
        case Combinator::LaterSibling:
            return anyOf(element.previous, [](const Element& e) { return e.previous; });
    }
    return false;
}

}  // namespace

std::optional<std::vector<Selector>> parseSelectors(std::string_view text) {
    std::vector<Selector> selectors;
    for (Cursor cursor(text); !cursor.atEnd();) {
        limits::check();
        auto selector = parseSelector(cursor.until(','));
        if (!selector)
            return std::nullopt;
        selectors.push_back(std::move(*selector));
    }
    return selectors.empty() ? std::nullopt : std::optional(std::move(selectors));
}

bool matches(const Selector& selector, const Element& element, long& steps) {
    return matchesUpTo(selector.compounds, selector.compounds.size() - 1, element, steps);
}

// ---- Rules and declarations ---------------------------------------------------------------------

namespace {

/// Length of the text up to one of `ends` that stands outside quotes, brackets and escapes.
std::size_t extent(std::string_view text, std::string_view ends) {
    int depth = 0;
    char quote = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\\')
            ++i;
        else if (quote)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (depth == 0 && ends.find(c) != ends.npos)
            return i;
        else if (c == '(' || c == '[' || c == '{')
            ++depth;
        else if ((c == ')' || c == ']' || c == '}') && depth > 0)
            --depth;
    }
    return text.size();
}

std::string_view take(Cursor& cursor, std::string_view ends) {
    const std::string_view part = cursor.rest().substr(0, extent(cursor.rest(), ends));
    cursor.advance(part.size());
    return part;
}

/// Behind `@`: up to a semicolon or over a block.
void skipAtRule(Cursor& cursor) {
    take(cursor, ";{");
    if (cursor.consume('{')) {
        take(cursor, "}");
        cursor.consume('}');
    } else {
        cursor.consume(';');
    }
}

/// `value ! important`
bool splitImportant(std::string_view& value) {
    const std::size_t mark = value.rfind('!');
    if (mark == value.npos || !equalsIgnoringCase(trim(value.substr(mark + 1)), "important"))
        return false;
    value = trim(value.substr(0, mark));
    return true;
}

void blank(std::string& text, std::string_view open, std::string_view close) {
    for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at)) {
        const std::size_t end = std::min(text.find(close, at + open.size()), text.size());
        const std::size_t stop = std::min(end + close.size(), text.size());
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(at),
                  text.begin() + static_cast<std::ptrdiff_t>(stop), ' ');
    }
}

}  // namespace

std::vector<RawDeclaration> parseDeclarations(std::string_view text) {
    std::vector<RawDeclaration> declarations;
    for (Cursor cursor(text); !cursor.atEnd(); cursor.consume(';')) {
        limits::check();
        const std::string_view declaration = take(cursor, ";");
        const std::size_t colon = declaration.find(':');
        if (colon == declaration.npos)
            continue;
        std::string_view value = trim(declaration.substr(colon + 1));
        const bool important = splitImportant(value);
        declarations.push_back({trim(declaration.substr(0, colon)), value, important});
    }
    return declarations;
}

StyleSheet parseStyleSheet(std::string_view text) {
    StyleSheet sheet;
    Cursor cursor(text);
    for (cursor.skipSpaces(); !cursor.atEnd(); cursor.skipSpaces()) {
        limits::check();
        if (cursor.consume("@font-face")) {
            cursor.skipSpaces();
            cursor.consume('{');
            sheet.fontFaces.push_back(parseDeclarations(take(cursor, "}")));
            cursor.consume('}');
            continue;
        }
        if (cursor.consume('@')) {
            skipAtRule(cursor);
            continue;
        }
        const std::string_view selectors = take(cursor, "{");
        cursor.consume('{');
        const std::string_view body = take(cursor, "}");
        cursor.consume('}');
        if (auto parsed = parseSelectors(selectors))
            sheet.rules.push_back({std::move(*parsed), parseDeclarations(body)});
    }
    return sheet;
}

std::string withoutComments(std::string_view text) {
    std::string result(text);
    blank(result, "/*", "*/");
    blank(result, "<!--", "");
    blank(result, "-->", "");
    return result;
}

}  // namespace vtm::svg
