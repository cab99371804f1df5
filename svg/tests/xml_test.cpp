#include <zlib.h>

#include "svg/tests/support.hpp"
#include "svg/xml/decode.hpp"

namespace vtm::svg {
namespace {

constexpr std::string_view rect = "<rect width='10' height='10' fill='lime'/>";

std::size_t count(std::string_view text) { return itemsOf(loadText(text)).size(); }

Location errorAt(std::string_view text) {
    Options options;
    options.fileName = "broken.svg";
    try {
        loadText(text, options);
    } catch (const ParseError& error) {
        return error.where();
    }
    ADD_FAILURE() << "no error";
    return {};
}

TEST(Xml, ErrorsNameFileLineAndColumn) {
    const Location where = errorAt("<svg xmlns='http://www.w3.org/2000/svg'>\n <g>\n</svg>");
    EXPECT_EQ(where.file, "broken.svg");
    EXPECT_EQ(where.line, 3);
}

TEST(Xml, WarningsNameElementLineAndColumn) {
    const Document loaded = loadText("<svg xmlns='http://www.w3.org/2000/svg'>\n\n   <foreignObject/></svg>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings[0].where.line, 3);
    EXPECT_EQ(loaded.warnings[0].where.column, 5);
    EXPECT_NE(loaded.warnings[0].message.find("<foreignObject>"), std::string::npos);
}

TEST(Xml, PrefixesAreResolved) {
    EXPECT_EQ(count("<s:svg xmlns:s='http://www.w3.org/2000/svg'><s:rect width='1' height='1'/></s:svg>"),
              1u);
}

TEST(Xml, ElementsOfOtherNamespacesAreNotDrawn) {
    EXPECT_EQ(
        count("<svg xmlns='http://www.w3.org/2000/svg'><rect xmlns='urn:x' width='1' height='1'/></svg>"),
        0u);
}

TEST(Xml, AFileWithoutNamespacesIsTakenForSvg) {
    EXPECT_EQ(count("<svg><rect width='1' height='1'/></svg>"), 1u);
}

TEST(Xml, RootOfAnotherKindIsAnError) {
    EXPECT_THROW(loadText("<html xmlns='http://www.w3.org/1999/xhtml'/>"), ParseError);
    EXPECT_THROW(loadText(""), ParseError);
}

TEST(Xml, XlinkMayHaveAnotherPrefix) {
    EXPECT_EQ(count("<svg xmlns='http://www.w3.org/2000/svg' xmlns:l='http://www.w3.org/1999/xlink'><defs>"
                    "<rect id='r' width='1' height='1'/></defs><use l:href='#r'/></svg>"),
              1u);
}

TEST(Xml, EntitiesExpandInContentAndAttributes) {
    const auto items =
        itemsOf(loadText("<!DOCTYPE svg [<!ENTITY shape \"<rect width='5' height='5' fill='&c;'/>\">"
                         "<!ENTITY c 'red'>]><svg xmlns='http://www.w3.org/2000/svg'>&shape;&shape;</svg>"));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(rgbOf(items[1].paint), 0xff0000);
}

TEST(Xml, EntitiesInCommentsAndCdataStay) {
    SourceMap map("", "");
    const std::string text = "<!DOCTYPE s [<!ENTITY a 'b'>]><s><!--&a;--><![CDATA[&a;]]>&a;&amp;</s>";
    EXPECT_EQ(expandEntities(text, map),
              "<!DOCTYPE s [<!ENTITY a 'b'>]><s><!--&a;--><![CDATA[&a;]]>b&amp;</s>");
}

TEST(Xml, PlacesBehindEntitiesAreThoseOfTheFile) {
    const Document loaded = loadText(
        "<!DOCTYPE svg [<!ENTITY e '\n\n\n'>]>\n<svg xmlns='http://www.w3.org/2000/svg'>\n"
        "&e;<foreignObject/></svg>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings[0].where.line, 6);
    EXPECT_EQ(loaded.warnings[0].where.column, 5);
}

TEST(Xml, BillionLaughsAreAnError) {
    std::string text = "<!DOCTYPE svg [<!ENTITY a0 'ha'>";
    for (int i = 1; i < 12; ++i) {
        text += "<!ENTITY a" + std::to_string(i) + " '";
        for (int k = 0; k < 10; ++k)
            text += "&a" + std::to_string(i - 1) + ";";
        text += "'>";
    }
    EXPECT_THROW(loadText(text + "]><svg>&a11;</svg>"), ParseError);
}

TEST(Xml, EntityThatNamesItselfIsAnError) {
    EXPECT_THROW(loadText("<!DOCTYPE svg [<!ENTITY a '&a;'>]><svg>&a;</svg>"), ParseError);
}

TEST(Xml, Utf16IsRead) {
    std::string text = "\xff\xfe";
    for (const char c : document(rect))
        text += {c, '\0'};
    EXPECT_EQ(count(text), 1u);
}

TEST(Xml, Latin1IsRead) {
    const Document loaded = loadText(
        "<?xml version='1.0' encoding='ISO-8859-1'?><svg xmlns='http://www.w3.org/2000/svg'>"
        "<style>.\xe4 { fill: red }</style><rect class='\xe4' width='1' height='1'/></svg>");
    EXPECT_EQ(rgbOf(itemsOf(loaded).at(0).paint), 0xff0000);
}

std::vector<std::uint8_t> gzipped(const std::string& text) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    std::vector<std::uint8_t> out(text.size() + 100);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = out.data();
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

TEST(Xml, CompressedFilesAreRead) { EXPECT_EQ(itemsOf(load(gzipped(document(rect)))).size(), 1u); }

TEST(Xml, BrokenCompressionIsAnError) {
    std::vector<std::uint8_t> bytes = gzipped(document(rect));
    bytes.resize(bytes.size() / 2);
    EXPECT_THROW(load(bytes), ParseError);
}

}  // namespace
}  // namespace vtm::svg
