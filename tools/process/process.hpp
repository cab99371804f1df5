/// \file
/// What a process is given when it starts, and how it ends.
#pragma once

namespace vtm::tools {

/// Call first. Descriptors 0 to 2 that are closed are opened such that reading and writing fails, so that no
/// file that is opened later is taken for them. What is too large for the process, and a pipe that nobody
/// reads, are errors instead of signals. A signal that ends the process removes files that are not whole yet.
void prepareProcess();

}  // namespace vtm::tools
