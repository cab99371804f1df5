/// \file
/// The ways of painting regions: the whole picture, the same with paints that can be edited, or one layer's
/// (or clip's) coverage.
#pragma once

#include <memory>
#include <vector>

#include "compiler/paint/composite.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Exact mode: a region's paint is its whole stack of items, composited.
class PicturePainter : public Painter {
public:
    explicit PicturePainter(const LoweredScene& picture);
    std::unique_ptr<Painter> clone() const override;
    PaintId paint(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                  Palette& palette) override;
    void cull(std::span<const std::uint32_t> layers, const std::vector<Cover>& covers,
              std::vector<std::uint8_t>& keep) override;
    PaintId mean(std::span<const PaintId> paints, Palette& palette) override;

private:
    bool isPlain(std::uint32_t group) const;
    bool stackSolids(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                     Color& color) const;
    Cover clipCover(std::uint32_t clip, const std::vector<Cover>& covers) const;
    Cover groupCover(std::uint32_t group, const std::vector<Cover>& covers) const;
    bool hidesAllBelow(const LoweredItem& item, const std::vector<Cover>& covers) const;
    void want(std::uint32_t layer);
    void markClips(std::uint32_t group);
    void markClip(std::uint32_t clip);

    /// What a layer paints by itself.
    struct Shade {
        enum : std::uint8_t { None, Solid, Other } kind = None;  ///< Solid: in groups that change nothing
        Color color{};                                           ///< of Solid
    };

    const LoweredScene& picture_;
    std::vector<std::uint8_t> plain_;                   ///< by group: it and all round it change nothing
    std::shared_ptr<const std::vector<Shade>> shades_;  ///< by layer; clones share them
    std::vector<std::uint8_t> wanted_;                  ///< by layer
    std::vector<std::uint32_t> marked_;                 ///< the wanted ones, perhaps more than once
    std::vector<std::uint32_t> items_;
};

/// Compat mode: paint 1 inside one layer, or inside a clip; 0 outside.
class MaskPainter : public Painter {
public:
    MaskPainter(const LoweredScene& picture, std::uint32_t layer, std::uint32_t clip)
        : picture_(picture), layer_(layer), clip_(clip) {}
    std::unique_ptr<Painter> clone() const override { return std::make_unique<MaskPainter>(*this); }
    PaintId paint(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                  Palette& palette) override;
    void cull(std::span<const std::uint32_t>, const std::vector<Cover>&,
              std::vector<std::uint8_t>&) override {}
    PaintId mean(std::span<const PaintId> paints, Palette& palette) override;

private:
    const LoweredScene& picture_;
    const std::uint32_t layer_, clip_;  ///< `noIndex` for the one that is not meant
};

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
