#include <cstdio>

#include <fmt/core.h>

#include "tools/src/commands.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/report.hpp"

namespace {

using namespace vtm::tools;

int run(int argc, char** argv) {
    CLI::App app{"Vector pictures as textures: compile, draw, inspect and compare.", "vtm"};
    app.set_version_flag("--version", "vtm " VTM_VERSION);
    app.require_subcommand(1);
    int exitCode = done;
    addRender(app, exitCode);
    addCompile(app, exitCode);
    addInfo(app, exitCode);
    addDiff(app, exitCode);
    addTrace(app, exitCode);
    for (CLI::App* command : app.get_subcommands({}))
        addLimitOptions(*command);
    try {
        app.parse(argc, argv);
        return exitCode;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? done : badUsage;
    } catch (const UsageError& error) {
        fmt::print(stderr, "vtm: {}\n", error.what());
        return badUsage;
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (...) {
        std::fputs((describeError("vtm") + "\n").c_str(), stderr);
        return badInput;
    }
}
