/// \file
/// Which fonts a document may use.
#pragma once

#include <string>
#include <vector>

#pragma GCC visibility push(default)

namespace vtm::text {

/// Two machines with the same directories and without system fonts draw the same text.
struct FontOptions {
    std::vector<std::string> directories;  ///< searched before the system's fonts, with their subdirectories
    bool systemFonts = true;               ///< those that fontconfig lists
    /// The families that CSS's generic names stand for; where they are not there, what fontconfig prefers.
    std::string serifFamily = "Times New Roman", sansSerifFamily = "Arial", cursiveFamily = "Comic Sans MS",
                fantasyFamily = "Impact", monospaceFamily = "Courier New";
    std::string defaultFamily = "Times New Roman";  ///< the initial value of `font-family`
};

}  // namespace vtm::text

#pragma GCC visibility pop
