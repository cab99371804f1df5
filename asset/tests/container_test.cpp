#include <vtm/asset/container.hpp>

#include <cstring>

#include <gtest/gtest.h>

#include <vtm/raster/evaluate.hpp>
#include "asset/testing.hpp"
#include "asset/testing_files.hpp"
#include "raster/testing_views.hpp"

namespace vtm::asset::test {
namespace {

TEST(Container, ReadsWhatItWrote) {
    for (const Asset& asset :
         {everySection(), layers(), disc(), twoLevels(), placedMaps(), filtered(), emptyAsset()}) {
        const Asset copy = read(write(asset));
        EXPECT_EQ(write(copy), write(asset));
        EXPECT_EQ(copy.commands.size(), asset.commands.size());
        EXPECT_EQ(copy.fallbackLeaves, asset.fallbackLeaves);
        EXPECT_EQ(copy.filterPixels, asset.filterPixels);
        EXPECT_EQ(copy.prefilter.size, asset.prefilter.size);
        EXPECT_EQ(copy.prefilter.texels, asset.prefilter.texels);
        EXPECT_EQ(copy.font.has_value(), asset.font.has_value());
        ASSERT_EQ(copy.glyphs.size(), asset.glyphs.size());
        EXPECT_EQ(copy.images.size(), asset.images.size());
        ASSERT_EQ(copy.materials.size(), asset.materials.size());
        for (std::size_t i = 0; i < asset.materials.size(); ++i) {
            EXPECT_EQ(copy.materials[i].name, asset.materials[i].name);
            EXPECT_EQ(copy.materials[i].glsl, asset.materials[i].glsl);
        }
        for (std::size_t i = 0; i < asset.images.size(); ++i)
            EXPECT_EQ(copy.images[i].rgba, asset.images[i].rgba);
        const View view = turnedView(32, 32, {32, 32}, 0.7, 0.4);
        EXPECT_EQ(evaluate(copy, view).rgba, evaluate(asset, view).rgba);
    }
}

TEST(Container, ReadsFromAnyAddress) {
    const Asset asset = everySection();
    const Bytes bytes = write(asset);
    Bytes shifted(bytes.size() + 16);
    for (std::size_t shift = 0; shift < 16; ++shift) {
        std::ranges::copy(bytes, shifted.begin() + std::ptrdiff_t(shift));
        EXPECT_EQ(write(read(std::span(shifted).subspan(shift, bytes.size()))), bytes);
    }
}

TEST(Container, ListsItsSections) {
    const auto sections = sectionsOf(write(everySection()));
    std::vector<std::string> names;
    for (const SectionInfo& section : sections) {
        names.push_back(section.name);
        EXPECT_EQ(section.offset % 64, 0u) << section.name;
        EXPECT_TRUE(section.intact()) << section.name;
        EXPECT_GT(section.count, 0u) << section.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"picture", "maps", "commands", "nodes", "leaves", "pieces",
                                               "paints", "data", "images", "image bytes", "prefilter",
                                               "materials", "material bytes", "drawn filters"}));
    EXPECT_EQ(sectionsOf(write(disc())).size(), 10u);
}

template <class Record>
void expectAsInMemory(const Bytes& file, const SectionInfo& section, const std::vector<Record>& records) {
    ASSERT_EQ(section.bytes(), records.size() * sizeof(Record)) << section.name;
    EXPECT_EQ(std::memcmp(&file[section.offset], records.data(), section.bytes()), 0) << section.name;
}

TEST(Container, HoldsRecordsAsTheyAreInMemory) {
    const Asset asset = everySection();
    const Bytes file = write(asset);
    const auto sections = sectionsOf(file);
    expectAsInMemory(file, sections[1], asset.maps);
    expectAsInMemory(file, sections[2], asset.commands);
    expectAsInMemory(file, sections[3], asset.nodes);
    expectAsInMemory(file, sections[4], asset.leaves);
    expectAsInMemory(file, sections[5], asset.pieces);
    expectAsInMemory(file, sections[6], asset.paints);
    expectAsInMemory(file, sections[7], asset.data);
    expectAsInMemory(file, sections[10], asset.prefilter.texels);
}

/// A reader of today skips what a later writer adds, if that is marked as dispensable.
TEST(Container, SkipsUnknownSectionsThatMayBeIgnored) {
    const Bytes known = write(disc());
    const Bytes more = withSection(known, 0x8000FF01u, 12, 5);
    EXPECT_EQ(refusal(more), "");
    EXPECT_EQ(write(read(more)), known);
    EXPECT_EQ(sectionsOf(more).back().name, "0x8000ff01");
    Bytes damaged = more;
    damaged[sectionsOf(more).back().offset] ^= 1;
    EXPECT_NE(refusal(damaged).find("section 0x8000ff01: checksum does not match"), std::string::npos);
}

}  // namespace
}  // namespace vtm::asset::test
