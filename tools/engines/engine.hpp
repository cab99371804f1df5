/// \file
/// The routes to pixels behind one interface.
#pragma once

#include <memory>
#include <string>

#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include "image/pixel_writer.hpp"
#include "tools/input/source.hpp"

namespace vtm::tools {

class Engine {
public:
    virtual ~Engine() = default;
    /// As --engine has it; of the last picture where that is "auto".
    virtual std::string name() const = 0;
    /// Whether it draws the compiled asset rather than the scene.
    virtual bool needsAsset() const { return true; }
    /// Whether it draws a source's drawing (Source::drawing) too, and faster than an asset that must be
    /// compiled for it.
    virtual bool drawsOnce(Source&) { return false; }
    /// Gives every row of the view to the sink. Adds its stages to the source's, without the sink's time.
    /// Throws its module's exceptions.
    virtual void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                      const image::RowSink& sink) = 0;
};

/// The whole picture; the writer has 8 bits a channel.
image::Bitmap drawBitmap(Engine& engine, Source& source, const asset::View& view,
                         const image::PixelWriter& writer);

/// One that makes floats of transparent ground.
class RasterEngine : public Engine {
public:
    void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) override;

protected:
    virtual image::Raster render(Source& source, const asset::View& view) = 0;
};

/// Says that a picture has materials and is drawn where no GLSL runs.
void warnOfMaterials(Source& source);

/// "gl", "cpu" (the scanner), "asset" (the shaders' twin), "reference", or "auto": whichever is fast here.
/// Contexts and programs are made at the first picture and kept; `programCache`: gl::RendererOptions.
std::unique_ptr<Engine> makeEngine(const std::string& name, asset::Mode mode,
                                   const std::string& programCache = {});

}  // namespace vtm::tools
