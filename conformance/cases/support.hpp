/// \file
/// What the cases share: where the test data lies, how a picture gets from file to pixels.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/raster/view.hpp>
#include <vtm/scene/scene.hpp>
#include "conformance/compare/compare.hpp"

namespace vtm::cases {

/// $VTM_SHARED, or shared/ beside the checkout. May be absent.
std::filesystem::path sharedDirectory();
/// Our own drawings.
std::filesystem::path examplesDirectory();

scene::Scene loadScene(const std::filesystem::path& path);

/// The whole picture on `size` pixels of width, filling whole pixels as `vtm render` does.
asset::View wholePicture(const scene::Scene& scene, int size);

/// Rounded to what a PNG file of `vtm render` holds: 8-bit, straight.
image::Raster asWritten(const image::Raster& raster);

/// A context with the programs in it. Shaders draw, on every driver.
struct Gl {
    gl::Context context;
    gl::Renderer renderer{{.pixels = gl::Pixels::Shaders, .programCache = {}, .resetStatus = {}}};

    image::Raster render(const asset::Asset& asset, const asset::View& view) {
        return renderer.render(renderer.upload(asset), view);
    }
};

/// One row of limits.tsv.
struct CorpusFile {
    std::string name;
    struct Limit {
        int size;  ///< pixels
        double best, floor;
        double mean() const;  ///< the largest mean error that we accept
    };
    std::vector<Limit> limits;    ///< none where nothing was measured
    std::string expectedFailure;  ///< empty, or why
};
std::vector<CorpusFile> corpusFiles();

/// A scene of one filled path on nothing, `side` units wide and high.
scene::Scene sceneOf(const scene::Path& path, scene::FillRule rule, double side);

/// A file of the corpus, compiled for a texture.
class Measurement {
public:
    /// Throws the modules' exceptions.
    explicit Measurement(const std::string& name);

    const scene::Scene& scene() const { return scene_; }
    const asset::Asset& asset() const { return asset_; }

private:
    scene::Scene scene_;
    asset::Asset asset_;
};

/// The ground truth of a file of the corpus.
image::Raster truthOf(const std::string& name, int size);

/// Bounds that hold for every file, in 1/255.
inline constexpr double truthP999 = 6, assetMax = 2, referenceMax = 4, referenceRms = 0.3;

}  // namespace vtm::cases
