#include "backend_gl/core/finish.hpp"

#include <utility>

#include <fmt/format.h>

namespace vtm::gl {

std::string Finish::defines() const {
    std::string text;
    for (const auto& [flag, name] : {std::pair{LinearLight, "LINEAR_LIGHT"},
                                     {LinearOut, "LINEAR_OUT"},
                                     {StraightOut, "STRAIGHT_OUT"},
                                     {EncodedStore, "ENCODED_STORE"},
                                     {Dither, "DITHER"}})
        text += fmt::format("#define {} {}\n", name, has(flag) ? 1 : 0);
    return text;
}

}  // namespace vtm::gl
