/// \file
/// VTMs as text: the format .vtmtree (docs/vtmtree.md).
///
///     vtmtree 1
///     size 64 64
///     shape triangle = "M32 8 58 56H6Z"
///     vtm meadow = linear(0 0, 0 64) { 0 #8bc34a, 1 #33691e }
///     draw select triangle red else meadow
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <vtm/authoring.hpp>
#include <vtm/error.hpp>
#include <vtm/limits/limits.hpp>

#pragma GCC visibility push(default)

namespace vtm {

/// A VTM, and the part [0, width] × [0, height] of the plane that is its picture (user units).
struct Tree {
    double width = 0, height = 0;  ///< in [scene::minSide, scene::maxSide]
    Vtm vtm;

    scene::Scene toScene() const { return vtm.toScene(width, height); }
};

/// A text cannot be read, or a tree cannot be written. what() is `file:line:column: cause`, or the cause.
class TreeError : public Error {
public:
    explicit TreeError(const std::string& cause) : Error(cause) {}
    TreeError(const std::string& file, const limits::Place& where, const std::string& cause);
    const limits::Place& where() const { return where_; }  ///< line 0: unknown

private:
    limits::Place where_;
};

struct TreeOptions {
    std::string fileName;           ///< for messages
    std::string resourceDirectory;  ///< relative names of images start here; empty: none are read
};

/// Limits for hostile texts; beyond them is a TreeError.
struct TreeLimits {
    static constexpr std::size_t maxBytes = 256u << 20;
    static constexpr int maxDepth = 256;  ///< of braces and operands in each other, in one statement
    /// Paints, selections, layers, placements and clip shapes of the picture, where every use of a name
    /// counts all that the name stands for.
    static constexpr std::size_t maxNodes = 1'000'000;
};

/// Returns whether the text begins as a .vtmtree file does: with the word vtmtree, after spaces and comments.
bool isTree(std::span<const std::uint8_t> bytes);

/// Reads a .vtmtree file. The scene of the result is valid (scene::validate). Throws TreeError, and
/// limits::Exceeded under a budget.
Tree readTree(std::span<const std::uint8_t> bytes, const TreeOptions& options = {});

/// Returns the text of a tree. Parts that it contains several times are written once, with a name. Reading
/// the text returns a tree that draws the same picture. It has the same scene, but for groups without effect
/// in masks and patterns, paths that are closed twice in a row, and rotations of arcs that are no rounded
/// number of degrees, which change by a rounding. Such a tree is written as the same text again. Bitmaps are
/// PNG data in the text. Throws TreeError for numbers that are not finite or beyond 1e30, and
/// scene::InvalidScene where masks and patterns nest too deeply. The scene of the tree must be valid.
std::string writeTree(const Tree& tree);

}  // namespace vtm

#pragma GCC visibility pop
