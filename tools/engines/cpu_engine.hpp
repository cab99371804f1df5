/// \file
/// Drawing with the scanner: the fastest without a GPU, for exact pictures.
#pragma once

#include "tools/engines/engine.hpp"

namespace vtm::tools {

/// Holds a row of pixels, not the picture.
class CpuEngine : public Engine {
public:
    std::string name() const override { return "cpu"; }
    void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) override;
};

}  // namespace vtm::tools
