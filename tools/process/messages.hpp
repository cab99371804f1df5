/// \file
/// What the command says on standard error: errors, warnings, progress.
#pragma once

#include <cstddef>
#include <string>

#include <vtm/limits/limits.hpp>

namespace vtm::tools {

/// A line, over a progress bar if there is one. If it cannot be written, nobody can be told.
void say(const std::string& message);

/// The same for what is no error: nothing after beQuiet().
void warn(const std::string& message);
void beQuiet();

/// `path: what`, for the exception being handled; `what` alone where it names the path itself. A
/// StandardOutputError is thrown on.
std::string describeError(const std::string& path);

/// A whole number with a comma every three digits; from 1e15 on in powers of ten: 1.2e+18.
std::string readable(double number);

/// Progress is shown where standard error is a terminal, before beQuiet().
void showProgress(std::size_t finished, std::size_t total);
/// Of a picture that takes long: what is being done, and for how many seconds. May be called from any thread.
void showWork(const limits::Progress& progress);
void clearProgress();

}  // namespace vtm::tools
