// Every script of conformance/suites/openvg drawn on the CPU and by shaders: within 1/255.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <vtm/vg.h>
#include "conformance/compare/compare.hpp"
#include "conformance/vgscript/vgscript.hpp"

namespace vtm::cases::openvg {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scripts() {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(VTM_SOURCE_DIR "/conformance/suites/openvg"))
        if (entry.path().extension() == ".vg")
            found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
}

std::string textOf(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool hasGl() {
    const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE};
    VtmSurface* const surface = vtmCreateSurface(1, 1, &format);
    const bool has = vtmChooseCompositor(surface, VTM_COMPOSITOR_GL) == VTM_COMPOSITOR_GL;
    vtmDestroySurface(surface);
    return has;
}

TEST(OpenVgCompositors, DrawTheSameScripts) {
    if (!hasGl())
        GTEST_SKIP() << "no OpenGL ES 3: " << vtmGetCompositorFault();
    for (const fs::path& script : scripts()) {
        const std::string text = textOf(script), name = script.filename().string();
        const vgscript::Outcome cpu = vgscript::play(text, name, VTM_COMPOSITOR_CPU),
                                gl = vgscript::play(text, name, VTM_COMPOSITOR_GL);
        EXPECT_EQ(cpu.failures, gl.failures) << script;
        ASSERT_EQ(cpu.picture.rgba.size(), gl.picture.rgba.size()) << script;
        EXPECT_LE(compare::compare(cpu.picture, gl.picture).max, 1.001) << script;
        ASSERT_TRUE(hasGl()) << script << ": " << vtmGetCompositorFault();
    }
}

}  // namespace
}  // namespace vtm::cases::openvg
