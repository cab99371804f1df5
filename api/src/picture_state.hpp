/// \file
/// What a Picture holds, and how it compiles for a view.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <future>
#include <memory>
#include <mutex>
#include <optional>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/draw_view.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/vtm.hpp>
#include "image/pixel_writer.hpp"

namespace vtm {

/// The scanner for exact pictures, the evaluator for others.
class CpuEngine {
public:
    /// `asset` must outlive it.
    explicit CpuEngine(const asset::Asset& asset);
    /// Row by row.
    void draw(const asset::View& view, const image::PixelWriter& writer, const image::RowSink& sink) const;

private:
    std::optional<asset::Scanner> scanner_;
    std::optional<asset::Evaluator> evaluator_;
};

/// Shaders, in a context of the library's own; the caller's stays current. Nothing where the CPU is faster,
/// or where there is no GL and it is not `required`. Throws gl::GlError.
std::optional<image::Raster> drawWithGl(const asset::Asset& asset, const asset::View& view, bool required);
/// Whether shaders would draw exact pictures, unless they are required to.
bool glDrawsExact();

/// A raster, and the map from user units to its pixels.
struct Shot {
    asset::View view;
    std::optional<scene::Frame> frame;  ///< not where the caller gave a matrix
};

/// A compiled picture. Its engine points into it.
struct Compiled {
    explicit Compiled(asset::Asset made) : asset(std::move(made)), cpu(asset) {}
    Compiled(const Compiled&) = delete;
    Compiled& operator=(const Compiled&) = delete;

    const asset::Asset asset;
    const CpuEngine cpu;
};

/// What draws a shot.
struct Seen {
    std::shared_ptr<const Compiled> compiled;
    asset::View view;
};

using Drawing = std::unique_ptr<const compiler::ViewDrawing>;

struct Picture::State {
    double width = 0, height = 0;
    std::optional<scene::Scene> scene;  ///< not where the picture was loaded compiled

    std::shared_ptr<const Compiled> whole() { return atLevel(0); }
    /// Of a shot that is drawn without an asset: the first of its level, each while the asset is compiled in
    /// the background, and each that is finer than all levels. Null: it is drawn from an asset.
    Drawing drawingFor(const Shot& shot);
    void compileInBackground();
    /// Fine enough, if the scene is there.
    Seen compileFor(const Shot& shot);
    void drawOnCpu(const Seen& seen, const image::PixelWriter& writer, const image::RowSink& sink);
    void warn(std::string message);
    std::vector<std::string> warnings();

private:
    friend class Picture;
    /// Assets of the whole picture, each four times finer than the one before: up to 1024 pixels along the
    /// longer side, 4096 and 16 384 all edges are where they are compiled to be for a view of their own.
    static constexpr std::size_t levels = 3;
    static constexpr std::size_t finerThanAll = levels;
    std::size_t levelFor(const Shot& shot) const;
    std::shared_ptr<const Compiled> atLevel(std::size_t level);
    std::shared_ptr<const Compiled> take(compiler::Result result);
    std::mutex compiling_, warning_;
    std::array<std::shared_ptr<const Compiled>, levels> compiled_;
    std::array<std::atomic<bool>, levels> isCompiled_{}, isDrawn_{};
    std::atomic<bool> isCompiling_ = false;  ///< level 0, in the background
    std::vector<std::string> warnings_;
    /// The last member, since it uses the others.
    struct {
        std::mutex mutex;
        std::future<void> compiling;
    } background_;
};

/// Throws std::invalid_argument, std::length_error.
Shot shotOf(const RenderOptions& options, double pictureWidth, double pictureHeight);

}  // namespace vtm
