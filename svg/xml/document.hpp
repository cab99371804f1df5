/// \file
/// A parsed and cascaded document with what its warnings need.
#pragma once

#include <memory>
#include <span>

#include "svg/xml/element.hpp"
#include "svg/xml/report.hpp"

namespace vtm::svg {

struct ParsedDocument {
    SourceMap map;
    std::unique_ptr<Tree> tree;
    Reporter reporter;

    explicit ParsedDocument(std::vector<Warning>& warnings) : reporter(map, warnings) {}
};

/// Throws ParseError. Warnings go to `warnings`, which must outlive the document.
std::unique_ptr<ParsedDocument> parseDocument(std::span<const std::uint8_t> bytes, const Options& options,
                                              std::vector<Warning>& warnings);

}  // namespace vtm::svg
