#include <gtest/gtest.h>

#include <set>

#include "conformance/generate/generate.hpp"

namespace vtm::generate {
namespace {

TEST(RandomScene, IsValid) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed)
        ASSERT_NO_THROW(scene::validate(randomScene(seed))) << seed;
}

TEST(RandomScene, DependsOnItsSeedOnly) {
    std::set<std::string> all;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        all.insert(scene::dump(randomScene(seed)));
        EXPECT_EQ(scene::dump(randomScene(seed)), scene::dump(randomScene(seed)));
    }
    EXPECT_EQ(all.size(), 100u);
}

TEST(HardScenes, AreValidAndDependOnTheirSeedOnly) {
    std::set<std::string> names, all;
    for (const Family& family : hardFamilies()) {
        EXPECT_TRUE(names.insert(family.name).second) << family.name;
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            ASSERT_NO_THROW(scene::validate(family.make(seed))) << family.name << " " << seed;
            EXPECT_EQ(scene::dump(family.make(seed)), scene::dump(family.make(seed)));
            all.insert(scene::dump(family.make(seed)));
        }
    }
    EXPECT_EQ(all.size(), 100 * names.size());
}

/// What a scene's text mentions, counted over a thousand scenes.
TEST(RandomScene, HasEveryKindOfPart) {
    for (const char* part :
         {"nonzero", "evenodd", "stroke", "butt", "square", "miter-clip", "bevel", "dashes", "clip",
          "multiply", "linear", "radial", "opacity", "matrix", " A ", " C ", " Q ", " Z"}) {
        int count = 0;
        for (std::uint64_t seed = 0; seed < 1000; ++seed)
            count += scene::dump(randomScene(seed)).find(part) != std::string::npos;
        EXPECT_GE(count, 20) << part;
    }
}

}  // namespace
}  // namespace vtm::generate
