/// \file
/// The colour of a picture about a point, given which shapes the point is inside of.
#pragma once

#include <memory>
#include <vector>

#include "conformance/reference/picture/flat_scene.hpp"

namespace vtm::reference {

/// How a colour depends on the point while the shapes around it stay the same.
enum class Variation {
    Constant,
    Smooth,  ///< gradients: nearly linear almost everywhere; and what is constant within a pixel
    Rough    ///< patterns, images and materials: may hold any detail
};

/// Not for use by two threads.
class Sampler {
public:
    explicit Sampler(const FlatScene& picture);

    /// Steps over an edge of a shape. All windings are zero at first.
    void cross(int shape, int winding);
    /// Gradients are their means over the spot; all else is read at its centre.
    Colour colourOver(const Spot& spot);
    /// Of what the last colour was made of.
    Variation variation() const { return variation_; }
    Colour shade(int shader, const Spot& spot);

private:
    friend struct PointCanvas;

    Colour treeColour(int tree, const Spot& spot);
    bool insideClip(int clip) const;
    double maskOver(int mask, const Spot& spot);
    Colour tileColour(int shader, const TileShader& tile, Point p);
    Colour locate(Point p);
    void indexRows();

    const FlatScene& picture_;
    std::vector<int> windings_;
    std::vector<std::vector<int>> layers_;  ///< by tree: layers around the point, ascending
    std::vector<std::vector<int>> parts_;   ///< by clip: its parts around the point
    std::vector<Colour> stack_;             ///< colours of open groups
    Variation variation_ = Variation::Constant;
    std::vector<std::unique_ptr<Sampler>> tiles_;  ///< by shader
    bool ofTile_ = false;                          ///< whose pixels are not those of the raster
    // For tiles only, whose points come in any order: edges by the rows that they meet.
    double rowsPerPixel_ = 0;
    std::vector<std::size_t> rowBegins_;
    std::vector<int> rowEdges_;
    std::vector<const Edge*> crossed_;
};

}  // namespace vtm::reference
