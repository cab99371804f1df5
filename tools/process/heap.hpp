/// \file
/// What the C library's heap keeps, and of which pages it is made.
#pragma once

namespace vtm::tools {

/// Call before other threads start.
void prepareHeap();

/// Between pictures: what is free goes back to the system.
void trimHeap();

}  // namespace vtm::tools
