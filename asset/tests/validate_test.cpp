#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include "asset/testing.hpp"
#include "asset/testing_files.hpp"

namespace vtm::asset::test {
namespace {

/// One rule, broken by one change of a valid asset; the message must name the place.
struct Breach {
    const char* message;
    std::function<Asset()> make;
    std::function<void(Asset&)> change;
};

/// Changes an instruction of a paint's program.
void edit(Asset& asset, std::size_t paint, std::size_t i, const std::function<void(Instruction&)>& change) {
    Texel& texel = asset.data[asset.paints[paint][0] + i];
    auto in = std::bit_cast<Instruction>(texel);
    change(in);
    texel = std::bit_cast<Texel>(in);
}

std::uint32_t bitsOf(float value) { return std::bit_cast<std::uint32_t>(value); }

constexpr std::size_t firstProgram = 5;  // of everyPaint: a linear gradient; the next has two layers
constexpr std::size_t masked = 14;       // of everyPaint: image, push, linear, solid, mask

const std::vector<Breach> breaches{
    {"picture[0]: size is out of range", disc, [](Asset& a) { a.width = 0; }},
    {"picture[0]: size is out of range", disc,
     [](Asset& a) { a.height = std::numeric_limits<double>::infinity(); }},
    {"picture[0]: mode is unknown", disc, [](Asset& a) { a.mode = Mode(2); }},
    {"maps[0]: square is out of range", disc, [](Asset& a) { a.maps[0].side = -1; }},
    {"maps[0]: square is out of range", disc, [](Asset& a) { a.maps[0].x = std::nan(""); }},
    {"maps[0]: entry refers to a missing paint", emptyAsset,
     [](Asset& a) { a.maps[0].root = Entry::make(Entry::Kind::Solid, 5); }},
    {"maps[0]: entry refers to a missing leaf", disc,
     [](Asset& a) { a.maps[0].root = Entry::make(Entry::Kind::Leaf, 1); }},
    {"maps[0]: entry refers to a missing node", disc,
     [](Asset& a) { a.maps[0].root = Entry::make(Entry::Kind::Node, 0); }},
    {"maps[0]: entry's kind is unknown", disc, [](Asset& a) { a.maps[0].root.bits |= 3; }},
    {"nodes[1]: a child's index is not larger than its parent's", twoLevels,
     [](Asset& a) { a.nodes[1].children[3] = Entry::make(Entry::Kind::Node, 0); }},
    {"nodes[1]: a child's index is not larger than its parent's", twoLevels,
     [](Asset& a) { a.nodes[1].children[3] = Entry::make(Entry::Kind::Node, 1); }},
    {"maps[0]: tree is too deep", twoLevels,
     [](Asset& a) {
         a.nodes.resize(maxLevel + 1);
         for (std::uint32_t i = 0; i < maxLevel; ++i)
             a.nodes[i].children[0] = Entry::make(Entry::Kind::Node, i + 1);
     }},
    {"commands[0]: more squares and pieces are drawn than the limit", twoLevels,
     [](Asset& a) {
         a.nodes.resize(maxLevel);
         for (std::uint32_t i = 0; i + 1 < maxLevel; ++i)
             a.nodes[i].children.fill(Entry::make(Entry::Kind::Node, i + 1));
     }},
    {"leaves[0]: piece range is out of bounds", disc, [](Asset& a) { a.leaves[0].firstPiece = 1; }},
    {"leaves[0]: piece range is out of bounds", disc, [](Asset& a) { a.leaves[0].firstPiece = 0xFFFFFFFF; }},
    {"leaves[0]: unused half is not zero", disc, [](Asset& a) { a.leaves[0].unused = 1; }},
    {"leaves[0]: a corner or piece refers to a missing paint", disc,
     [](Asset& a) { a.leaves[0].corners[2] = 5; }},
    {"leaves[0]: a corner or piece refers to a missing paint", disc, [](Asset& a) { a.pieces[7].right = 5; }},
    {"pieces[3]: slope is below -1", disc, [](Asset& a) { a.pieces[3].slopeB = -32768; }},
    {"paints[0]: must be transparent", disc, [](Asset& a) { a.paints[0] = a.paints[1]; }},
    {"paints[1]: colour is out of range", disc, [](Asset& a) { a.paints[1][2] = bitsOf(1.5f); }},
    {"paints[1]: colour is out of range", disc, [](Asset& a) { a.paints[1][0] = bitsOf(std::nanf("")); }},
    {"paints[65536]: index needs more than 16 bits", disc, [](Asset& a) { a.paints.resize(65537); }},
    {"paints[5]: program is out of bounds", everyPaint,
     [](Asset& a) { a.paints[firstProgram][0] = std::uint32_t(a.data.size()); }},
    {"paints[5]: program is too long", everyPaint,
     [](Asset& a) { a.paints[firstProgram][1] = maxInstructions + 1; }},
    {"paints[5]: operation is unknown", everyPaint,
     [](Asset& a) { edit(a, firstProgram, 0, [](Instruction& in) { in.op = Op(10); }); }},
    {"paints[14]: blend mode is unknown", everyPaint,
     [](Asset& a) { edit(a, masked, 4, [](Instruction& in) { in.blend = Blend(17); }); }},
    {"paints[5]: opacity is out of range", everyPaint,
     [](Asset& a) { edit(a, firstProgram, 0, [](Instruction& in) { in.opacity = -0.1f; }); }},
    {"paints[14]: program pops an empty stack", everyPaint,
     [](Asset& a) { edit(a, masked, 1, [](Instruction& in) { in.op = Op::Pop; }); }},
    {"paints[14]: program does not close a group", everyPaint, [](Asset& a) { a.paints[masked][1] = 4; }},
    {"paints[1]: program overflows its stack", disc,
     [](Asset& a) {
         for (unsigned i = 0; i < maxStack; ++i)
             a.data.push_back({});
         a.paints[1] = {0, maxStack, 0, programTag};
     }},
    {"commands[0]: kind is unknown", disc, [](Asset& a) { a.commands[0].kind = Command::Kind(10); }},
    {"commands[0]: draws layers in exact mode", layers, [](Asset& a) { a.mode = Mode::Exact; }},
    {"commands[0]: draws a map in compat mode", disc, [](Asset& a) { a.mode = Mode::Compat; }},
    {"commands[1]: draws layers in exact mode", disc,
     [](Asset& a) {
         a.commands.push_back({Command::Kind::Push, {}, 1, 0, 0});
     }},
    {"commands[0]: blend mode is unknown", disc, [](Asset& a) { a.commands[0].blend = Blend(17); }},
    {"commands[0]: opacity is out of range", disc, [](Asset& a) { a.commands[0].opacity = 2; }},
    {"commands[0]: refers to a missing map", disc, [](Asset& a) { a.commands[0].map = 1; }},
    {"commands[0]: refers to a missing paint", layers, [](Asset& a) { a.commands[0].paint = 6; }},
    {"commands[0]: its map is not a mask: it has a paint index above 1", layers,
     [](Asset& a) { a.maps[a.commands[0].map].root = Entry::make(Entry::Kind::Solid, 2); }},
    {"commands[0]: pops the last picture, or an input of a filter", layers,
     [](Asset& a) { a.commands[0].kind = Command::Kind::Pop; }},
    {"commands[1]: a group is not closed at the end", layers,
     [](Asset& a) {
         a.commands.resize(1);
         a.commands[0].kind = Command::Kind::Push;
     }},
    {"commands[63]: stack of pictures overflows", layers,
     [](Asset& a) {
         a.commands.assign(maxPictures, {Command::Kind::Push, {}, 1, 0, 0});
     }},
    {"materials[0]: name is not a plain identifier", everyPaint,
     [](Asset& a) { a.materials[0].name = "1a"; }},
    {"materials[0]: name is not a plain identifier", everyPaint,
     [](Asset& a) { a.materials[0].name = "a__b"; }},
    {"materials[0]: name is not a plain identifier", everyPaint,
     [](Asset& a) { a.materials[0].name = "gl_a"; }},
    {"materials[0]: name is not a plain identifier", everyPaint,
     [](Asset& a) { a.materials[0].name.assign(maxMaterialName + 1, 'a'); }},
    {"materials[1]: name is used twice", everyPaint, [](Asset& a) { a.materials.push_back(a.materials[0]); }},
    {"materials[0]: text holds a zero byte or is too long", everyPaint,
     [](Asset& a) { a.materials[0].glsl.push_back('\0'); }},
    {"materials[0]: text holds a zero byte or is too long", everyPaint,
     [](Asset& a) { a.materials[0].glsl.assign(maxMaterialText + 1, ' '); }},
    {"maps[0]: refers to a missing tree of instances", disc, [](Asset& a) { a.maps[0].instances = 1; }},
    {"instance trees[1]: belongs to several maps", placedMaps, [](Asset& a) { a.maps[0].instances = 2; }},
    {"instance trees[0]: the next tree's index is not larger", placedMaps,
     [](Asset& a) { a.instanceTrees[0].next = 1; }},
    {"instance trees[0]: unused word is not zero", placedMaps,
     [](Asset& a) { a.instanceTrees[0].unused = 1; }},
    {"instance trees[0]: reach is out of range", placedMaps,
     [](Asset& a) { a.instanceTrees[0].reach = std::numeric_limits<float>::quiet_NaN(); }},
    {"instance trees[0]: leaves stand among instances", placedMaps,
     [](Asset& a) { a.nodes[1].children[0] = Entry::make(Entry::Kind::Leaf, 0); }},
    {"nodes[1]: is shared by trees of instances", placedMaps,
     [](Asset& a) {
         a.nodes[0].children.fill(Entry::make(Entry::Kind::Solid, 0));
         a.nodes[0].children[0] = a.nodes[0].children[1] = Entry::make(Entry::Kind::Node, 1);
         a.nodes[1].children.fill(Entry::make(Entry::Kind::Solid, 0));
         a.instanceTrees[0].root = Entry::make(Entry::Kind::Node, 0);
     }},
    {"instances[0]: is larger than its tree says", placedMaps,
     [](Asset& a) { a.instanceTrees[0].reach = 0.2f; }},
    {"instances[0]: its centre lies outside its cell", placedMaps,
     [](Asset& a) { a.instances[0].bits[0] += 1u << 22; }},
    {"instances[1]: refers to a missing symbol", placedMaps,
     [](Asset& a) { a.instances[1].bits[1] |= 1u << 24; }},
    {"instances[1]: is flat, or a coefficient is below -1", placedMaps,
     [](Asset& a) { a.instances[1].bits[3] = 0; }},
    {"instances[2]: stands in several places", placedMaps,
     [](Asset& a) { a.nodes[1].children[2] = InstanceRange::entry(2, 1); }},
    {"instances[3]: is missing", placedMaps,
     [](Asset& a) { a.nodes[1].children[11] = InstanceRange::entry(3, 1); }},
    {"instances[1]: is in no map", placedMaps,
     [](Asset& a) { a.nodes[1].children[11] = Entry::make(Entry::Kind::Solid, 0); }},
    {"instances[2]: the index of its map is not larger than that of the map around", placedMaps,
     [](Asset& a) { a.symbols[2].map = 1; }},
    {"instances[1]: its symbol's palette is out of bounds", placedMaps,
     [](Asset& a) { a.symbols[1].palette = 3; }},
    {"symbols[0]: refers to a missing map", placedMaps, [](Asset& a) { a.symbols[0].map = 3; }},
    {"symbols[0]: scale is out of range", placedMaps, [](Asset& a) { a.symbols[0].scale = 0; }},
    {"symbols[0]: unused word is not zero", placedMaps, [](Asset& a) { a.symbols[0].unused = 1; }},
    {"symbols[0]: there are some in compat mode", layers,
     [](Asset& a) {
         a.symbols.push_back({0, 0, 0, 1, 0});
     }},
    {"font[0]: is there without glyphs, or they without it", placedMaps, [](Asset& a) { a.glyphs.clear(); }},
    {"font[0]: is there without glyphs, or they without it", placedMaps, [](Asset& a) { a.font.reset(); }},
    {"font[0]: a height is out of range", placedMaps,
     [](Asset& a) { a.font->descent = std::numeric_limits<float>::infinity(); }},
    {"glyphs[1]: ids do not ascend", placedMaps, [](Asset& a) { a.glyphs[1].id = 3; }},
    {"glyphs[1]: refers to missing parts", placedMaps, [](Asset& a) { a.glyphs[1].parts += 1; }},
    {"glyph parts[0]: are there without glyphs", placedMaps,
     [](Asset& a) {
         a.glyphs.clear();
         a.font.reset();
     }},
    {"glyph parts[1]: refers to a missing map", placedMaps, [](Asset& a) { a.glyphParts[1].map = 3; }},
    {"glyph parts[1]: its map holds others", placedMaps, [](Asset& a) { a.glyphParts[1].map = 1; }},
    {"glyph parts[0]: unused word is not zero", placedMaps, [](Asset& a) { a.glyphParts[0].unused = 1; }},
    {"glyph parts[0]: place is out of range", placedMaps,
     [](Asset& a) { a.glyphParts[0].y = std::nanf(""); }},
    {"glyphs[0]: advance is out of range", placedMaps, [](Asset& a) { a.glyphs[0].advance = std::nanf(""); }},
    {"maps[0]: refers to a missing paint", placedMaps, [](Asset& a) { a.symbols[0].ground = 9; }},
    {"maps[0]: refers to a missing paint", placedMaps, [](Asset& a) { a.palettes[0] = 9; }},
    {"commands[0]: draws a map that is placed in another", placedMaps,
     [](Asset& a) { a.commands[0].map = 1; }},
    {"prefilter[0]: a side is not 2^k or 3 * 2^k texels of at most 4096", everySection,
     [](Asset& a) {
         a.prefilter.size = {0, 4};
     }},
    {"prefilter[0]: a side is not 2^k or 3 * 2^k texels of at most 4096", everySection,
     [](Asset& a) {
         a.prefilter.size = {5, 4};
     }},
    {"prefilter[0]: a side is not 2^k or 3 * 2^k texels of at most 4096", everySection,
     [](Asset& a) {
         a.prefilter.size = {4, 2 * maxPyramidSide};
     }},
    {"prefilter[15]: number of texels does not match the size", everySection,
     [](Asset& a) {
         a.prefilter.size = {4, 4};
     }},
    {"prefilter[0]: there are texels without a size", everySection, [](Asset& a) { a.prefilter.size = {}; }},
    {"commands[2]: refers to a missing filter", filtered, [](Asset& a) { a.commands[2].map = 1; }},
    {"commands[7]: filters pictures that were not pushed for it", filtered,
     [](Asset& a) { a.commands[7] = a.commands[6]; }},
    {"commands[4]: filters pictures that were not pushed for it", filtered,
     [](Asset& a) { a.commands.erase(a.commands.begin() + 4, a.commands.begin() + 6); }},
    {"commands[4]: pops the last picture, or an input of a filter", filtered,
     [](Asset& a) { a.commands[4].kind = Command::Kind::Pop; }},
    {"commands[1]: its map refers to missing paints", filtered,
     [](Asset& a) {
         a.commands[1] = {Command::Kind::DrawMap, {}, 1, 0, 4};
     }},
    {"filters[0]: matrix is out of range", filtered, [](Asset& a) { a.filters[0].matrix[2] = HUGE_VAL; }},
    {"filters[0]: region is out of range", filtered, [](Asset& a) { a.filters[0].region[2] = 3; }},
    {"filters[0]: number of pictures is out of range", filtered, [](Asset& a) { a.filters[0].pictures = 0; }},
    {"filters[0]: unused word is not zero", filtered, [](Asset& a) { a.filters[0].unused = 1; }},
    {"filters[0]: primitives do not follow those of the filter before", filtered,
     [](Asset& a) { a.filters[0].firstPrimitive = 1; }},
    {"filters[0]: primitives do not follow those of the filter before", filtered,
     [](Asset& a) { a.filters[0].primitives = 4; }},
    {"filter primitives[2]: is in no filter", filtered, [](Asset& a) { a.filters[0].primitives = 2; }},
    {"filter words[11]: is in no primitive", filtered, [](Asset& a) { a.filterWords.push_back(0); }},
    {"filter primitives[0]: operation is unknown", filtered,
     [](Asset& a) { a.filterPrimitives[0].op = FilterOp(16); }},
    {"filter primitives[0]: colour space is unknown", filtered,
     [](Asset& a) { a.filterPrimitives[0].linear = 2; }},
    {"filter primitives[0]: region is out of range", filtered,
     [](Asset& a) { a.filterPrimitives[0].region[0] = 99; }},
    {"filter primitives[1]: words do not follow those of the primitive before", filtered,
     [](Asset& a) { a.filterPrimitives[1].firstWord = 2; }},
    {"filter primitives[0]: has the wrong number of inputs", filtered,
     [](Asset& a) { a.filterPrimitives[0].op = FilterOp::Flood; }},
    {"filter primitives[0]: reads the result of a later primitive", filtered,
     [](Asset& a) { a.filterWords[0] = 2; }},
    {"filter primitives[0]: has too many parameters", filtered,
     [](Asset& a) { a.filterPrimitives[0].op = FilterOp::Tile; }},
    {"filter primitives[0]: has too few parameters", filtered,
     [](Asset& a) { a.filterPrimitives[0].op = FilterOp::Morphology; }},
    {"filter primitives[0]: parameter is too small", filtered,
     [](Asset& a) { a.filterWords[1] = std::bit_cast<std::uint32_t>(-1.0f); }},
    {"filter primitives[1]: refers to a missing picture", filtered,
     [](Asset& a) { a.filterWords[3] = std::bit_cast<std::uint32_t>(2.0f); }},
    {"filter primitives[2]: parameter is not one of its numbers", filtered,
     [](Asset& a) { a.filterWords[6] = std::bit_cast<std::uint32_t>(7.0f); }},
    {"filter primitives[2]: parameter is out of range", filtered,
     [](Asset& a) { a.filterWords[7] = std::bit_cast<std::uint32_t>(HUGE_VALF); }},
    {"images[0]: bytes do not match the size", everyPaint, [](Asset& a) { a.images[0].rgba.pop_back(); }},
    {"images[0]: picture is empty", everyPaint, [](Asset& a) { a.images[0].width = 0; }},
    {"images[0]: pictures have too many pixels", everyPaint, [](Asset& a) { a.images[0].width = 1 << 30; }},
};

TEST(Validate, NamesEveryBreach) {
    for (const Breach& breach : breaches) {
        Asset asset = breach.make();
        ASSERT_NO_THROW(validate(asset));
        breach.change(asset);
        try {
            validate(asset);
            ADD_FAILURE() << "accepted: " << breach.message;
        } catch (const FormatError& error) {
            EXPECT_STREQ(error.what(), breach.message);
        }
    }
}

/// So that no file is made which the reader refuses.
TEST(Validate, WhatIsWrittenIsValidated) {
    for (const Breach& breach : breaches) {
        Asset asset = breach.make();
        breach.change(asset);
        try {
            write(asset);
            ADD_FAILURE() << "written: " << breach.message;
        } catch (const FormatError& error) {
            EXPECT_STREQ(error.what(), breach.message);
        }
    }
}

/// Gradients and image fills, in an asset of one instruction.
std::string refusal(Op op, const std::vector<Texel>& data) {
    try {
        validate(programAsset({{op, Blend::Normal, 1, 0}}, data));
    } catch (const FormatError& error) {
        return error.what();
    }
    return {};
}

std::string gradientRefusal(const std::function<void(Gradient&, std::vector<GradientStop>&)>& change) {
    Gradient gradient;
    gradient.stopCount = 3;
    std::vector<GradientStop> stops{{0, {}, 0}, {0.5f, {}, 0}, {1, {}, 0}};
    change(gradient, stops);
    std::vector<Texel> data;
    addGradient(data, gradient, stops);
    return refusal(Op::Radial, data);
}

TEST(Validate, Gradients) {
    using Stops = std::vector<GradientStop>;
    EXPECT_EQ(gradientRefusal([](Gradient&, Stops&) {}), "");
    EXPECT_EQ(gradientRefusal([](Gradient&, Stops& s) { s[1].offset = 1; }), "");
    EXPECT_EQ(gradientRefusal([](Gradient&, Stops& s) { s[1].offset = -0.1f; }),
              "data[0]: gradient's stops are not in order in [0, 1]");
    EXPECT_EQ(gradientRefusal([](Gradient&, Stops& s) { s[0].offset = 0.6f; }),
              "data[0]: gradient's stops are not in order in [0, 1]");
    EXPECT_EQ(gradientRefusal([](Gradient&, Stops& s) { s[2].offset = NAN; }),
              "data[0]: gradient's stops are not in order in [0, 1]");
    EXPECT_EQ(gradientRefusal([](Gradient& g, Stops&) { g.stopCount = 0; }),
              "data[0]: gradient has no stops");
    EXPECT_EQ(gradientRefusal([](Gradient& g, Stops&) { g.stopCount = 99; }),
              "data[0]: gradient's stops are out of bounds");
    EXPECT_EQ(gradientRefusal([](Gradient& g, Stops&) { g.spread = Spread(3); }),
              "data[0]: gradient's spread is unknown");
    EXPECT_EQ(gradientRefusal([](Gradient& g, Stops&) { g.fr = -1; }),
              "data[0]: gradient's focal circle is out of range");
    EXPECT_EQ(gradientRefusal([](Gradient& g, Stops&) { g.matrix[4] = INFINITY; }),
              "data[0]: gradient's matrix is not finite");
}

TEST(Validate, MaterialFills) {
    const auto refusalOf = [](const MaterialFill& fill, std::size_t cut = 0) -> std::string {
        std::vector<Texel> data;
        addMaterial(data, fill);
        data.resize(data.size() - cut);
        Asset asset = programAsset({}, {});
        asset.materials = {{"a", ""}};
        const auto program = std::bit_cast<Texel>(Instruction{Op::Material, {}, 1, 1});
        asset.data = {program};
        asset.data.insert(asset.data.end(), data.begin(), data.end());
        asset.paints.back() = {0, 1, 0, programTag};
        try {
            validate(asset);
        } catch (const FormatError& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(refusalOf({}), "");
    EXPECT_EQ(refusalOf({}, 1), "data[1]: material fill is out of bounds");
    EXPECT_EQ(refusalOf({{NAN}}), "data[1]: material fill's matrix is not finite");
    EXPECT_EQ(refusalOf({{}, 1}), "data[1]: material fill refers to a missing material");
    EXPECT_EQ(refusalOf({{}, 0, 1}), "data[1]: material fill's unused word is not zero");
    EXPECT_EQ(refusalOf({{}, 0, 0, {2}}), "data[1]: material fill's fallback colour is out of range");
}

TEST(Validate, ImageFills) {
    const auto fill = [](const ImageFill& f) {
        std::vector<Texel> data;
        addImage(data, f);
        return refusal(Op::Image, data);
    };
    EXPECT_EQ(fill({}), "");
    EXPECT_EQ(fill({{1, 0, 0, 1, 0, 0}, 1}), "data[0]: image fill refers to a missing image");
    for (const ImageFilter known : {ImageFilter::Nearest, ImageFilter::Bilinear, ImageFilter::Bicubic})
        EXPECT_EQ(fill({{1, 0, 0, 1, 0, 0}, 0, known}), "");
    EXPECT_EQ(fill({{1, 0, 0, 1, 0, 0}, 0, ImageFilter(4)}), "data[0]: image fill's filter is unknown");
    EXPECT_EQ(fill({{1, 0, 0, NAN, 0, 0}}), "data[0]: image fill's matrix is not finite");
}

TEST(Summary, CountsWhatIsThere) {
    const Asset asset = twoLevels();
    const Summary s = summarize(asset);
    EXPECT_EQ(s.leaves, 1u);
    EXPECT_EQ(s.pieces, 1u);
    EXPECT_EQ(s.solids, 14u + 10u);
    EXPECT_EQ(s.regions, 5u);
    EXPECT_EQ(s.maxDepth, 2u);
    EXPECT_EQ(s.bytes, 2 * 64u + 16 + 16 + 5 * 16);
}

}  // namespace
}  // namespace vtm::asset::test
