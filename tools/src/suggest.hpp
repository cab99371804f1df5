/// \file
/// What somebody may have meant who mistyped a word.
#pragma once

#include <string>
#include <vector>

namespace vtm::tools {

/// The nearest of `known`, if it is near: at most a third of the word's letters are wrong, missing, too many
/// or swapped with their neighbour. Else "".
std::string nearestOf(const std::string& word, const std::vector<std::string>& known);

}  // namespace vtm::tools
