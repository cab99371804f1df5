#include "backend_gl/src/programs.hpp"

#include <algorithm>

#include <glm/common.hpp>

#include "asset/testing.hpp"
#include "backend_gl/src/shelves.hpp"
#include "backend_gl/tests/gl_fixture.hpp"

namespace vtm::gl {
namespace {

using namespace asset::test;

TEST_F(Gl, EveryPermutationCompiles) {
    Programs programs;
    for (unsigned flags = 0; flags < Features::combinations; ++flags) {
        SCOPED_TRACE(Features(flags).defines());
        EXPECT_NO_THROW(programs.leaf(CostClass::General, Features(flags)));
        EXPECT_NO_THROW(programs.fill(Features(flags)));
    }
    EXPECT_NO_THROW(programs.leaf(CostClass::Solid, {}));
    EXPECT_NO_THROW(programs.leaf(CostClass::Pieces, {}));
    EXPECT_NO_THROW(programs.layer());
    EXPECT_NO_THROW(programs.blend());
}

TEST_F(Gl, CompileErrorsCarryTheDriversLog) {
    try {
        Program("broken", {"void main() { gl_Position = vec4(0.0); }"},
                {"out vec4 c;\nvoid main() { c = nonsense; }"});
        ADD_FAILURE();
    } catch (const GlError& error) {
        EXPECT_NE(std::string(error.what()).find("fragment shader of program broken"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos);
    }
}

TEST_F(Gl, TexturesBeyondTheDriversLimitAreAnError) {
    EXPECT_THROW(makeTexture(GL_RGBA8, limit(GL_MAX_TEXTURE_SIZE) + 1, 1), GlError);
}

TEST_F(Gl, PendingErrorsAreNamed) {
    glEnable(0x1234);
    try {
        checkErrors("here");
        ADD_FAILURE();
    } catch (const GlError& error) {
        EXPECT_STREQ(error.what(), "here: GL says invalid enum (0x0500)");
    }
}

TEST(Features, AreThoseOfThePrograms) {
    EXPECT_EQ(featuresOf(disc()).flags(), 0u);
    EXPECT_EQ(featuresOf(layers()).flags(), Features::Linear);
    EXPECT_EQ(featuresOf(blendAsset(asset::Blend::Normal)).flags(),
              Features::Linear | Features::Radial | Features::Groups);
    EXPECT_EQ(featuresOf(blendAsset(asset::Blend::Hue)).flags(),
              Features::Linear | Features::Radial | Features::Groups | Features::Mixing);
    EXPECT_EQ(featuresOf(everyPaint()).flags(), Features::combinations - 1);
}

TEST(Shelves, PlaceWithoutOverlapUntilFull) {
    constexpr int side = 100;
    Shelves shelves({side, side});
    std::vector<int> owner(side * side, -1);
    int placed = 0;
    for (;; ++placed) {
        const glm::ivec2 size(1 + placed * 7 % 23, 1 + placed * 5 % 19);
        const std::optional<glm::ivec2> corner = shelves.place(size);
        if (!corner)
            break;
        for (int y = corner->y; y < corner->y + size.y; ++y)
            for (int x = corner->x; x < corner->x + size.x; ++x)
                EXPECT_EQ(std::exchange(owner.at(std::size_t(y * side + x)), placed), -1);
        EXPECT_LE(corner->y + size.y, shelves.height());
    }
    EXPECT_GT(placed, 40);
    shelves.clear();
    EXPECT_EQ(shelves.place({side, side}), glm::ivec2(0));
    EXPECT_EQ(shelves.place({1, 1}), std::nullopt);
}

}  // namespace
}  // namespace vtm::gl
