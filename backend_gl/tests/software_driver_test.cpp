// Software drivers are told by name or, where the name is masked, by the CPU time of drawing.
#include <string>

#include "backend_gl/core/software_driver.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/tests/gl_fixture.hpp"

namespace vtm::gl {
namespace {

TEST(SoftwareDriver, TakesMoreThanAShareOfTheWork) {
    EXPECT_TRUE(isCpuWork({.drawing = 1.6, .share = 0.3}));    // llvmpipe
    EXPECT_TRUE(isCpuWork({.drawing = 200, .share = 0.3}));    // softpipe
    EXPECT_FALSE(isCpuWork({.drawing = 0.02, .share = 0.3}));  // a GPU's driver
    EXPECT_FALSE(isCpuWork({.drawing = -0.01, .share = 0.3}));
}

class MaskedDriver : public Gl {
protected:
    void SetUp() override {
        Gl::SetUp();
        if (context && !context->isSoftware())
            GTEST_SKIP() << context->renderer() << " is no software driver";
    }
    StateContract contract_;
};

TEST_F(MaskedDriver, IsToldByItsTime) {
    const StateGuard guard(contract_, true);
    for (int i = 0; i < 3; ++i) {
        const WorkTimes times = timeWork();
        EXPECT_TRUE(isCpuWork(times)) << times.drawing << ' ' << times.share;
    }
    EXPECT_TRUE(isSoftwareDriver("Masked Renderer"));
}

/// As if a GPU drew: nothing is left for the CPU to do.
TEST_F(MaskedDriver, IsNoneIfDrawingTakesNoTime) {
    const StateGuard guard(contract_, true);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 0, 0);
    for (int i = 0; i < 3; ++i) {
        const WorkTimes times = timeWork();
        EXPECT_FALSE(isCpuWork(times)) << times.drawing << ' ' << times.share;
    }
    EXPECT_FALSE(isSoftwareDriver("Another Masked Renderer"));
    glDisable(GL_SCISSOR_TEST);
}

/// A driver's name is timed once in a process.
TEST_F(MaskedDriver, IsRemembered) {
    const StateGuard guard(contract_, true);
    EXPECT_TRUE(isSoftwareDriver("Remembered Renderer"));
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 0, 0);
    EXPECT_TRUE(isSoftwareDriver("Remembered Renderer"));
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace
}  // namespace vtm::gl
