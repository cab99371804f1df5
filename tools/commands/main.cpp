#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "tools/commands/commands.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/messages.hpp"
#include "tools/process/process.hpp"

namespace {

using namespace vtm::tools;

/// For --help.
constexpr const char* exitCodes =
    "Examples:\n"
    "  vtm render tiger.svg -o tiger.png -w 800\n"
    "  vtm compile tiger.svg -o tiger.vtm\n"
    "  vtm view tiger.svg -o tiger.html\n"
    "  vtm diff a.png b.png --max 2\n"
    "  vtm render --help\n\n"
    "Exit codes: 0 done; 1 bad input, or something could not be read, drawn or written; 2 bad usage; 141 the "
    "reader of standard output closed the pipe.\n"
    "A file is written whole or not at all. - is standard input or standard output; messages go to standard "
    "error.";

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

/// Optimal string alignment: Damerau, A technique for computer detection and correction of spelling errors
/// (1964).
std::size_t distance(const std::string& a, const std::string& b) {
    const std::size_t columns = b.size() + 1;
    std::vector<std::size_t> costs((a.size() + 1) * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return costs[i * columns + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                at(i, j) = i + j;
                continue;
            }
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    return costs.back();
}

/// The nearest of `known`, if it is near: at most a third of the word's letters are wrong, missing, too many
/// or swapped with their neighbour. Else "".
std::string nearestOf(const std::string& word, const std::vector<std::string>& known) {
    constexpr std::size_t maxLength =
        64;  // nobody mistypes that much; the cost is the product of the lengths
    std::string nearest;
    std::size_t best = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : known)
        if (const std::size_t d = word.size() > maxLength ? best : distance(word, candidate); d < best) {
            best = d;
            nearest = candidate;
        }
    return nearest;
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
                     (near.empty() ? fmt::format("; the subcommands are {}", fmt::join(names, ", ")) : near));
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
                throw UsageError(command->get_name() + ": there is no option " + word + near);
        }
}

void addQuiet(CLI::App& command) {
    command.add_flag_callback("-q,--quiet", beQuiet, "Print errors only: no warnings, no progress");
}

void addSubcommands(CLI::App& app, int& exitCode) {
    addRender(app, exitCode);
    addCompile(app, exitCode);
    addInfo(app, exitCode);
    addDiff(app, exitCode);
    addNormalize(app, exitCode);
    addFont(app, exitCode);
    addTrace(app, exitCode);
    addView(app, exitCode);
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
