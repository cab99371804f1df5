/// \file
/// The two ways to render a row of a picture.
#pragma once

#include "conformance/reference/coverage/sweep.hpp"
#include "conformance/reference/paint/sampler.hpp"

namespace vtm::reference {

/// Rows as means of the composited colour.
class ExactRows {
public:
    ExactRows(const FlatScene& picture, int samples);
    /// `parts`: of the row at y. `row`: as many colours as the picture is wide; zeros.
    void render(std::span<const EdgePart> parts, int y, Colour* row);

private:
    Sampler sampler_;
    RowSweep sweep_;
    int samples_;
};

/// Rows laid over each other layer by layer.
class CompatRows {
public:
    explicit CompatRows(const FlatScene& picture);
    /// `parts`: of the row at y, in the order of the shapes.
    void render(std::span<const EdgePart> parts, int y, Colour* row);

private:
    const FlatScene& picture_;
    Sampler sampler_;
    RowSweep sweep_;
};

}  // namespace vtm::reference
