#include <cstdio>
#include <sstream>

#include "tools/src/commands.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/process.hpp"
#include "tools/src/report.hpp"
#include "tools/src/standard_output.hpp"

namespace {

using namespace vtm::tools;

/// --help, --version, or what is wrong with the arguments.
int leave(const CLI::App& app, const CLI::ParseError& error) {
    std::ostringstream wanted, wrong;
    const int exitCode = app.exit(error, wanted, wrong);
    print(wanted.str());
    std::fputs(wrong.str().c_str(), stderr);
    return exitCode == 0 ? done : badUsage;
}

int run(int argc, char** argv) {
    CLI::App app{"Vector pictures as textures: compile, draw, inspect and compare.", "vtm"};
    app.set_version_flag("--version", "vtm " VTM_VERSION);
    app.footer(exitCodes);
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
        return leave(app, error);
    } catch (const UsageError& error) {
        say(std::string("vtm: ") + error.what());
        return badUsage;
    }
}

}  // namespace

int main(int argc, char** argv) {
    prepareProcess();
    try {
        return run(argc, argv);
    } catch (const StandardOutputError& error) {
        if (error.isBrokenPipe())
            return closedPipe;
        say(std::string("vtm: ") + error.what());
        return badInput;
    } catch (...) {
        say(describeError("vtm"));
        return badInput;
    }
}
