/// \file
/// Style sheets: rules, their selectors and their declarations. Source: CSS Syntax 3, CSS Conditional 3.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "svg/css/selectors.hpp"

namespace vtm::svg {

struct RawDeclaration {
    std::string_view name, value;
    bool important;
};

/// `name: value; …`, without comments.
std::vector<RawDeclaration> parseDeclarations(std::string_view text);

struct Rule {
    std::vector<Selector> selectors;
    std::vector<RawDeclaration> declarations;
};

/// `@import`
struct Import {
    std::string_view href, media;
};

struct StyleSheet {
    std::vector<Import> imports;  ///< before the rules
    std::vector<Rule> rules;      ///< of `@media` and `@supports` those whose conditions hold
    std::vector<std::vector<RawDeclaration>> fontFaces;  ///< the descriptors of each `@font-face`
};

/// Text without comments (see withoutComments). Other at-rules and invalid rules are left out.
StyleSheet parseStyleSheet(std::string_view text);

/// CSS comments, and the HTML ones that old files hide sheets in, as spaces.
std::string withoutComments(std::string_view text);

}  // namespace vtm::svg
