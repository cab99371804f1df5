/// \file
/// Style sheets: rules, their selectors and their declarations. Source: CSS Syntax 3, CSS Conditional 3.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "svg/css/layers.hpp"
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
    std::size_t layer = 0;
};

/// `@import` whose `supports()` holds.
struct Import {
    std::string_view href, media;
    std::size_t layer = 0;
};

struct StyleSheet {
    std::vector<Import> imports;  ///< before the rules
    std::vector<Rule> rules;      ///< of `@media` and `@supports` those whose conditions hold
    std::vector<std::vector<RawDeclaration>> fontFaces;  ///< the descriptors of each `@font-face`
    std::vector<std::string_view> ignored;  ///< how rules begin that cannot be read or are not known
};

/// Text without comments (see withoutComments). Its layers are made in `layers`, below `layer`.
StyleSheet parseStyleSheet(std::string_view text, Layers& layers, std::size_t layer = 0);

/// CSS comments, and the HTML ones that old files hide sheets in, as spaces.
std::string withoutComments(std::string_view text);

}  // namespace vtm::svg
