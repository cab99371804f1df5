/// \file
/// The three routes to pixels behind one interface.
#pragma once

#include <memory>
#include <string>

#include <vtm/asset/view.hpp>
#include <vtm/image/bitmap.hpp>
#include "tools/src/source.hpp"

namespace vtm::tools {

class Engine {
public:
    virtual ~Engine() = default;
    /// As --engine has it; of the last picture where that is "auto".
    virtual std::string name() const = 0;
    /// Whether it draws the compiled asset rather than the scene.
    virtual bool needsAsset() const { return true; }
    /// Draws on `ground`. Adds its stages to the source's. Throws its module's exceptions.
    virtual image::Bitmap draw(Source& source, const asset::View& view, const scene::Color& ground) = 0;
};

/// One that makes floats of transparent ground.
class RasterEngine : public Engine {
public:
    image::Bitmap draw(Source& source, const asset::View& view, const scene::Color& ground) override;

protected:
    virtual image::Raster render(Source& source, const asset::View& view) = 0;
};

/// "gl", "cpu" (the scanner), "asset" (the shaders' twin), "reference", or "auto": whichever is fast here.
/// Contexts and programs are made at the first picture and kept; `programCache`: gl::RendererOptions.
std::unique_ptr<Engine> makeEngine(const std::string& name, asset::Mode mode,
                                   const std::string& programCache = {});

}  // namespace vtm::tools
