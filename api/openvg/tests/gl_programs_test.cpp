// The compositor's programs as text: GLSL ES 3.00 by the reference compiler, and WebGL 2's where nothing is
// fetched.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <VG/vgext.h>

#include "api/openvg/gl/programs.hpp"
#include "tests/test_folder.hpp"

namespace vtm::openvg::gl {
namespace {

namespace fs = std::filesystem;

/// Each blend mode with one source, each source and flag with one blend mode.
std::vector<ProgramKey> everyKey() {
    std::vector<ProgramKey> keys;
    const auto add = [&](const ProgramKey& key) { keys.push_back(key); };
    for (const auto task : {ProgramKey::Task::store, ProgramKey::Task::copy})
        add({.task = task});
    for (const auto filter : {ProgramKey::Filter::matrix, ProgramKey::Filter::tables,
                              ProgramKey::Filter::table, ProgramKey::Filter::sums})
        for (const bool isMasked : {false, true})
            add({.task = ProgramKey::Task::filter, .filter = filter, .isMasked = isMasked});
    add({.task = ProgramKey::Task::filter, .filter = ProgramKey::Filter::sums, .writesSums = true});
    add({.task = ProgramKey::Task::filter, .filter = ProgramKey::Filter::sums, .readsSums = true});
    for (int mode = VG_BLEND_SRC; mode <= VG_BLEND_ADDITIVE; ++mode)
        add({.isStencil = mode % 2 == 0, .blendMode = mode});
    for (int mode = VG_BLEND_OVERLAY_KHR; mode <= VG_BLEND_XOR_KHR; ++mode)
        add({.isStencil = mode % 2 == 0, .blendMode = mode});
    for (const auto source : {SourceKind::solid, SourceKind::linear, SourceKind::radial, SourceKind::texels})
        for (int flags = 0; flags < 16; ++flags)
            add({.source = source,
                 .transforms = (flags & 1) != 0,
                 .multiplies = (flags & 2) != 0,
                 .isStencil = (flags & 4) != 0,
                 .isMasked = (flags & 8) != 0,
                 .blendMode = VG_BLEND_SRC_OVER});
    return keys;
}

TEST(GlPrograms, AreGlslEs300ByTheReferenceCompiler) {
    if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "glslangValidator is not installed";
    const TestFolder folder;
    std::set<std::string> written;
    const auto write = [&](const std::string& text, const char* stage) {
        if (written.insert(text).second)
            std::ofstream(folder / (std::to_string(written.size()) + stage)) << text;
    };
    for (const ProgramKey& key : everyKey()) {
        const ProgramText text = programText(key, false);
        EXPECT_EQ(text.fragment.find("#define FETCHES"), std::string::npos);
        write(text.vertex, ".vert");
        write(text.fragment, ".frag");
    }
    const std::string log = (folder / "log").string();
    const std::string command = "glslangValidator " + (folder / "*.vert").string() + " " +
                                (folder / "*.frag").string() + " > " + log + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << std::ifstream(log).rdbuf();
}

TEST(GlPrograms, FetchOnlyWhereTheyReadTheTarget) {
    for (const ProgramKey& key : everyKey())
        EXPECT_EQ(programText(key, true).fragment.find("#define FETCHES") != std::string::npos,
                  key.mayReadTarget());
}

}  // namespace
}  // namespace vtm::openvg::gl
