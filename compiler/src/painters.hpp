/// \file
/// The two ways of painting regions: the whole picture, or one layer's (or clip's) coverage.
#pragma once

#include "compiler/src/composite.hpp"
#include "compiler/src/tree.hpp"

namespace vtm::compiler {

/// Exact mode: a region's paint is its whole stack of items, composited.
class PicturePainter : public Painter {
public:
    PicturePainter(const Picture& picture, asset::Asset& asset);
    std::uint16_t paint(std::span<const std::uint32_t> layers,
                        const std::vector<std::uint8_t>& inside) override;
    void cull(std::span<const std::uint32_t> layers, const std::vector<Cover>& covers,
              std::vector<std::uint8_t>& keep) override;
    std::uint16_t mean(std::span<const std::uint16_t> paints) override;

private:
    Cover clipCover(std::uint32_t clip, const std::vector<Cover>& covers) const;
    Cover groupCover(std::uint32_t group, const std::vector<Cover>& covers) const;
    bool hidesAllBelow(const PictureItem& item, const std::vector<Cover>& covers) const;
    void want(std::uint32_t layer);
    void markClips(std::uint32_t group);
    void markClip(std::uint32_t clip);

    const Picture& picture_;
    asset::Asset& asset_;
    Palette palette_;
    std::vector<std::uint32_t> items_;
    std::vector<std::uint8_t> wanted_;   ///< by layer
    std::vector<std::uint32_t> marked_;  ///< the wanted ones, perhaps more than once
};

/// Compat mode: paint 1 inside one layer, or inside a clip; 0 outside.
class MaskPainter : public Painter {
public:
    MaskPainter(const Picture& picture, std::uint32_t layer, std::uint32_t clip)
        : picture_(picture), layer_(layer), clip_(clip) {}
    std::uint16_t paint(std::span<const std::uint32_t> layers,
                        const std::vector<std::uint8_t>& inside) override;
    void cull(std::span<const std::uint32_t>, const std::vector<Cover>&,
              std::vector<std::uint8_t>&) override {}
    std::uint16_t mean(std::span<const std::uint16_t> paints) override;

private:
    const Picture& picture_;
    const std::uint32_t layer_, clip_;  ///< `none` for the one that is not meant
};

}  // namespace vtm::compiler
