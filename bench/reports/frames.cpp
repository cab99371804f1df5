// Frames as users wait for them: for drivers whose work is not on the CPU.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <GLES3/gl3.h>
#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/gl/renderer.hpp>
#include "bench/engines/textures.hpp"
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"
#include "bench/reports/texture_views.hpp"

namespace vtm::bench {
namespace {

constexpr GLenum timeElapsed = 0x88BF;  // GL_TIME_ELAPSED_EXT

/// What a driver says of the GPU's time.
class GpuClock {
public:
    GpuClock() {
        const auto* extensions = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
        if (extensions && std::string(extensions).find("GL_EXT_disjoint_timer_query") != std::string::npos)
            glGenQueries(1, &query_);
    }
    ~GpuClock() {
        if (query_ != 0)
            glDeleteQueries(1, &query_);
    }
    GpuClock(const GpuClock&) = delete;
    GpuClock& operator=(const GpuClock&) = delete;

    bool exists() const { return query_ != 0; }
    void begin() const {
        if (exists())
            glBeginQuery(timeElapsed, query_);
    }
    /// Milliseconds since begin(), of commands that are finished; 0 if there is no such clock.
    double end() const {
        if (!exists())
            return 0;
        glEndQuery(timeElapsed);
        GLuint nanoseconds = 0;
        glGetQueryObjectuiv(query_, GL_QUERY_RESULT, &nanoseconds);
        return nanoseconds * 1e-6;
    }

private:
    GLuint query_ = 0;
};

/// A framebuffer of 8 bits a channel, bound.
class BoundFramebuffer {
public:
    explicit BoundFramebuffer(int side) {
        glGenTextures(1, &texture_);
        glBindTexture(GL_TEXTURE_2D, texture_);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, side, side);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    }
    ~BoundFramebuffer() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteTextures(1, &texture_);
    }
    BoundFramebuffer(const BoundFramebuffer&) = delete;
    BoundFramebuffer& operator=(const BoundFramebuffer&) = delete;

private:
    GLuint texture_ = 0, framebuffer_ = 0;
};

/// Times of frames, milliseconds.
struct Frames {
    std::vector<double> wall, gpu;

    template <class Draw>
    void add(const GpuClock& clock, Draw&& draw) {
        const double start = wallMilliseconds();
        clock.begin();
        draw();
        glFinish();
        const double end = wallMilliseconds();
        gpu.push_back(clock.end());
        wall.push_back(end - start);
    }
};

asset::View about(const asset::Asset& picture, int side, double zoom, double angle) {
    const double scale = zoom * side / std::max(picture.width, picture.height);
    const double c = scale * std::cos(angle), s = scale * std::sin(angle), middle = 0.5 * side;
    const double x = 0.5 * picture.width, y = 0.5 * picture.height;
    return {side, side, {c, s, -s, c, middle - c * x + s * y, middle - s * x - c * y}};
}

constexpr int sides[] = {1024, 4096};
constexpr int warmUp = 3, turningFrames = 60, framesAnOctave = 24, octaves = 6;

class FileFrames {
public:
    FileFrames(std::string name, const asset::Asset& asset, bool quick, gl::Renderer& renderer,
               const GpuClock& clock, Report& report)
        : name_(std::move(name)),
          asset_(asset),
          quick_(quick),
          renderer_(renderer),
          clock_(clock),
          report_(report) {}

    void add() {
        const gl::Texture texture = renderer_.upload(asset_);
        for (const int side : sides)
            if (!quick_ || side == sides[0])
                addTurning(texture, side);
        addZoom(texture, sides[0]);
        addTextures(sides[0]);
    }

private:
    int count(int frames) const { return quick_ ? frames / 6 : frames; }

    void addTurning(const gl::Texture& texture, int side) {
        const BoundFramebuffer framebuffer(side);
        Frames frames;
        for (int i = -warmUp; i < count(turningFrames); ++i) {
            if (i == 0)
                frames = {};
            frames.add(clock_, [&] { texture.draw(about(asset_, side, 1, 0.1 + 0.02 * i)); });
        }
        addRow("picture, turning", side, frames);
    }

    /// From a quarter of the raster to sixteen times as large, the first views of their octaves among them.
    void addZoom(const gl::Texture& texture, int side) {
        const BoundFramebuffer framebuffer(side);
        Frames frames;
        for (int i = 0; i < warmUp; ++i)
            texture.draw(about(asset_, side, 0.25, 0.1));
        const int steps = count(framesAnOctave);
        for (int i = 0; i < octaves * steps; ++i)
            frames.add(clock_,
                       [&] { texture.draw(about(asset_, side, 0.25 * std::exp2(double(i) / steps), 0.1)); });
        addRow("picture, zooming", side, frames);
    }

    void addTextures(int side) {
        AssetWay vtm("vtm_sample", asset_, {asset::Wrap::Repeat, asset::Wrap::Repeat});
        BitmapWay bitmap("bitmap of 1024", asset_, 1024, BitmapWay::Beyond::Repeated);
        for (const TextureView& view : textureViews)
            for (TextureWay* way : {static_cast<TextureWay*>(&vtm), static_cast<TextureWay*>(&bitmap)}) {
                Frames frames;
                for (int i = -warmUp; i < count(turningFrames) / 2; ++i) {
                    if (i == 0)
                        frames = {};
                    frames.add(clock_, [&] { way->drawOnly(view.toTexture(side, i), side); });
                }
                addRow(fmt::format("{}, {}", way->name, view.name), side, frames);
            }
    }

    void addRow(const std::string& what, int side, const Frames& frames) {
        const auto milliseconds = [](double value) { return fmt::format("{:.3g}", value); };
        const bool known = clock_.exists();
        report_.rows.push_back({{"file", name_},
                                {"what", what},
                                {"pixels", side},
                                {"GPU ms", known ? milliseconds(median(frames.gpu)) : "-"},
                                {"wall ms", milliseconds(median(frames.wall))},
                                {"worst frame", milliseconds(quantile(frames.wall, 1))},
                                {"frames", frames.wall.size()}});
    }

    const std::string name_;
    const asset::Asset& asset_;
    const bool quick_;
    gl::Renderer& renderer_;
    const GpuClock& clock_;
    Report& report_;
};

}  // namespace

Report frames(const Options& options) {
    const gl::Context context;
    gl::Renderer renderer({.pixels = gl::Pixels::Shaders, .programCache = {}, .resetStatus = {}});
    const GpuClock clock;
    Report report;
    report.name = "frames";
    report.title = "Frames by shaders";
    report.text = fmt::format(
        "Milliseconds a frame by shaders on {}, {}: medians of the GPU's own time, where the driver tells "
        "it, and of "
        "wall time until glFinish returns; and the longest wall time. Pictures go into RGBA8. Turning: 0.02 "
        "radians a "
        "frame. Zooming: {} octaves from a quarter of the raster on, 24 frames each, every octave for the "
        "first "
        "time. Textures: repeated and moving, into RGBA32F.",
        context.renderer(), context.version(), octaves);
    for (const File& file : options.quick ? oneFileOf(options) : filesOf(options))
        if (const asset::Asset asset = compiler::compile(load(file)).asset; asset.filters.empty())
            FileFrames(file.name, asset, options.quick, renderer, clock, report).add();
    return report;
}

}  // namespace vtm::bench
