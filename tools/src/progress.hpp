/// \file
/// Progress on stderr, where that is a terminal and --quiet was not given.
#pragma once

#include <cstddef>

#include <vtm/limits/limits.hpp>

namespace vtm::tools {

void showProgress(std::size_t finished, std::size_t total);
/// Of a picture that takes long: what is being done, and for how many seconds. May be called from any thread.
void showWork(const limits::Progress& progress);
void clearProgress();

}  // namespace vtm::tools
