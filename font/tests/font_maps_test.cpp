#include <vtm/font/font_maps.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/place.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"
#include "font/parts.hpp"
#include "font/tests/support.hpp"
#include "text/font_set.hpp"

namespace vtm::font {
namespace {

FontMaps serif(const Options& options = {}) { return FontMaps(fileOf(dejavu / "DejaVuSerif.ttf"), options); }

TEST(FontMaps, LatinFontTakesLessThan128KiB) {
    for (const char* name : {"DejaVuSerif.ttf", "DejaVuSans.ttf", "DejaVuSansMono.ttf"}) {
        FontMaps font(fileOf(dejavu / name));
        EXPECT_EQ(font.addCharacters(latin(font)), U"");
        EXPECT_LE(asset::write(font.asset()).size(), 128u << 10) << name;
    }
}

TEST(FontMaps, AccentedLettersShareTheirParts) {
    FontMaps font = serif();
    font.addCharacters(U"eéèê");
    const asset::Asset asset = font.asset();
    ASSERT_EQ(asset.glyphs.size(), 4u);
    EXPECT_EQ(asset.maps.size(), 1u + 4u);  // e and three accents
    EXPECT_EQ(asset.glyphParts.size(), 7u);
}

TEST(FontMaps, HolesBelongToWhatIsAroundThem) {
    const auto ring = [](double r) { return scene::rectangle({-r, -r}, {r, r}); };
    scene::Path path = ring(400);
    for (const double r : {300.0, 100.0}) {
        const scene::Path inner = ring(r);
        path.insert(path.end(), inner.begin(), inner.end());
    }
    EXPECT_EQ(partsOf(path, 1000).size(), 1u);
    const scene::Path far = mapped(ring(50), 1, {600, 0});
    path.insert(path.end(), far.begin(), far.end());
    EXPECT_EQ(partsOf(path, 1000).size(), 2u);
    const scene::Path touching = mapped(ring(80), 1, {475, 0});  // both of them
    path.insert(path.end(), touching.begin(), touching.end());
    EXPECT_EQ(partsOf(path, 1000).size(), 1u);
}

/// A glyph on a page of its own, by its parts.
asset::Asset alone(const asset::Asset& font, const asset::Glyph& glyph) {
    asset::Asset asset;
    asset.width = asset.height = 3;
    asset.maps = {{0, 0, 3, asset::Entry::make(asset::Entry::Kind::Solid, 0), 0}};
    asset.paints = font.paints;
    asset.commands = {asset::Command{}};
    std::vector<asset::PlacementInSquare> placements;
    for (std::uint32_t i = 0; i < glyph.partCount(); ++i) {
        const asset::GlyphPart& part = font.glyphParts[glyph.firstPart() + i];
        const asset::Map& map = font.maps[part.map];
        const std::uint16_t index = asset::appendMap(asset::extractMap(font, part.map), asset);
        const glm::dvec2 corner(1 + map.x + double(part.x), 2 + map.y + double(part.y));
        placements.push_back({index, {0, 1}, {glm::dmat2(map.side / 3), corner / 3.0}});
    }
    const std::uint32_t trees = asset::appendInstances(placements, asset);
    asset.maps.front().instances = trees;
    return asset;
}

/// Some glyphs at six sizes and two angles. With VTM_GLYPHS=all every one of the fonts, with VTM_GLYPHS=20
/// every twentieth, at 20 angles.
TEST(FontMaps, GlyphsAreThoseOfTheReference) {
    const char* wanted = std::getenv("VTM_GLYPHS");
    const std::uint32_t step = !wanted ? 0 : std::max(1, std::atoi(wanted));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> turn(0, 6.28);
    std::size_t views = 0;
    double worst = 0;
    for (const std::filesystem::path& file : {dejavu / "DejaVuSerif.ttf", dejavu / "DejaVuSans.ttf",
                                              dejavu / "DejaVuSansMono.ttf", amiri, microHei}) {
        if (!std::filesystem::exists(file))
            continue;
        const std::string name = file.filename().string();
        text::FontOptions options;
        options.systemFonts = false;
        text::FontSet set(options);
        text::FontFace face;
        face.family = "x";
        const Bytes bytes = fileOf(file);
        set.add(face, bytes);
        text::FontQuery query;
        query.families = {"x"};
        const auto font = set.primary(query);
        FontMaps maps(bytes);
        std::vector<std::uint32_t> ids;
        for (std::uint32_t id = 0; step > 0 && id < font->glyphCount(); id += step)
            ids.push_back(id);
        maps.addGlyphs(ids);
        if (step == 0)
            maps.addCharacters(U"Rg&@éÅijQ%½8sS«ǅ日語ش");
        const asset::Asset asset = maps.asset();
        for (const asset::Glyph& glyph : asset.glyphs) {
            const auto outline = font->outlineOf(glyph.id);
            if (!outline) {
                EXPECT_EQ(glyph.partCount(), 0u);
                continue;
            }
            scene::Item item;
            item.path = outline;
            item.transform = scene::compose(scene::translation(1, 2),
                                            scene::scaling(1 / font->unitsPerEm(), 1 / font->unitsPerEm()));
            scene::Scene scene;
            scene.width = scene.height = 3;
            scene.root.children = {{item}};
            const asset::Asset one = alone(asset, glyph);
            const asset::Scanner scanner(one);
            for (const double size : {6.0, 9.0, 14.0, 24.0, 60.0, 200.0})
                for (int i = 0; i < (step > 0 ? 20 : 2); ++i) {
                    const int pixels = int(2 * size);
                    const asset::View view = viewOver(0.5, 0.5, 2, 2, pixels, i == 0 ? 0 : turn(random));
                    const auto difference = compare::compare(
                        scanner.draw(view),
                        reference::render(scene, {view.width, view.height, view.toPixels}, {.samples = 1}));
                    EXPECT_LE(difference.max, 4) << name << " glyph " << glyph.id << " at " << size;
                    worst = std::max(worst, difference.max);
                    ++views;
                }
        }
    }
    fmt::print("{} views, max {:.2f}/255\n", views, worst);
}

TEST(FontMaps, TakesWhatWasMadeBefore) {
    FontMaps first = serif();
    first.addCharacters(U"Vector Texture Mäps");
    const asset::Asset stored = asset::read(asset::write(first.asset()));
    FontMaps second = serif();
    ASSERT_TRUE(second.take(stored));
    EXPECT_EQ(second.glyphCount(), first.glyphCount());
    EXPECT_EQ(asset::write(second.asset()), asset::write(stored));
    second.addCharacters(U"Vecö");  // the dots of ä
    EXPECT_EQ(second.asset().maps.size(), stored.maps.size());
    EXPECT_FALSE(FontMaps(fileOf(dejavu / "DejaVuSans.ttf")).take(stored));
    EXPECT_FALSE(serif({.tolerance = 1.0 / 4096}).take(stored));
}

TEST(FontMaps, SpecimenIsAPicture) {
    FontMaps font = serif();
    font.addCharacters(latin(font));
    const asset::Asset asset = asset::read(asset::write(font.asset()));
    const asset::View view = viewOver(0, 0, asset.width, asset.height, 320);
    double ink = 0;
    const image::Raster raster = asset::Scanner(asset).draw(view);
    for (std::size_t i = 3; i < raster.rgba.size(); i += 4)
        ink += raster.rgba[i];
    EXPECT_GT(ink, 0.05 * view.width * view.height);
    EXPECT_LT(ink, 0.4 * view.width * view.height);
    EXPECT_GT(*asset.finestPixel, 0);
    EXPECT_LT(*asset.finestPixel, 1.0 / 400);
}

TEST(FontMaps, TellsWhatItCannotDo) {
    EXPECT_THROW(FontMaps(Bytes{1, 2, 3, 4}), FontError);
    EXPECT_THROW(FontMaps(Bytes{}), FontError);
    EXPECT_THROW(serif({.face = 7}), FontError);
    EXPECT_THROW(serif({.tolerance = 0}), std::invalid_argument);
    EXPECT_THROW(serif({.tolerance = std::nan("")}), std::invalid_argument);
    EXPECT_THROW(serif({.variations = {{"weight", 700}}}), std::invalid_argument);
    EXPECT_THROW(serif({.nanosecondsPerByte = 0}), std::invalid_argument);
    FontMaps font = serif();
    EXPECT_EQ(font.addCharacters(U"a\U0001F600b"), U"\U0001F600");
    EXPECT_EQ(font.glyphCount(), 2u);
    const std::uint32_t far = 1u << 20;
    EXPECT_THROW(font.addGlyphs(std::span(&far, 1)), std::out_of_range);
    EXPECT_EQ(font.family(), "DejaVu Serif");
    EXPECT_TRUE(asset::read(asset::write(serif().asset())).glyphs.empty());
}

}  // namespace
}  // namespace vtm::font
