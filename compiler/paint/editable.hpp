/// \file
/// Painting regions so that their paints may change later.
#pragma once

#include "compiler/paint/painters.hpp"

namespace vtm::compiler {

/// A region's paint is the number of its stack, in Palette::stacks: from the topmost item that hides all
/// below it upwards. So regions of different stacks stay apart even if their colours agree.
class EditablePainter : public PicturePainter {
public:
    /// `names`: of layers.
    EditablePainter(const LoweredScene& picture, const std::vector<std::uint32_t>& names);
    std::unique_ptr<Painter> clone() const override { return std::make_unique<EditablePainter>(*this); }
    PaintId paint(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                  Palette& palette) override;
    PaintId mean(std::span<const PaintId> paints, Palette& palette) override;

private:
    const LoweredScene& picture_;
    const std::vector<std::uint32_t>& names_;
    std::vector<std::uint8_t> groupHides_, clipped_;  ///< by group
    Stack stack_;
};

}  // namespace vtm::compiler
