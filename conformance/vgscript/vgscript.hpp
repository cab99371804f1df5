/// \file
/// OpenVG calls written as text, for cases that anybody can add: conformance/suites/openvg/README.md has the
/// language.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <vtm/vg.h>
#include <vtm/image/bitmap.hpp>

namespace vtm::vgscript {

/// `name:line: what is wrong`: the script itself is at fault, not OpenVG.
class ScriptError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Outcome {
    /// The surface at the end, premultiplied, in the surface's own numbers: nothing is converted between
    /// linear light and sRGB.
    image::Raster picture;
    /// `name:line: what was expected, and what came`, in the script's order.
    std::vector<std::string> failures;
    /// How far the picture may be from the expected one, in 1/255 of a channel (`bound`).
    double bound = 0;
};

/// Runs a script on a surface and a context of its own, in this thread, whose current context it leaves as it
/// was. `name` is for messages. Throws ScriptError.
Outcome play(std::string_view text, const std::string& name,
             VtmCompositor compositor = VTM_COMPOSITOR_AUTOMATIC);

}  // namespace vtm::vgscript
