#include "svg/css/selectors.hpp"

#include <algorithm>
#include <cmath>

#include <vtm/limits/limits.hpp>
#include <vtm/svg/load.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {

// Where Selector is complete.
Condition::Condition(ConditionKind of, std::string_view named, std::string_view valued,
                     std::vector<Nth> numbered)
    : kind(of), name(named), value(valued), nths(std::move(numbered)) {}

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

// ---- Pseudo-classes -------------------------------------------------------------------------------

std::optional<std::vector<Selector>> parseList(std::string_view text, int depth);

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
    for (const std::string_view state : {"hover", "active", "focus", "focus-visible", "focus-within",
                                         "target", "visited", "checked", "disabled"})
        if (is(state))
            return Condition{ConditionKind::Never};
    return std::nullopt;
}

std::optional<Condition> pseudoClass(std::string_view name, std::string_view argument, int depth) {
    const auto is = [&](std::string_view other) { return equalsIgnoringCase(name, other); };
    const bool fromEnd = is("nth-last-child") || is("nth-last-of-type");
    const bool ofType = is("nth-of-type") || is("nth-last-of-type");
    if (fromEnd || ofType || is("nth-child")) {
        auto nth = readNth(argument);
        if (!nth)
            return std::nullopt;
        nth->fromEnd = fromEnd;
        nth->ofType = ofType;
        return Condition{ConditionKind::Nth, {}, {}, {*nth}};
    }
    if (is("lang"))
        return Condition{ConditionKind::Lang, {}, trim(argument)};
    const bool isNot = is("not"), isWhere = is("where");
    if (!isNot && !isWhere && !is("is"))
        return std::nullopt;
    auto selectors = parseList(argument, depth + 1);
    if (!selectors)
        return std::nullopt;
    Condition condition{isNot ? ConditionKind::Not : ConditionKind::Is};
    condition.selectors = std::move(*selectors);
    condition.isSpecific = !isWhere;
    return condition;
}

/// Behind `:`.
std::optional<Condition> readPseudoClass(Cursor& cursor, int depth) {
    const std::string_view name = cursor.identifier();
    if (!cursor.consume('('))
        return simplePseudoClass(name);
    const std::string_view argument = cursor.rest().substr(0, extentOf(cursor.rest(), ")"));
    cursor.advance(argument.size());
    return cursor.consume(')') ? pseudoClass(name, argument, depth) : std::nullopt;
}

// ---- Compounds ------------------------------------------------------------------------------------

std::optional<Condition> readCondition(Cursor& cursor, int depth) {
    const bool id = cursor.consume('#');
    if (id || cursor.consume('.')) {
        const std::string_view name = cursor.identifier();
        const ConditionKind kind = id ? ConditionKind::Id : ConditionKind::Class;
        return name.empty() ? std::nullopt : std::optional(Condition{kind, {}, name});
    }
    if (cursor.consume('['))
        return readAttribute(cursor);
    return cursor.consume(':') ? readPseudoClass(cursor, depth) : std::nullopt;
}

bool startsCondition(char c) { return c == '#' || c == '.' || c == '[' || c == ':'; }

std::optional<Compound> readCompound(Cursor& cursor, int depth) {
    Compound compound;
    const bool universal = cursor.consume('*');
    if (!universal)
        compound.type = cursor.identifier();
    while (startsCondition(cursor.peek())) {
        auto condition = readCondition(cursor, depth);
        if (!condition)
            return std::nullopt;
        compound.conditions.push_back(std::move(*condition));
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
        if (condition.kind == ConditionKind::Is || condition.kind == ConditionKind::Not) {
            int most = 0;
            for (const Selector& selector : condition.selectors)
                most = std::max(most, selector.specificity);
            specificity += condition.isSpecific ? most : 0;
        } else {
            specificity += condition.kind == ConditionKind::Id ? 10000 : 100;
        }
    return specificity;
}

std::optional<Selector> parseSelector(std::string_view text, int depth) {
    Selector selector;
    Combinator combinator = Combinator::None;
    for (Cursor cursor(trim(text)); !cursor.atEnd() || selector.compounds.empty();) {
        auto compound = readCompound(cursor, depth);
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

std::optional<std::vector<Selector>> parseList(std::string_view text, int depth) {
    constexpr int maxDepth = 8;  // of lists in each other
    if (depth > maxDepth)
        return std::nullopt;
    std::vector<Selector> selectors;
    for (Cursor cursor(text); !cursor.atEnd();) {
        limits::check();
        const std::string_view part = cursor.rest().substr(0, extentOf(cursor.rest(), ","));
        cursor.advance(part.size());
        auto selector = parseSelector(part, depth);
        if (!selector || (cursor.consume(',') && cursor.atEnd()))
            return std::nullopt;
        selectors.push_back(std::move(*selector));
    }
    return selectors.empty() ? std::nullopt : std::optional(std::move(selectors));
}

// ---- Matching -------------------------------------------------------------------------------------

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

/// Counted from 1.
long numberOf(const Element& element, const Nth& nth, long& steps) {
    long number = 1;
    const Element* other = nth.fromEnd ? element.next : element.previous;
    for (; other && steps > 0; other = nth.fromEnd ? other->next : other->previous, --steps)
        number += !nth.ofType || (other->name == element.name && other->tag == element.tag);
    return number;
}

bool holds(const Nth& nth, const Element& element, long& steps) {
    const long above = numberOf(element, nth, steps) - nth.offset;
    return nth.step == 0 ? above == 0 : above % nth.step == 0 && above / nth.step >= 0;
}

bool isEmpty(const Element& element) {
    return std::ranges::all_of(element.children, [](const Element* child) {
        return child->tag == Tag::CharacterData && child->text.empty();
    });
}

/// The nearest language, by prefix of whole subtags.
bool hasLanguage(const Element& element, std::string_view range) {
    for (const Element* e = &element; e; e = e->parent)
        for (const std::string_view name : {"xml:lang", "lang"})
            if (const auto language = e->find(name))
                return language->size() >= range.size() &&
                       equalsIgnoringCase(language->substr(0, range.size()), range) &&
                       (language->size() == range.size() || (*language)[range.size()] == '-');
    return false;
}

bool conditionMatches(const Condition& condition, const Element& element, long& steps) {
    const auto isAny = [&] {
        return std::ranges::any_of(condition.selectors,
                                   [&](const Selector& s) { return matches(s, element, steps); });
    };
    switch (condition.kind) {
        case ConditionKind::Id:
            return element.get("id") == condition.value;
        case ConditionKind::Class:
            return hasWord(element.get("class"), condition.value);
        case ConditionKind::Nth:
            return element.parent && std::ranges::all_of(condition.nths, [&](const Nth& nth) {
                       return holds(nth, element, steps);
                   });
        case ConditionKind::Root:
            return !element.parent;
        case ConditionKind::Empty:
            return isEmpty(element);
        case ConditionKind::Lang:
            return hasLanguage(element, condition.value);
        case ConditionKind::Is:
            return isAny();
        case ConditionKind::Not:
            return steps > 0 && !isAny();
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

std::optional<std::vector<Selector>> parseSelectors(std::string_view text) { return parseList(text, 0); }

bool matches(const Selector& selector, const Element& element, long& steps) {
    return matchesUpTo(selector.compounds, selector.compounds.size() - 1, element, steps);
}

}  // namespace vtm::svg
