/// \file
/// A progress bar on stderr, where that is a terminal.
#pragma once

#include <cstddef>

namespace vtm::tools {

void showProgress(std::size_t finished, std::size_t total);
void clearProgress();

}  // namespace vtm::tools
