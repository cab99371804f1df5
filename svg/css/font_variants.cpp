#include "svg/css/font_variants.hpp"

#include <algorithm>
#include <iterator>

#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

struct Row {
    std::string_view keyword;
    VariantGroup group;
    std::string_view features;  ///< four letters each
    std::uint32_t value = 1;
};

constexpr Row variantRows[]{{"common-ligatures", VariantGroup::Ligatures, "ligaclig"},
                            {"no-common-ligatures", VariantGroup::Ligatures, "ligaclig", 0},
                            {"discretionary-ligatures", VariantGroup::Ligatures, "dlig"},
                            {"no-discretionary-ligatures", VariantGroup::Ligatures, "dlig", 0},
                            {"historical-ligatures", VariantGroup::Ligatures, "hlig"},
                            {"no-historical-ligatures", VariantGroup::Ligatures, "hlig", 0},
                            {"contextual", VariantGroup::Ligatures, "calt"},
                            {"no-contextual", VariantGroup::Ligatures, "calt", 0},
                            {"small-caps", VariantGroup::Caps, "smcp"},
                            {"all-small-caps", VariantGroup::Caps, "smcpc2sc"},
                            {"petite-caps", VariantGroup::Caps, "pcap"},
                            {"all-petite-caps", VariantGroup::Caps, "pcapc2pc"},
                            {"unicase", VariantGroup::Caps, "unic"},
                            {"titling-caps", VariantGroup::Caps, "titl"},
                            {"sub", VariantGroup::Position, "subs"},
                            {"super", VariantGroup::Position, "sups"},
                            {"lining-nums", VariantGroup::Numeric, "lnum"},
                            {"oldstyle-nums", VariantGroup::Numeric, "onum"},
                            {"proportional-nums", VariantGroup::Numeric, "pnum"},
                            {"tabular-nums", VariantGroup::Numeric, "tnum"},
                            {"diagonal-fractions", VariantGroup::Numeric, "frac"},
                            {"stacked-fractions", VariantGroup::Numeric, "afrc"},
                            {"ordinal", VariantGroup::Numeric, "ordn"},
                            {"slashed-zero", VariantGroup::Numeric, "zero"},
                            {"jis78", VariantGroup::EastAsian, "jp78"},
                            {"jis83", VariantGroup::EastAsian, "jp83"},
                            {"jis90", VariantGroup::EastAsian, "jp90"},
                            {"jis04", VariantGroup::EastAsian, "jp04"},
                            {"simplified", VariantGroup::EastAsian, "smpl"},
                            {"traditional", VariantGroup::EastAsian, "trad"},
                            {"full-width", VariantGroup::EastAsian, "fwid"},
                            {"proportional-width", VariantGroup::EastAsian, "pwid"},
                            {"ruby", VariantGroup::EastAsian, "ruby"}};

FontVariants bit(std::size_t row) { return FontVariants(1) << row; }

/// The bit of a keyword; nothing for words that are not in the table.
std::optional<std::size_t> rowOf(std::string_view keyword) {
    const auto found = std::find_if(std::begin(variantRows), std::end(variantRows),
                                    [&](const Row& row) { return equalsIgnoringCase(row.keyword, keyword); });
    return found == std::end(variantRows)
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - std::begin(variantRows)));
}

std::optional<FontVariants> parseWords(std::string_view text, FontVariants allowed) {
    FontVariants variants = 0;
    for (Cursor cursor(text); !cursor.atEnd(); cursor.skipSpaces()) {
        const auto row = rowOf(cursor.identifier());
        if (!row || !(allowed & bit(*row)) || (variants & bit(*row)))
            return std::nullopt;
        variants |= bit(*row);
    }
    return variants;
}

}  // namespace

FontVariants variantsOf(VariantGroup group) {
    FontVariants variants = 0;
    for (std::size_t row = 0; row < std::size(variantRows); ++row)
        if (variantRows[row].group == group)
            variants |= bit(row);
    return variants;
}

std::optional<FontVariants> parseVariants(std::string_view text, VariantGroup group) {
    if (equalsIgnoringCase(text, "normal"))
        return FontVariants(0);
    if (group == VariantGroup::Ligatures && equalsIgnoringCase(text, "none"))
        return parseWords(
            "no-common-ligatures no-discretionary-ligatures no-historical-ligatures no-contextual",
            variantsOf(group));
    return parseWords(text, variantsOf(group));
}

std::optional<FontVariants> parseVariants(std::string_view text) {
    if (equalsIgnoringCase(text, "normal") || equalsIgnoringCase(text, "none"))
        return parseVariants(text, VariantGroup::Ligatures);
    return parseWords(text, ~FontVariants(0));
}

std::vector<text::Feature> featuresOf(FontVariants variants) {
    std::vector<text::Feature> features;
    for (std::size_t row = 0; row < std::size(variantRows); ++row)
        if (variants & bit(row))
            for (std::string_view letters = variantRows[row].features; !letters.empty();
                 letters.remove_prefix(4))
                features.push_back({fontTag(letters.substr(0, 4)), variantRows[row].value});
    return features;
}

}  // namespace vtm::svg
