/// \file
/// Streams of deflate joined to one, so that parts of a whole can be deflated at the same time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vtm::image {

/// Where the last block of a stream begins and where it ends, in bits.
struct LastBlock {
    std::size_t begin = 0, end = 0;
};

/// Walks a stream (RFC 1951) that a deflater made, without making what it stands for. Takes about as long as
/// reading its symbols. Throws CodecError if it is none.
LastBlock findLastBlock(std::span<const std::uint8_t> stream);

/// Makes a whole stream one that another can follow at the next byte: its last block is no longer marked as
/// the last, and an empty stored block fills the byte.
void openEnd(std::vector<std::uint8_t>& stream);

}  // namespace vtm::image
