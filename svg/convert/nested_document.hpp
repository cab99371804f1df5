/// \file
/// Documents that another one shows: as an image, as a glyph, or by a `use` of one of their elements.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "svg/convert/converter.hpp"
#include "svg/xml/document.hpp"

namespace vtm::svg {

struct Converter::NestedDocument {
    Options options;
    std::unique_ptr<ParsedDocument> parsed;
    Converter converter;

    NestedDocument(std::span<const std::uint8_t> bytes, Options own, std::vector<Warning>& warnings,
                   Budget& budget)
        : options(std::move(own)),
          parsed(parseDocument(bytes, options, warnings)),
          converter(*parsed->tree, parsed->reporter, options, budget) {}
};

}  // namespace vtm::svg
