#include "svg/css/selectors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vtm/limits/limits.hpp>
#include <vtm/svg/load.hpp>
#include "svg/css/cursor.hpp"
#include "svg/xml/decode.hpp"

namespace vtm::svg {

// Where Selector is complete.
Condition::Condition(ConditionKind of, std::string named, std::string valued, std::vector<Nth> numbered)
    : kind(of), name(std::move(named)), value(std::move(valued)), nths(std::move(numbered)) {}

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

/// `\31 ` or `\.`, the cursor behind the backslash.
void readEscape(Cursor& cursor, std::string& name) {
    constexpr int maxDigits = 6;
    char32_t code = 0;
    int digits = 0;
    for (; digits < maxDigits && hexDigit(cursor.peek()) >= 0; ++digits, cursor.advance())
        code = code * 16 + static_cast<char32_t>(hexDigit(cursor.peek()));
    if (digits == 0) {
        name += cursor.peek();
        cursor.advance();
        return;
    }
    appendUtf8(name, code);
    if (isSpace(cursor.peek()))
        cursor.advance();
}

/// An identifier whose escapes stand for characters (CSS Syntax 3 section 4.3.7). Possibly empty.
std::string readName(Cursor& cursor) {
    std::string name(cursor.identifier());
    while (cursor.peek() == '\\' && cursor.rest().size() > 1) {
        cursor.advance();
        readEscape(cursor, name);
        name += cursor.identifier();
    }
    return name;
}

std::string readValue(Cursor& cursor) {
    if (cursor.consume('"'))
        return std::string(cursor.until('"'));
    if (cursor.consume('\''))
        return std::string(cursor.until('\''));
    return readName(cursor);
}

/// Steps over the `|` between a prefix and a name; `|=` is an operator.
bool consumeBar(Cursor& cursor) { return !cursor.rest().starts_with("|=") && cursor.consume('|'); }

/// The tree has attributes of two namespaces, by their usual prefixes; of all others a name is enough.
std::string readAttributeName(Cursor& cursor) {
    const bool isAny = cursor.consume('*');
    std::string name = readName(cursor);
    if (!consumeBar(cursor))
        return isAny ? std::string() : name;
    return name.empty() ? readName(cursor) : name + ':' + readName(cursor);
}

/// Behind `[`.
std::optional<Condition> readAttribute(Cursor& cursor) {
    cursor.skipSpaces();
    Condition condition{ConditionKind::HasAttribute, readAttributeName(cursor)};
    cursor.skipSpaces();
    if (const auto kind = attributeOperator(cursor)) {
        cursor.skipSpaces();
        condition.kind = *kind;
        condition.value = readValue(cursor);
        cursor.skipSpaces();
        condition.ignoresCase = cursor.consume("i");
        if (!condition.ignoresCase)
            cursor.consume("s");
        cursor.skipSpaces();
    }
    return !condition.name.empty() && cursor.consume(']') ? std::optional(condition) : std::nullopt;
}

// ---- Pseudo-classes -------------------------------------------------------------------------------

/// Where a selector stands: in lists in each other, in a sheet that declares prefixes.
struct Surroundings {
    const NamespacePrefixes& prefixes;
    int depth = 0;
};

/// `isForgiving`: what is not valid is left out (Selectors 4 section 4.1), not the list.
std::optional<std::vector<Selector>> parseList(std::string_view text, Surroundings around,
                                               bool isForgiving = false);

/// `odd`, `even`, `3`, `2n+1`, `-n + 3`: CSS Syntax 3 section 6.
std::optional<Nth> readNth(std::string_view text) {
    constexpr double maxNth = 1e9;
    const auto whole = [](double v) { return std::abs(v) <= maxNth && v == std::trunc(v); };
    Cursor cursor(trim(text));
    if (equalsIgnoringCase(cursor.rest(), "odd"))
        return Nth{2, 1};
    if (equalsIgnoringCase(cursor.rest(), "even"))
        return Nth{2, 0};
    const bool isNegative = cursor.rest().starts_with("-n") || cursor.rest().starts_with("-N");
    double first = isNegative ? -1 : 1;
    if (isNegative)
        cursor.advance();
    else if (cursor.rest().starts_with("+n") || cursor.rest().starts_with("+N"))
        cursor.advance();
    else if (const auto number = cursor.number())
        first = *number;
    if (!whole(first))
        return std::nullopt;
    if (!cursor.consume("n"))
        return cursor.atEnd() && !isNegative ? std::optional(Nth{0, int(first)}) : std::nullopt;
    cursor.skipSpaces();
    if (cursor.atEnd())
        return Nth{int(first), 0};
    const bool minus = cursor.peek() == '-';
    if (!minus && cursor.peek() != '+')
        return std::nullopt;
    cursor.advance();
    cursor.skipSpaces();
    const auto offset = isDigit(cursor.peek()) ? cursor.number() : std::nullopt;
    if (!offset || !whole(*offset) || !cursor.atEnd())
        return std::nullopt;
    return Nth{int(first), minus ? -int(*offset) : int(*offset)};
}

/// Those without an argument.
std::optional<Condition> simplePseudoClass(std::string_view name) {
    const auto is = [&](std::string_view other) { return equalsIgnoringCase(name, other); };
    const auto nths = [](std::vector<Nth> list) {
        return Condition{ConditionKind::Nth, {}, {}, std::move(list)};
    };
    const Nth first, last{0, 1, true}, firstOfType{0, 1, false, true}, lastOfType{0, 1, true, true};
    if (is("first-child"))
        return nths({first});
    if (is("last-child"))
        return nths({last});
    if (is("only-child"))
        return nths({first, last});
    if (is("first-of-type"))
        return nths({firstOfType});
    if (is("last-of-type"))
        return nths({lastOfType});
    if (is("only-of-type"))
        return nths({firstOfType, lastOfType});
    if (is("root"))
        return Condition{ConditionKind::Root};
    if (is("empty"))
        return Condition{ConditionKind::Empty};
    if (is("scope"))
        return Condition{ConditionKind::Root};
    if (is("link") || is("any-link"))
        return Condition{ConditionKind::Link};
    for (const std::string_view state : {"hover", "active", "focus", "focus-visible", "focus-within",
                                         "target", "visited", "checked", "disabled"})
        if (is(state))
            return Condition{ConditionKind::Never};
    return std::nullopt;
}

/// `2n+1`, or for children `2n+1 of SELECTORS`.
std::optional<Condition> nthCondition(std::string_view argument, Nth kind, Surroundings around) {
    Cursor cursor(argument);
    std::string_view number = argument, selectors;
    for (; !cursor.atEnd() && !kind.ofType; cursor.advance())
        if (isSpace(cursor.peek()) && equalsIgnoringCase(cursor.rest().substr(1, 3), "of ")) {
            number = argument.substr(0, argument.size() - cursor.rest().size());
            selectors = cursor.rest().substr(4);
            break;
        }
    const auto nth = readNth(number);
    if (!nth)
        return std::nullopt;
    kind.step = nth->step, kind.offset = nth->offset;
    Condition condition{ConditionKind::Nth, {}, {}, {kind}};
    if (selectors.empty())
        return condition;
    auto counted = parseList(selectors, around);
    if (!counted)
        return std::nullopt;
    condition.selectors = std::move(*counted);
    return condition;
}

std::optional<Condition> pseudoClass(std::string_view name, std::string_view argument, Surroundings around) {
    const auto is = [&](std::string_view other) { return equalsIgnoringCase(name, other); };
    const bool fromEnd = is("nth-last-child") || is("nth-last-of-type");
    const bool ofType = is("nth-of-type") || is("nth-last-of-type");
    ++around.depth;
    if (fromEnd || ofType || is("nth-child"))
        return nthCondition(argument, {0, 1, fromEnd, ofType}, around);
    if (is("lang"))
        return Condition{ConditionKind::Lang, {}, std::string(argument)};
    const bool isNot = is("not"), isWhere = is("where");
    if (!isNot && !isWhere && !is("is"))
        return std::nullopt;
    auto selectors = parseList(argument, around, !isNot);
    if (!selectors)
        return std::nullopt;
    Condition condition{isNot ? ConditionKind::Not : ConditionKind::Is};
    condition.selectors = std::move(*selectors);
    condition.isSpecific = !isWhere;
    return condition;
}

/// Behind `:`.
std::optional<Condition> readPseudoClass(Cursor& cursor, Surroundings around) {
    const std::string_view name = cursor.identifier();
    if (!cursor.consume('('))
        return simplePseudoClass(name);
    const std::string_view argument = cursor.rest().substr(0, extentOf(cursor.rest(), ")"));
    cursor.advance(argument.size());
    return cursor.consume(')') ? pseudoClass(name, argument, around) : std::nullopt;
}

// ---- Compounds ------------------------------------------------------------------------------------

std::optional<Condition> readCondition(Cursor& cursor, Surroundings around) {
    const bool id = cursor.consume('#');
    if (id || cursor.consume('.')) {
        std::string name = readName(cursor);
        const ConditionKind kind = id ? ConditionKind::Id : ConditionKind::Class;
        return name.empty() ? std::nullopt : std::optional(Condition{kind, {}, std::move(name)});
    }
    if (cursor.consume('['))
        return readAttribute(cursor);
    return cursor.consume(':') ? readPseudoClass(cursor, around) : std::nullopt;
}

bool startsCondition(char c) { return c == '#' || c == '.' || c == '[' || c == ':'; }

constexpr std::string_view svgNamespace = "http://www.w3.org/2000/svg";

/// `rect`, `*`, `svg|rect`, `*|*`; false where there is none or a prefix is not declared.
bool readType(Cursor& cursor, const NamespacePrefixes& prefixes, Compound& compound) {
    bool isAny = cursor.consume('*');
    compound.type = isAny ? std::string() : readName(cursor);
    std::string prefix;
    const bool isPrefixed = consumeBar(cursor);
    if (isPrefixed) {
        prefix = isAny ? "*" : std::exchange(compound.type, {});
        isAny = cursor.consume('*');
        if (!isAny)
            compound.type = readName(cursor);
    }
    if (!isAny && compound.type.empty())
        return false;
    if (prefix == "*")
        return true;
    const auto found = prefixes.find(prefix);
    const bool isDeclared = found != prefixes.end(), isNone = isPrefixed && prefix.empty();
    if (isPrefixed && !isNone && !isDeclared)
        return false;
    if (isNone || (isDeclared && found->second != svgNamespace))  // what is drawn is SVG
        compound.conditions.emplace_back(ConditionKind::Never);
    return true;
}

std::optional<Compound> readCompound(Cursor& cursor, Surroundings around) {
    Compound compound;
    if (!startsCondition(cursor.peek()) && !readType(cursor, around.prefixes, compound))
        return std::nullopt;
    while (startsCondition(cursor.peek())) {
        auto condition = readCondition(cursor, around);
        if (!condition)
            return std::nullopt;
        compound.conditions.push_back(std::move(*condition));
    }
    return compound;
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
    for (const Condition& condition : compound.conditions) {
        int most = 0;
        for (const Selector& selector : condition.selectors)
            most = std::max(most, selector.specificity);
        specificity += condition.isSpecific ? most : 0;
        if (condition.kind != ConditionKind::Is && condition.kind != ConditionKind::Not)
            specificity += condition.kind == ConditionKind::Id ? 10000 : 100;
    }
    return specificity;
}

std::optional<Selector> parseSelector(std::string_view text, Surroundings around) {
    Selector selector;
    Combinator combinator = Combinator::None;
    for (Cursor cursor(trim(text)); !cursor.atEnd() || selector.compounds.empty();) {
        auto compound = readCompound(cursor, around);
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

std::optional<std::vector<Selector>> parseList(std::string_view text, Surroundings around, bool isForgiving) {
    constexpr int maxDepth = 8;  // of lists in each other
    if (around.depth > maxDepth)
        return std::nullopt;
    std::vector<Selector> selectors;
    for (Cursor cursor(text); !cursor.atEnd();) {
        limits::check();
        const std::string_view part = cursor.rest().substr(0, extentOf(cursor.rest(), ","));
        cursor.advance(part.size());
        auto selector = parseSelector(part, around);
        if ((cursor.consume(',') && cursor.atEnd() && !isForgiving) || (!selector && !isForgiving))
            return std::nullopt;
        if (selector)
            selectors.push_back(std::move(*selector));
    }
    return selectors.empty() && !isForgiving ? std::nullopt : std::optional(std::move(selectors));
}

// ---- Matching -------------------------------------------------------------------------------------

bool hasWord(std::string_view list, std::string_view word) {
    for (Cursor cursor(list); !cursor.atEnd();)
        if (const std::string_view found = cursor.nextInList(); !found.empty() && found == word)
            return true;
    return false;
}

std::string lowered(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c;
    return lower;
}

bool valueMatches(ConditionKind kind, std::string_view attribute, std::string_view value) {
    switch (kind) {
        case ConditionKind::HasAttribute:
            return true;
        case ConditionKind::AttributeIs:
            return attribute == value;
        case ConditionKind::AttributeHasWord:
            return hasWord(attribute, value);
        case ConditionKind::AttributeHasDash:
            return attribute.starts_with(value) &&
                   (attribute.size() == value.size() || attribute[value.size()] == '-');
        case ConditionKind::AttributeStarts:
            return !value.empty() && attribute.starts_with(value);
        case ConditionKind::AttributeEnds:
            return !value.empty() && attribute.ends_with(value);
        case ConditionKind::AttributeContains:
            return !value.empty() && attribute.find(value) != attribute.npos;
        default:
            return false;
    }
}

bool attributeMatches(const Condition& condition, const Element& element) {
    const auto attribute = element.find(condition.name);
    if (!attribute)
        return false;
    return condition.ignoresCase ? valueMatches(condition.kind, lowered(*attribute), lowered(condition.value))
                                 : valueMatches(condition.kind, *attribute, condition.value);
}

bool isAny(const std::vector<Selector>& selectors, const Element& element, long& steps) {
    return std::ranges::any_of(selectors, [&](const Selector& s) { return matches(s, element, steps); });
}

/// Counted from 1, among the siblings that are counted.
long numberOf(const Element& element, const Nth& nth, const std::vector<Selector>& counted, long& steps) {
    long number = 1;
    const Element* other = nth.fromEnd ? element.next : element.previous;
    for (; other && steps > 0; other = nth.fromEnd ? other->next : other->previous, --steps)
        number += (!nth.ofType || (other->name == element.name && other->tag == element.tag)) &&
                  (counted.empty() || isAny(counted, *other, steps));
    return number;
}

bool holds(const Nth& nth, const std::vector<Selector>& counted, const Element& element, long& steps) {
    if (!counted.empty() && !isAny(counted, element, steps))
        return false;
    const long above = numberOf(element, nth, counted, steps) - nth.offset;
    return nth.step == 0 ? above == 0 : above % nth.step == 0 && above / nth.step >= 0;
}

bool isEmpty(const Element& element) { return element.children.empty() && !element.hasText; }

/// A list of ranges, one of which the nearest language has as a prefix of whole subtags.
bool hasLanguage(const Element& element, std::string_view ranges) {
    const auto isIn = [](std::string_view language, std::string_view range) {
        return !range.empty() && language.size() >= range.size() &&
               equalsIgnoringCase(language.substr(0, range.size()), range) &&
               (language.size() == range.size() || language[range.size()] == '-');
    };
    const auto unquoted = [](std::string_view text) {
        const bool isQuoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'');
        return isQuoted && text.back() == text.front() ? text.substr(1, text.size() - 2) : text;
    };
    for (const Element* e = &element; e; e = e->parent)
        for (const std::string_view name : {"xml:lang", "lang"})
            if (const auto language = e->find(name)) {
                for (Cursor cursor(ranges); !cursor.atEnd();)
                    if (isIn(*language, unquoted(trim(cursor.until(',')))))
                        return true;
                return false;
            }
    return false;
}

bool conditionMatches(const Condition& condition, const Element& element, long& steps) {
    switch (condition.kind) {
        case ConditionKind::Id:
            return element.get("id") == condition.value;
        case ConditionKind::Class:
            return hasWord(element.get("class"), condition.value);
        case ConditionKind::Nth:
            return element.parent && std::ranges::all_of(condition.nths, [&](const Nth& nth) {
                       return holds(nth, condition.selectors, element, steps);
                   });
        case ConditionKind::Root:
            return !element.parent;
        case ConditionKind::Empty:
            return isEmpty(element);
        case ConditionKind::Lang:
            return hasLanguage(element, condition.value);
        case ConditionKind::Link:
            return element.tag == Tag::A && hrefOf(element);
        case ConditionKind::Is:
            return isAny(condition.selectors, element, steps);
        case ConditionKind::Not:
            return steps > 0 && !isAny(condition.selectors, element, steps);
        case ConditionKind::Never:
            return false;
        default:
            return attributeMatches(condition, element);
    }
}

bool compoundMatches(const Compound& compound, const Element& element, long& steps) {
    return (compound.type.empty() || compound.type == element.name) &&
           std::ranges::all_of(compound.conditions, [&](const Condition& condition) {
               return conditionMatches(condition, element, steps);
           });
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
    if (steps <= 0 || !compoundMatches(compounds[last], element, steps))
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

std::optional<std::vector<Selector>> parseSelectors(std::string_view text,
                                                    const NamespacePrefixes& prefixes) {
    return parseList(text, {prefixes});
}

bool matches(const Selector& selector, const Element& element, long& steps) {
    return matchesUpTo(selector.compounds, selector.compounds.size() - 1, element, steps);
}

}  // namespace vtm::svg
