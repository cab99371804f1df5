/// \file
/// Selectors: which elements a rule applies to. Source: Selectors 4. States that a picture does not have,
/// such as :hover, match nothing; unknown pseudo-classes and pseudo-elements make a rule void.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
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
    Link,
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
    std::string name, value;
    bool ignoresCase = false;         ///< of attributes
    std::vector<Nth> nths;            ///< of Nth: all of them hold
    std::vector<Selector> selectors;  ///< of Is and Not; of Nth: which siblings are counted
    bool isSpecific = true;           ///< false for :where()

    explicit Condition(ConditionKind of, std::string named = {}, std::string valued = {},
                       std::vector<Nth> numbered = {});
};

enum class Combinator { None, Descendant, Child, NextSibling, LaterSibling };

/// One element's part of a selector; `combinator` ties it to the compound on its left.
struct Compound {
    std::string type;  ///< empty: any
    std::vector<Condition> conditions;
    Combinator combinator = Combinator::None;
};

struct Selector {
    std::vector<Compound> compounds;
    int specificity = 0;  ///< ids * 10000 + classes, attributes and pseudo-classes * 100 + types
};

/// What `@namespace` declares: URIs by prefix, the default one by the empty prefix.
using NamespacePrefixes = std::unordered_map<std::string_view, std::string_view>;

/// Nothing where the selector list is invalid or unsupported.
std::optional<std::vector<Selector>> parseSelectors(std::string_view text,
                                                    const NamespacePrefixes& prefixes = {});

/// `steps` counts down with every comparison; at 0 nothing matches any more.
bool matches(const Selector& selector, const Element& element, long& steps);

}  // namespace vtm::svg
