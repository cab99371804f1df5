/// \file
/// Selectors: which elements a rule applies to. Source: Selectors 4. States that a picture does not have,
/// such as :hover, match nothing; unknown pseudo-classes and pseudo-elements make a rule void.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "svg/xml/element.hpp"

namespace vtm::svg {

enum class ConditionKind {
    Id,
    Class,
    HasAttribute,
    AttributeIs,
    AttributeHasWord,
    AttributeHasDash,
    AttributeStarts,
    AttributeEnds,
    AttributeContains,
    Nth,
    Root,
    Empty,
    Lang,
    Is,
    Not,
    Never
};

struct Selector;

/// `:nth-child(step n + offset)` and its likes: the element is number step n + offset for an n >= 0, counted
/// from 1 among its siblings, or among those of its type.
struct Nth {
    int step = 0, offset = 1;
    bool fromEnd = false, ofType = false;
};

struct Condition {
    ConditionKind kind;
    std::string_view name, value;
    std::vector<Nth> nths;            ///< of Nth: all of them hold
    std::vector<Selector> selectors;  ///< of Is and Not
    bool isSpecific = true;           ///< false for :where()

    explicit Condition(ConditionKind of, std::string_view named = {}, std::string_view valued = {},
                       std::vector<Nth> numbered = {});
};

enum class Combinator { None, Descendant, Child, NextSibling, LaterSibling };

/// One element's part of a selector; `combinator` ties it to the compound on its left.
struct Compound {
    std::string_view type;  ///< empty: any
    std::vector<Condition> conditions;
    Combinator combinator = Combinator::None;
};

struct Selector {
    std::vector<Compound> compounds;
    int specificity = 0;  ///< ids * 10000 + classes, attributes and pseudo-classes * 100 + types
};

/// Nothing where the selector list is invalid or unsupported.
std::optional<std::vector<Selector>> parseSelectors(std::string_view text);

/// `steps` counts down with every comparison; at 0 nothing matches any more.
bool matches(const Selector& selector, const Element& element, long& steps);

}  // namespace vtm::svg
