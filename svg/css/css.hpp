/// \file
/// Style sheets: rules, their selectors and their declarations. Source: CSS 2.2 chapter 4 (syntax),
/// Selectors 3. Pseudo-classes beyond :first-child and :last-child make a rule void.
#pragma once

#include <string_view>
#include <vector>

#include "svg/xml/element.hpp"

namespace vtm::svg {

struct RawDeclaration {
    std::string_view name, value;
    bool important;
};

/// `name: value; …`, without comments.
std::vector<RawDeclaration> parseDeclarations(std::string_view text);

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
    FirstChild,
    LastChild
};

struct Condition {
    ConditionKind kind;
    std::string_view name, value;
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

struct Rule {
    std::vector<Selector> selectors;
    std::vector<RawDeclaration> declarations;
};

struct StyleSheet {
    std::vector<Rule> rules;
    std::vector<std::vector<RawDeclaration>> fontFaces;  ///< the descriptors of each `@font-face`
};

/// Text without comments (see withoutComments). Other at-rules and invalid rules are left out.
StyleSheet parseStyleSheet(std::string_view text);

/// CSS comments, and the HTML ones that old files hide sheets in, as spaces.
std::string withoutComments(std::string_view text);

/// Nothing where the selector list is invalid or unsupported.
std::optional<std::vector<Selector>> parseSelectors(std::string_view text);

/// `steps` counts down with every comparison; at 0 nothing matches any more.
bool matches(const Selector& selector, const Element& element, long& steps);

}  // namespace vtm::svg
