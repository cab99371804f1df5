#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/src/commands.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/process.hpp"
#include "tools/src/report.hpp"
#include "tools/src/standard_output.hpp"
#include "tools/src/suggest.hpp"

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

std::vector<std::string> namesOf(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionsOf(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::string proposal(const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = nearestOf(word, known);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

/// Throws UsageError for a first word that is no subcommand.
void requireSubcommand(const CLI::App& app, const std::string& word) {
    const std::vector<std::string> names = namesOf(app);
    if (word.empty() || word.starts_with('-') || std::ranges::find(names, word) != names.end())
        return;
    if (std::filesystem::is_regular_file(word))
        throw UsageError("'" + word + "' is a file, not a subcommand; to draw it: vtm render " + word +
                         " -o OUT.png");
    const std::string near = proposal(word, names);
    throw UsageError("'" + word + "' is not a subcommand" +
                     (near.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : near));
}

/// Throws UsageError for an option that the subcommand does not have, if it is nearly one that it has.
void proposeOption(const CLI::App& app, int argc, char** argv) {
    for (const CLI::App* command : app.get_subcommands())
        for (int i = 2; i < argc; ++i) {
            const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
            const std::vector<std::string> options = optionsOf(*command);
            if (!word.starts_with("--") || std::ranges::find(options, word) != options.end())
                continue;
            if (const std::string near = proposal(word, options); !near.empty())
                throw UsageError(command->get_name() + " has no option " + word + near);
        }
}

void addQuiet(CLI::App& command) {
    command.add_flag_callback("-q,--quiet", beQuiet, "Say nothing but errors: no warnings, no progress");
}

void addSubcommands(CLI::App& app, int& exitCode) {
    addRender(app, exitCode);
    addCompile(app, exitCode);
    addInfo(app, exitCode);
    addDiff(app, exitCode);
    addTrace(app, exitCode);
    for (CLI::App* command : app.get_subcommands({})) {
        addQuiet(*command);
        addLimitOptions(*command);
    }
}

int run(int argc, char** argv) {
    CLI::App app{"Vector pictures as textures: compile, draw, inspect and compare.", "vtm"};
    app.set_version_flag("--version", "vtm " VTM_VERSION);
    app.footer(exitCodes);
    app.require_subcommand(1);
    int exitCode = done;
    addSubcommands(app, exitCode);
    try {
        requireSubcommand(app, argc > 1 ? argv[1] : "");
        app.parse(argc, argv);
        return exitCode;
    } catch (const CLI::ExtrasError& error) {
        proposeOption(app, argc, argv);
        return leave(app, error);
    } catch (const CLI::ParseError& error) {
        return leave(app, error);
    }
}

}  // namespace

int main(int argc, char** argv) {
    prepareProcess();
    try {
        return run(argc, argv);
    } catch (const UsageError& error) {
        say(std::string("vtm: ") + error.what());
        return badUsage;
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
