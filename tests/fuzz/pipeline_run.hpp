/// \file
/// The whole way from a picture's source to its pixels, every stage held against another.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>

namespace vtm::fuzz {

/// Two stages that should agree do not; says which and by how much.
class Disagreement : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What became of an input.
enum class Outcome { Refused, Drawn, Compared };

/// Bytes that begin with '<' are SVG, others a scene (tests/fuzz/scene_of_bytes.hpp). The scene is compiled,
/// written, read and written again, to the same bytes; then the scanner and the evaluator draw it in two
/// views, and, where the reference is quick, the reference too (Compared). Refused: with the documented
/// exceptions of the importer and of compile(). Throws Disagreement; any other exception is a mistake too.
Outcome runPipeline(std::span<const std::uint8_t> bytes);

}  // namespace vtm::fuzz
