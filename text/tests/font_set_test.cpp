#include "text/font_set.hpp"
#include "tests/test_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <hb-ot.h>

#include "text/fonts/library.hpp"
#include "text/tests/support.hpp"

namespace vtm::text {
namespace {

std::string nameAt(const std::shared_ptr<const Font>& font, hb_ot_name_id_t id) {
    if (!font)
        return "none";
    char text[128] = {};
    unsigned size = sizeof text;
    hb_ot_name_get_utf8(hb_font_get_face(font->harfbuzz()), id, HB_LANGUAGE_INVALID, &size, text);
    return text;
}

std::string fullName(const std::shared_ptr<const Font>& font) {
    return nameAt(font, HB_OT_NAME_ID_FULL_NAME);
}

class DejaVu : public testing::Test {
protected:
    FontSet set{optionsOf(dejavu)};
};

TEST_F(DejaVu, FamiliesAreFoundInAnyCase) {
    EXPECT_TRUE(set.hasFamily("DejaVu Sans"));
    EXPECT_TRUE(set.hasFamily("dejavu SANS"));
    EXPECT_FALSE(set.hasFamily("DejaVu"));
}
TEST_F(DejaVu, WeightsSelectFaces) {
    EXPECT_EQ(fullName(set.primary(family("DejaVu Sans", 400))), "DejaVu Sans");
    EXPECT_EQ(fullName(set.primary(family("DejaVu Sans", 700))), "DejaVu Sans Bold");
    EXPECT_EQ(fullName(set.primary(family("DejaVu Sans", 450))), "DejaVu Sans") << "lighter before bold";
}
TEST_F(DejaVu, TheSameQueryGivesTheSameFont) {
    EXPECT_EQ(set.primary(family("DejaVu Sans")), set.primary(family("DejaVu Sans")));
    FontSet other(optionsOf(dejavu));
    EXPECT_EQ(set.primary(family("DejaVu Sans")), other.primary(family("DejaVu Sans")));
}
TEST(FontLibrary, KeepsTheLastFontsOpen) {
    const auto opened = [](const FontQuery& query) -> std::weak_ptr<const Font> {
        FontSet set(optionsOf(dejavu));
        return set.primary(query);
    };
    const std::weak_ptr<const Font> first = opened(family("DejaVu Sans"));
    EXPECT_FALSE(first.expired());
    for (const char* name : {"DejaVu Sans Mono", "DejaVu Serif"})
        for (const double weight : {400, 700})
            for (const Slant slant : {Slant::Normal, Slant::Oblique}) {
                FontQuery query = family(name, weight);
                query.slant = slant;
                EXPECT_FALSE(opened(query).expired());
            }
    EXPECT_TRUE(first.expired()) << "eight others were opened since";
}
TEST_F(DejaVu, WithoutTheDefaultFamilyTheFirstByNameStandsIn) {
    EXPECT_EQ(set.primary(family("Absent"))->family().substr(0, 6), "DejaVu");
}
TEST_F(DejaVu, NoFontHasAnUnassignedCharacter) {
    EXPECT_EQ(set.covering(family("DejaVu Sans"), U"\U0003fffd"), nullptr);
}

TEST(FontSet, WithoutFontsThereIsNone) {
    FontSet set(optionsOf("/nowhere/at/all"));
    EXPECT_EQ(set.primary(family("serif")), nullptr);
    EXPECT_EQ(set.covering(family("serif"), U"a"), nullptr);
}

TEST(FontLibrary, RemembersTheAnswerToEachQuestion) {
    FontQuery bold = family("Absent", 700), slanted = family("Absent"), turkish = family("Absent"),
              wide = family("Absent");
    slanted.slant = Slant::Italic;
    turkish.language = "tr";
    wide.stretch = 200;
    const std::vector<FontQuery> queries{family("Absent"), family("serif"), bold, slanted, turkish, wide};
    const auto files = [](const std::vector<const FaceEntry*>& faces) {
        std::vector<std::string> names;
        for (const FaceEntry* face : faces)
            names.push_back(face->file + "#" + std::to_string(face->index));
        return names;
    };
    const FontLibrary library(FontOptions{});
    for (int round = 0; round < 2; ++round)
        for (const FontQuery& query : queries) {
            const FontLibrary other(FontOptions{});
            EXPECT_EQ(files(library.substitutes(query)), files(other.substitutes(query)));
            EXPECT_EQ(files(library.aliasOf(query.families[0])), files(other.aliasOf(query.families[0])));
        }
    for (int i = 0; i < 600; ++i)  // more than it remembers
        library.aliasOf("Absent " + std::to_string(i));
    EXPECT_EQ(files(library.aliasOf("serif")), files(FontLibrary(FontOptions{}).aliasOf("serif")));
}

TEST(FontSet, SystemFontsStandInForAbsentFamilies) {
    FontSet set({});
    EXPECT_NE(set.primary(family("Absent")), nullptr);
    EXPECT_TRUE(set.hasFamily("DejaVu Sans"));
}

/// Fontconfig with DejaVu and rules as Debian's: what is equal, what a generic name prefers, to which kind a
/// family belongs.
class Fontconfig : public testing::Test {
protected:
    Fontconfig() {
        const std::string file = (folder / "fonts.conf").string();
        std::ofstream(file) << R"(<fontconfig><dir>)" << dejavu.string() << R"(</dir>
            <alias binding="same"><family>Typewriter</family><accept><family>DejaVu Sans Mono</family></accept></alias>
            <alias><family>Roman</family><default><family>serif</family></default></alias>
            <alias><family>Grotesque</family><default><family>sans-serif</family></default></alias>
            <alias><family>serif</family><prefer><family>DejaVu Serif</family></prefer></alias>
            <alias><family>sans-serif</family><prefer><family>DejaVu Sans</family></prefer></alias>
            <alias><family>monospace</family><prefer><family>DejaVu Sans Mono</family></prefer></alias>
            </fontconfig>)";
        setenv("FONTCONFIG_FILE", file.c_str(), 1);
        FontOptions options;
        options.directories = {(folder / "no_fonts").string()};  // a library of its own
        options.defaultFamily = "Roman";
        set = std::make_unique<FontSet>(options);
        unsetenv("FONTCONFIG_FILE");
    }
    std::string first(std::vector<std::string> families) {
        FontQuery query;
        query.families = std::move(families);
        const auto font = set->primary(query);
        return font ? font->family() : "";
    }
    const TestFolder folder;
    std::unique_ptr<FontSet> set;
};

TEST_F(Fontconfig, SaysWhatGenericNamesAre) {
    EXPECT_EQ(first({"sans-serif"}), "DejaVu Sans");
    EXPECT_EQ(first({"serif"}), "DejaVu Serif");
    EXPECT_EQ(first({"monospace"}), "DejaVu Sans Mono");
    EXPECT_EQ(first({"system-ui"}), "DejaVu Sans");
    EXPECT_EQ(first({"Grotesque", "serif"}),
              "DejaVu Serif");  // the next of the list before what is like the first
    EXPECT_EQ(first({"Roman", "sans-serif"}), "DejaVu Sans");
}

TEST_F(Fontconfig, SaysWhatIsLikeAFamilyThatIsNotThere) {
    EXPECT_EQ(first({"Roman"}), "DejaVu Serif");
    EXPECT_EQ(first({"Grotesque"}), "DejaVu Sans");
    EXPECT_EQ(first({"Typewriter", "DejaVu Serif"}), "DejaVu Sans Mono");  // equal, so as if it were there
    EXPECT_FALSE(set->hasFamily("Typewriter"));
    EXPECT_EQ(first({}), "DejaVu Serif");  // the default family
}

/// As "Segoe UI Emoji" in the lists of many programs: a colour font stands for it, with letters of its own.
TEST_F(Fontconfig, ColoredFontsThatStandInAreForEmoji) {
    if (!std::filesystem::exists(suiteFonts()))
        GTEST_SKIP() << suiteFonts() << " of the svg-suite is absent";
    const std::string file = (folder / "emoji.conf").string();
    std::ofstream(file) << "<fontconfig><dir>" << dejavu.string() << "</dir><dir>" << suiteFonts().string()
                        << R"(</dir><alias binding="same"><family>Segoe UI Emoji</family>
            <accept><family>CFF Outlines and SBIX</family></accept></alias></fontconfig>)";
    setenv("FONTCONFIG_FILE", file.c_str(), 1);
    FontOptions options;
    options.directories = {(folder / "no_emoji").string()};  // a library of its own
    set = std::make_unique<FontSet>(options);
    unsetenv("FONTCONFIG_FILE");
    FontQuery query;
    query.families = {"Absent", "Segoe UI Emoji", "DejaVu Sans"};
    EXPECT_EQ(set->covering(query, U"A")->family(), "DejaVu Sans");
    EXPECT_EQ(set->covering(query, U"A\ufe0f")->family(), "CFF Outlines and SBIX");
    query.families = {"CFF Outlines and SBIX", "DejaVu Sans"};
    EXPECT_EQ(set->covering(query, U"A")->family(), "CFF Outlines and SBIX");  // it was named
}

TEST_F(SuiteFonts, GenericFamiliesAreMapped) {
    FontSet set(optionsOf(suiteFonts()));
    EXPECT_EQ(set.primary(family("serif"))->family(), "Noto Serif");
    EXPECT_EQ(set.primary(family("Sans-Serif"))->family(), "Noto Sans");
    EXPECT_EQ(set.primary(family("cursive"))->family(), "Yellowtail");
    EXPECT_EQ(set.primary(family("fantasy"))->family(), "Sedgwick Ave Display");
    EXPECT_EQ(set.primary(family("monospace"))->family(), "Noto Mono");
}
TEST_F(SuiteFonts, AbsentFamiliesFallBackToSerif) {
    FontSet set(optionsOf(suiteFonts()));
    EXPECT_EQ(set.primary(family("Absent"))->family(), "Noto Serif");
}
TEST_F(SuiteFonts, WeightsAreMatchedAsCssSays) {
    FontSet set(optionsOf(suiteFonts()));
    EXPECT_EQ(fullName(set.primary(family("Noto Sans", 100))), "Noto Sans Thin");
    EXPECT_EQ(fullName(set.primary(family("Noto Sans", 200))), "Noto Sans Thin") << "lighter first below 400";
    EXPECT_EQ(fullName(set.primary(family("Noto Sans", 300))), "Noto Sans Light");
    EXPECT_EQ(fullName(set.primary(family("Noto Sans", 500))), "Noto Sans Regular") << "400 before 700";
    EXPECT_EQ(fullName(set.primary(family("Noto Sans", 600))), "Noto Sans Bold") << "bolder first above 500";
    EXPECT_EQ(fullName(set.primary(family("Noto Sans", 1000))), "Noto Sans Black");
}
TEST_F(SuiteFonts, SlantIsMatchedBeforeWeight) {
    FontSet set(optionsOf(suiteFonts()));
    FontQuery query = family("Noto Sans", 900);
    query.slant = Slant::Italic;
    EXPECT_EQ(fullName(set.primary(query)), "Noto Sans Italic");
    query.slant = Slant::Oblique;
    EXPECT_EQ(fullName(set.primary(query)), "Noto Sans Italic");
}
TEST_F(SuiteFonts, FamiliesAreTriedInOrder) {
    FontSet set(optionsOf(suiteFonts()));
    FontQuery query = family("Absent");
    query.families = {"Absent", "Yellowtail", "Noto Sans"};
    EXPECT_EQ(set.primary(query)->family(), "Yellowtail");
    EXPECT_EQ(set.covering(query, U"я")->family(), "Noto Sans");
}
TEST_F(SuiteFonts, FallbackFindsTheScript) {
    FontSet set(optionsOf(suiteFonts()));
    EXPECT_EQ(set.covering(family("Noto Sans"), U"ب")->family(), "Amiri");
    EXPECT_EQ(set.covering(family("Noto Sans"), U"日")->family(), "Mplus 1p");
    EXPECT_EQ(set.covering(family("Noto Sans"), U"\u200d日\ufe0f")->family(), "Mplus 1p")
        << "joiners need no glyph";
}
TEST_F(SuiteFonts, SelectorsChooseBetweenTextAndColor) {
    FontSet set(optionsOf(suiteFonts()));
    FontQuery query = family("Noto Sans");
    query.families = {"Noto Sans", "CFF Outlines and SBIX"};  // the second one is coloured
    EXPECT_EQ(set.covering(query, U"A")->family(), query.families[0]);
    EXPECT_EQ(set.covering(query, U"A\ufe0f")->family(), query.families[1]);
    std::swap(query.families[0], query.families[1]);
    EXPECT_EQ(set.covering(query, U"A")->family(), query.families[0]);
    EXPECT_EQ(set.covering(query, U"A\ufe0e")->family(), query.families[1]);
}
TEST_F(SuiteFonts, VariableFontsTakeTheirAxesFromTheQuery) {
    FontSet set(optionsOf(suiteFonts()));
    const auto light = set.primary(family("Roboto Flex", 100)),
               heavy = set.primary(family("Roboto Flex", 900));
    ASSERT_NE(light, heavy);
    const GlyphId glyph = light->glyphOf(U'N').value();
    EXPECT_LT(light->advanceOf(glyph), heavy->advanceOf(glyph));
    FontQuery query = family("Roboto Flex", 100);
    query.variations = {{HB_TAG('w', 'g', 'h', 't'), 900}};
    EXPECT_EQ(set.primary(query), heavy) << "variations override the weight";
}

}  // namespace
}  // namespace vtm::text
