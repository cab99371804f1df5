/// \file
/// What the command reads: files, or standard input.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/process/stages.hpp"

namespace vtm::tools {

/// In place of a file's name: standard input, standard output.
inline constexpr const char* standardStream = "-";

/// How messages call an input.
std::string nameOf(const std::string& input);

/// Of the name, in lower case, with its dot; "" where it has none.
std::string suffixOf(const std::string& path);

struct Input {
    std::string name;    ///< for messages
    std::string folder;  ///< relative references start here; absolute
    std::vector<std::uint8_t> bytes;
    Stages stages;  ///< reading it

    /// By its first bytes. What is neither a .vtm nor a .vtmtree file nor can be an SVG is whatever its name
    /// says, so that the message fits.
    bool isAsset() const;
    bool isTree() const;
};

/// A file, a pipe, or standard input for "-". Throws image::CodecError.
Input readInput(const std::string& path);

}  // namespace vtm::tools
