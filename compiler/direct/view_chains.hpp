/// \file
/// A lowered scene under a view: its outlines in pixels, cut into chains that go down the rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/raster/view.hpp>
#include "compiler/lower/lattice.hpp"
#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// A part of a layer's outline on which y nowhere falls: vertices [first, end), at least two, of which the
/// last is below the first. Who crosses it from left to right adds `winding`.
struct DownChain {
    std::uint32_t first, end;
    std::uint32_t layer;
    std::int32_t winding;
    float top, bottom;
};

/// Outlines are closed, so at the ends of a chain others end that cancel it. What lies beside the view is
/// moved to `beside` pixels from it; what lies above or below all of it is left out.
class ViewChains {
public:
    static constexpr float beside = 1;

    ViewChains() = default;
    /// The picture is lowered on `lattice`; the view maps the picture's units to pixels.
    ViewChains(const LoweredScene& picture, const Lattice& lattice, const asset::View& view);

    int height() const { return height_; }  ///< of the view
    int bands() const { return int(firsts_.size()) - 1; }
    /// How many there are, summed over the bands.
    std::size_t inBands() const { return numbers_.size(); }
    /// Numbers of chains that meet a band of rows: those that come from above it, then those that begin in
    /// it, from the top.
    std::span<const std::uint32_t> inBand(int band) const {
        const auto at = std::size_t(band);
        return std::span(numbers_).subspan(firsts_[at], firsts_[at + 1] - firsts_[at]);
    }
    const DownChain& operator[](std::uint32_t number) const { return chains_[number]; }
    /// Layers ascend.
    std::span<const DownChain> all() const { return chains_; }
    const glm::vec2* vertices() const { return vertices_.data(); }

    /// Whether a chain may be left out of a band that it meets.
    bool areLeftOut() const { return areLeftOut_; }
    /// Leaves chains out of bands where isLeftOut(chain, band) says so: all of a layer's.
    template <class IsLeftOut>
    void leaveOut(const IsLeftOut& isLeftOut) {
        std::size_t kept = 0, first = 0;
        for (int band = 0; band < bands(); ++band) {
            const std::size_t end = firsts_[std::size_t(band) + 1];
            for (std::size_t i = first; i < end; ++i)
                if (!isLeftOut(chains_[numbers_[i]], band))
                    numbers_[kept++] = numbers_[i];
            first = end;
            firsts_[std::size_t(band) + 1] = std::uint32_t(kept);
        }
        numbers_.resize(kept);
        areLeftOut_ = true;
    }

private:
    class Builder;

    static void addLayer(const LoweredScene& picture, std::uint32_t index, const scene::Affine& toPixels,
                         Builder& builder);
    void append(const std::vector<ViewChains>& parts);
    void findBands(int height);
    template <class BandOf>
    std::vector<std::uint64_t> sortedByTop(std::size_t bandCount, const BandOf& bandOf) const;

    int height_ = 0;
    std::vector<glm::vec2> vertices_;
    std::vector<DownChain> chains_;
    std::vector<std::uint32_t> firsts_, numbers_;
    bool areLeftOut_ = false;
};

}  // namespace vtm::compiler
