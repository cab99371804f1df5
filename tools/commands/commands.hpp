/// \file
/// The subcommands of `vtm`. Each adds itself to the application and runs when it was chosen.
#pragma once

namespace CLI {
class App;
}

namespace vtm::tools {

/// `exitCode` is set when the subcommand has run; it must outlive the parsing.
void addRender(CLI::App& app, int& exitCode);
void addCompile(CLI::App& app, int& exitCode);
void addInfo(CLI::App& app, int& exitCode);
void addDiff(CLI::App& app, int& exitCode);
void addNormalize(CLI::App& app, int& exitCode);
void addFont(CLI::App& app, int& exitCode);
void addTrace(CLI::App& app, int& exitCode);
void addView(CLI::App& app, int& exitCode);

}  // namespace vtm::tools
