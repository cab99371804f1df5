// Recordings (vtm/vg.h): made, kept and drawn.

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/raster/scan.hpp>
#include "api/openvg/draw/row_compositor.hpp"
#include "api/openvg/record/record.hpp"
#include "api/openvg/state/matrix.hpp"

using namespace vtm;
using namespace vtm::openvg;

struct VtmRecording {
    explicit VtmRecording(const asset::Asset& asset)
        : width(asset.width),
          height(asset.height),
          bytes(asset::write(asset)),
          light(asset, asset::Sums::Light) {
        const auto isAllOrNothing = [](const asset::Paint& paint) {
            const auto alpha = std::bit_cast<float>(paint[3]);
            return !asset::isProgram(paint) && (alpha == 0 || alpha == 1);
        };
        if (!std::ranges::all_of(asset.paints, isAllOrNothing))
            coverage.emplace(asset);
    }

    double width, height;
    std::vector<std::uint8_t> bytes;
    asset::Scanner light;
    std::optional<asset::CoverageScanner> coverage;  ///< none where alpha says it: of opaque colours
};

namespace {

constexpr VGfloat maxSide = 1e6f;

/// A picture's colours on a part of a surface: of what is covered of each pixel, the mean in linear light. So
/// the compositor mixes it at its border as it does a path's paint.
class PictureSource final : public PixelSource {
public:
    PictureSource(const image::Raster& light, const Rectangle& area)
        : PixelSource(sRGBA_PRE), light_(light), area_(area), shares_(std::size_t(light.width)) {}

    /// Of the row that is asked for next; columns of the surface.
    void cover(std::span<const CoverageRun> runs) {
        for (const CoverageRun& run : runs)
            std::fill(shares_.begin() + (run.first - area_.x0), shares_.begin() + (run.end - area_.x0),
                      run.share);
    }

    void colors(int x, int y, std::span<Color> colors) const override {
        const int first = x - area_.x0;
        const float* sums = light_.pixel(first, y - area_.y0);
        const float* shares = &shares_[std::size_t(first)];
        const auto isLikeLast = [&](std::size_t i) {
            return shares[i] == shares[i - 1] && std::equal(sums + 4 * i, sums + 4 * i + 4, sums + 4 * i - 4);
        };
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = i > 0 && isLikeLast(i) ? colors[i - 1] : color(sums + 4 * i, shares[i]);
    }

private:
    static Color color(const float* sum, float share) {
        const Color mean(sum[0] / share, sum[1] / share, sum[2] / share, std::min(sum[3] / share, 1.0f));
        return premultiplied(fastEncoded(unpremultiplied(mean)));
    }

    const image::Raster& light_;
    Rectangle area_;
    std::vector<float> shares_;
};

/// Pixels of a row, each of an opaque colour of its own.
class RowSource final : public PixelSource {
public:
    /// `left`: the column of the surface in which rows begin.
    RowSource(int left, int width) : PixelSource(sRGBA_PRE), left_(left), colors_(std::size_t(width)) {}

    /// Columns from the left.
    void set(int first, int end, const Color& light) {
        for (int x = first; x < end; ++x)
            colors_[std::size_t(x)] = light;
    }

    void colors(int x, int /*y*/, std::span<Color> colors) const override {
        std::copy_n(colors_.begin() + (x - left_), colors.size(), colors.begin());
        fastEncode(colors);
    }

private:
    int left_;
    std::vector<Color> colors_;  ///< in linear light
};

/// Draws the runs of opaque regions: what is covered of a pixel is its alpha. Single pixels that are wholly
/// covered, where regions meet, are drawn together, as are runs of one colour.
class OpaqueRuns {
public:
    OpaqueRuns(Context& context, const Rectangle& seen)
        : seen_(seen),
          row_(seen.x0, seen.x1 - seen.x0),
          byColor_(context, *black_),
          byPixel_(context, row_) {}

    /// Runs of `seen` from the top, in every row from the left to the right border.
    void add(int y, const asset::ColorRun& run) {
        const float share = run.color.a > 1 - rounding ? 1 : run.color.a;
        if (share == 1 && run.end - run.first < fewPixels)
            addPixels(run.first, run.end, {glm::vec3(run.color), 1});
        else if (share > rounding)
            addColor(y, {run.first, run.end, share}, glm::vec3(run.color) / run.color.a);
        if (run.end == seen_.x1 - seen_.x0) {
            draw(byColor_, y, ofColor_);
            draw(byPixel_, y, ofPixels_);
        }
    }

private:
    /// Of running sums, and of what is divided by alpha: no 255th of a pixel, or of a colour.
    static constexpr float rounding = 1e-5f;
    /// Longer runs of one colour are filled.
    static constexpr int fewPixels = 8;

    void addPixels(int first, int end, const Color& light) {
        row_.set(first, end, light);
        if (!ofPixels_.empty() && ofPixels_.back().end == first)
            ofPixels_.back().end = end;
        else
            ofPixels_.push_back({first, end, 1});
    }
    void addColor(int y, const CoverageRun& covered, const glm::vec3& light) {
        if (!glm::all(glm::lessThan(glm::abs(light - light_), glm::vec3(rounding)))) {
            draw(byColor_, y, ofColor_);
            byColor_.use(fastEncoded({light, 1}));
            light_ = light;
        }
        ofColor_.push_back(covered);
    }
    void draw(RowCompositor& compositor, int y, std::vector<CoverageRun>& runs) const {
        for (CoverageRun& run : runs) {
            run.first += seen_.x0;
            run.end += seen_.x0;
        }
        compositor(y + seen_.y0, runs);
        runs.clear();
    }

    Rectangle seen_;
    std::unique_ptr<PixelSource> black_ = constantSource(Color(0));
    RowSource row_;
    RowCompositor byColor_, byPixel_;
    glm::vec3 light_{-1};  ///< that byColor_ uses; none at first
    std::vector<CoverageRun> ofColor_, ofPixels_;
};

void drawOpaque(Context& context, const VtmRecording& recording, const asset::View& view,
                const Rectangle& seen) {
    OpaqueRuns runs(context, seen);
    recording.light.scan(view, [&](int y, const asset::ColorRun& run) { runs.add(y, run); });
}

void drawTranslucent(Context& context, const VtmRecording& recording, const asset::View& view,
                     const Rectangle& seen) {
    const image::Raster light = recording.light.draw(view);
    PictureSource source(light, seen);
    RowCompositor compositor(context, source);
    std::vector<CoverageRun> moved;
    recording.coverage->scan(view, [&](int y, std::span<const CoverageRun> runs) {
        moved.assign(runs.begin(), runs.end());
        for (CoverageRun& run : moved) {
            run.first += seen.x0;
            run.end += seen.x0;
        }
        source.cover(moved);
        compositor(y + seen.y0, moved);
    });
}

void draw(Context& context, const VtmRecording& recording) {
    glm::mat3 toSurface = context.state.matrix(VG_MATRIX_PATH_USER_TO_SURFACE);
    if (!inverseOf(toSurface))
        return;
    const glm::dvec2 corner(recording.width, recording.height);
    const Rectangle seen = pixelsOf(toSurface, glm::dvec2(0), corner, Clip(context).bounds());
    if (seen.empty())
        return;
    // The picture's y runs down from its upper border.
    const glm::dmat3 m(toSurface);
    const glm::dvec2 origin = glm::dvec2(m[2]) + glm::dvec2(m[1]) * recording.height;
    const asset::View view{seen.x1 - seen.x0,
                           seen.y1 - seen.y0,
                           {glm::dvec2(m[0]), -glm::dvec2(m[1]), origin - glm::dvec2(seen.x0, seen.y0)}};
    if (recording.coverage)
        drawTranslucent(context, recording, view, seen);
    else
        drawOpaque(context, recording, view, seen);
}

}  // namespace

void vtmBeginRecording(VGfloat width, VGfloat height) {
    call([&](Context& context) {
        require(!context.recorder && width > 0 && height > 0 && width <= maxSide && height <= maxSide);
        context.recorder = std::make_shared<Recorder>(double(width), double(height));
        context.recordingFault.clear();
    });
}

VtmRecording* vtmEndRecording(void) {
    return callOr<VtmRecording*>(nullptr, [](Context& context) {
        require(context.recorder != nullptr);
        const std::shared_ptr<Recorder> recorder = std::exchange(context.recorder, nullptr);
        context.recordingFault = recorder->fault();
        require(context.recordingFault.empty(), VTM_NOT_RECORDABLE_ERROR);
        try {
            return std::make_unique<VtmRecording>(compiler::compile(recorder->finish()).asset).release();
        } catch (const std::exception& error) {
            context.recordingFault = error.what();
            throw;
        }
    });
}

const char* vtmGetRecordingFault(void) {
    const Context* const context = currentContext();
    return context ? context->recordingFault.c_str() : "";
}

VtmRecording* vtmLoadRecording(const void* bytes, size_t size) try {
    if (!bytes)
        return nullptr;
    const asset::Asset asset = asset::read({static_cast<const std::uint8_t*>(bytes), size});
    return std::make_unique<VtmRecording>(asset).release();
} catch (const std::exception&) {
    return nullptr;
}

void vtmDestroyRecording(VtmRecording* recording) { delete recording; }

const void* vtmGetRecordingBytes(const VtmRecording* recording, size_t* size) {
    *size = recording->bytes.size();
    return recording->bytes.data();
}

VGfloat vtmRecordingWidth(const VtmRecording* recording) { return VGfloat(recording->width); }
VGfloat vtmRecordingHeight(const VtmRecording* recording) { return VGfloat(recording->height); }

void vtmDrawRecording(const VtmRecording* recording) {
    call([&](Context& context) {
        require(recording != nullptr);
        if (context.recorder)
            context.recorder->refuse("a recording within a recording");
        draw(context, *recording);
    });
}
