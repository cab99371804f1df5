/// \file
/// Every constant and function of the VG headers by its name: tables made from those headers when this is
/// built.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "conformance/vgscript/src/frame.hpp"

namespace vtm::vgscript {

std::optional<double> constantOf(std::string_view name);

struct Function {
    std::size_t parameters;
    std::function<Value(Frame&, std::span<const Word>)>
        call;  ///< takes as many words as there are parameters
};

/// Null: no such function.
const Function* functionOf(std::string_view name);

}  // namespace vtm::vgscript
