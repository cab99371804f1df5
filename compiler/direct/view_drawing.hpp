/// \file
/// What a ViewDrawing holds.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <vtm/compiler/draw_view.hpp>
#include "compiler/direct/filtered_drawing.hpp"
#include "compiler/direct/plain_drawing.hpp"

namespace vtm::compiler {

struct ViewDrawing::Impl {
    int width, height;
    /// One of both.
    std::unique_ptr<const PlainDrawing> plain;
    std::unique_ptr<const FilteredDrawing> filtered;
    std::vector<std::string> warnings;

    /// Null where compiling is the way to draw.
    static std::unique_ptr<Impl> make(const scene::Scene& scene, const Excerpt& excerpt,
                                      const asset::View& view, const Options& options);
};

/// What is drawn already.
struct DrawnPixels {
    /// Null where nothing is.
    static const asset::CommandPicture* of(const ViewDrawing& drawing) {
        return drawing.impl_->filtered ? &drawing.impl_->filtered->picture : nullptr;
    }
};

}  // namespace vtm::compiler
