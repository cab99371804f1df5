#include "text/font_set.hpp"
#include "text/shape.hpp"

namespace {

using namespace vtm::text;

FontOptions noFonts() {
    FontOptions options;
    options.systemFonts = false;
    return options;
}

FontQuery query() {
    FontQuery asked;
    asked.families = {"Fuzzed"};
    asked.weight = 700;  // a made bold, or an axis
    asked.slant = Slant::Italic;
    return asked;
}

Line line(bool vertical) {
    Line made;
    made.text = U"fi \u00c4g\u0301 \u0628\u0644 \u0915\u094d\u0937 \U0001f600\ufe0f";
    made.spans.push_back({made.text.size(), query(), {}, "en"});
    made.vertical = vertical;
    return made;
}

/// Characters are shaped and all that the first glyphs can be asked for is.
void use(FontSet& set) {
    for (const bool vertical : {false, true})
        for (const Cluster& cluster : shape(line(vertical), set))
            for (const Glyph& glyph : cluster.glyphs)
                glyph.font->outlineOf(glyph.id);
    const auto font = set.primary(query());
    constexpr GlyphId someGlyphs = 64;
    for (GlyphId glyph = 0; font && glyph < someGlyphs; ++glyph) {
        font->outlineOf(glyph);
        font->advanceOf(glyph);
        font->colorGlyphOf(glyph, {});
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FontSet set(noFonts());
    FontFace face;
    face.family = "Fuzzed";
    face.characters =
        size % 2 == 0 ? std::vector<FontFace::Range>{} : std::vector<FontFace::Range>{{U' ', U'z'}};
    try {
        set.add(face, {data, size});
        use(set);
    } catch (const FontError&) {
    }
    return 0;
}
