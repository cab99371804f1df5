#include "compiler/lower/lattice.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "compiler/lower/outline.hpp"

namespace vtm::compiler {
namespace {

TEST(Lattice, roundToEvenNeverPassesAnOddInteger) {
    for (int denominator = 1; denominator <= 7; ++denominator)
        for (int numerator = -60; numerator <= 60; ++numerator) {
            const double exact = static_cast<double>(numerator) / denominator;
            const Coord even = roundToEven(numerator, denominator);
            EXPECT_EQ(even % 2, 0);
            EXPECT_LE(std::abs(even - exact), 1) << numerator << "/" << denominator;
            if (exact != std::floor(exact) || numerator / denominator % 2 == 0) {
                EXPECT_LT(std::abs(even - exact), 1) << numerator << "/" << denominator;
            }
        }
}

TEST(Lattice, cornerOnAnEdgeCountsAsMovedToTheRight) {
    const LatticePoint a{0, 0}, b{10, 10}, corner{5, 5};
    EXPECT_FALSE(cornerOnLeft(a, b, corner));  // rising: +x is the right
    EXPECT_TRUE(cornerOnLeft(b, a, corner));
}

TEST(Lattice, thePictureReachesJustBeyondTheRootSquare) {
    const Lattice lattice(1024, 600, 22);
    const Square root = lattice.square();
    EXPECT_LT(scene::apply(lattice.toSteps(), {0, 0}).x, root.x0);
    EXPECT_GT(scene::apply(lattice.toSteps(), {1024, 0}).x, root.x1());
    EXPECT_NEAR(lattice.clampMax().y, scene::apply(lattice.toSteps(), {0, 600}).y, 1e-6);
    EXPECT_LT(lattice.clampMax().y, root.y1());
}

TEST(Lattice, bordersOfCellsAreOddAtEveryLevel) {
    Square s = Lattice(1, 1, 24).square();
    for (int level = 0; level <= 10; ++level, s = s.child(1, 2)) {
        EXPECT_NE(s.x0 % 2, 0);
        EXPECT_NE(s.x1() % 2, 0);
        EXPECT_NE(s.y0 % 2, 0);
    }
}

}  // namespace
}  // namespace vtm::compiler
