#include <vtm/gl/renderer.hpp>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/software_driver.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/layers/layer_renderer.hpp"
#include "backend_gl/output/compose.hpp"
#include "backend_gl/output/destination.hpp"
#include "backend_gl/tiles/picture.hpp"

namespace vtm::gl {

namespace {

/// Larger views are drawn in parts of at most this side, 256 MiB of RGBA32F each.
constexpr int maxPartSide = 4096;

int partSide() {
    GLint viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return std::min({maxPartSide, limit(GL_MAX_TEXTURE_SIZE), viewport[0], viewport[1]});
}

/// Calls visit(part) for parts of a box of at most `side` by `side` pixels.
template <class Visit>
void forEachPart(const PixelBox& box, int side, Visit&& visit) {
    for (int y = box.min.y; y < box.max.y; y += side)
        for (int x = box.min.x; x < box.max.x; x += side) {
            const glm::ivec2 corner(x, y);
            visit(PixelBox{corner, glm::min(corner + side, box.max)});
        }
}

/// With the box's corner as its own.
asset::View viewOf(const asset::View& view, const PixelBox& box) {
    return {box.size().x,
            box.size().y,
            {view.toPixels[0], view.toPixels[1], view.toPixels[2] - glm::dvec2(box.min)}};
}

/// Into rows of `rowLength` pixels.
void readBack(const Target& target, const asset::View& part, GLenum type, int rowLength, void* pixels) {
    target.bind();
    glPixelStorei(GL_PACK_ROW_LENGTH, rowLength);
    glReadPixels(0, 0, part.width, part.height, GL_RGBA, type, pixels);
}

PixelBox wholeOf(const asset::View& view) { return {{0, 0}, {view.width, view.height}}; }

}  // namespace

struct Renderer::Impl {
    Impl(const RendererOptions& o, StateContract c)
        : options(o),
          contract(std::move(c)),
          reset(o.resetStatus ? o.resetStatus : driversResetStatus()),
          resources(o.programCache) {}

    RendererOptions options;
    StateContract contract;
    std::function<unsigned()> reset;
    const void* context = currentContext();
    bool lost = false;
    const int maxPart = partSide();

    Resources resources;
    bool hasFloats = floatFormat().has_value();
    TargetPool bytes;       ///< for reading back 8 bits
    ByteSender bytePixels;  ///< for sending them
    bool scans = drawsOnCpu(options.pixels);

    std::uint32_t maxTurns() const { return options.maxTurns == 0 ? turnsPerPixel : options.maxTurns; }

    /// Of the layers of pictures for 8-bit framebuffers. Coverage of masks needs floats, exact pictures do
    /// not.
    GLenum layerFormat(const UploadedAsset& asset) const {
        return !hasFloats && asset.filters.mode == asset::Mode::Exact ? GL_RGBA8 : 0;
    }

    void checkLost() {
        if (!lost && reset && reset() != GL_NO_ERROR)
            lost = true;
        if (lost)
            throw ContextLost("the GL context was reset");
    }

    /// What was drawn is good only if the context still is.
    void check(const char* what) {
        checkErrors(what);
        checkLost();
    }

    /// What every call does: work() in the state that drawing relies on.
    template <class Work>
    auto call(Touched touched, Work&& work) {
        if (currentContext() != context)
            throw GlError("the renderer's context is not current");
        checkLost();
        dropErrors();
        try {
            const StateGuard guard(contract, options.restoreState, touched);
            resources.pool.dropUnused();
            return work(guard);
        } catch (const OutOfMemory&) {
            resources.pool.clear();
            bytes.clear();
            bytePixels.clear();
            throw;
        } catch (const ContextLost&) {
            lost = true;
            throw;
        }
    }

    template <class Work>
    auto call(Work&& work) {
        return call(Touched(), std::forward<Work>(work));
    }

    /// Of draw(). Several maps are added up by blending, and layers are blended with each other.
    static Touched touchedBy(const UploadedAsset& asset, const Output& output) {
        const bool isPicture = asset.isSumOfMaps && asset.atlases.size() == 1;
        return isPicture ? Touched::picture(output.write == Output::Write::Over) : Touched();
    }

    /// The picture in a target of the pool, which gets it back.
    Target paint(UploadedAsset& asset, const asset::View& view, Finish finish = {}, GLenum format = 0) {
        if (!asset.isSumOfMaps)
            return LayerRenderer(resources, asset, view, format, options.markOverruns).paint();
        Target target = resources.pool.take({view.width, view.height});
        target.bind();
        target.touched = wholeOf(view);
        glViewport(0, 0, view.width, view.height);
        drawPicture(resources.programs, resources.picture, asset, view, wholeOf(view), finish,
                    options.markOverruns);
        return target;
    }

    void draw(UploadedAsset& asset, const Destination& d) {
        if (!asset.isSumOfMaps && d.finish.has(Finish::LinearLight))
            throw std::invalid_argument(
                "linear light is for exact mode without filters; compat mode does as other renderers do");
        if (asset.filtered) {
            const OneDrawBuffer one;
            for (const PixelBox& box : d.boxes)
                drawFiltered(asset, d, box);
            return check("drawing");
        }
        if (asset.scanner && d.finish.flags() == 0 && d.bits == 8) {
            const OneDrawBuffer one;
            for (const PixelBox& box : d.boxes)
                forEachPart(box, maxPart, [&](const PixelBox& part) { drawScanned(asset, d, part); });
            return check("drawing");
        }
        drawByShaders(asset, d);
    }

    /// Samples of one pixel may lie in several tiles; each pixel's colour is made in one.
    static bool drawsDirectly(const UploadedAsset& asset, const Destination& d) {
        return asset.isSumOfMaps && asset.atlases.size() == 1 && !d.multisampled;
    }

    /// Of a target between a picture and its framebuffer.
    static Finish finishOfTarget(const Destination& d) {
        return Finish(d.finish.has(Finish::LinearLight) ? Finish::LinearLight | Finish::LinearOut : 0u);
    }

    void drawByShaders(UploadedAsset& asset, const Destination& d) {
        const OneDrawBuffer one;
        if (drawsDirectly(asset, d)) {
            for (const PixelBox& box : d.boxes)
                forEachPart(box, maxPart, [&](const PixelBox& part) { drawDirectly(asset, d, part); });
        } else {
            PixelBox all;
            for (const PixelBox& box : d.boxes)
                all = all.joined(box);
            forEachPart(all, maxPart, [&](const PixelBox& part) { drawThroughTarget(asset, d, part); });
        }
        check("drawing");
    }

    /// As the draw() functions choose among ways to draw.
    bool warmUp(const UploadedAsset& asset, const Destination& d) {
        Programs& programs = resources.programs;
        if (asset.filtered || (asset.scanner && d.finish.flags() == 0 && d.bits == 8))
            return programs.warmUpCompose(d.finish);
        if (!asset.isSumOfMaps) {
            const bool layers = programs.warmUpLayers(asset.features, asset.materialSet);
            return programs.warmUpCompose(d.finish) && layers;
        }
        if (drawsDirectly(asset, d))
            return programs.warmUpPicture(asset.features, asset.materialSet, d.finish);
        const bool picture = programs.warmUpPicture(asset.features, asset.materialSet, finishOfTarget(d));
        return programs.warmUpCompose(d.finish) && picture;
    }

    void drawDirectly(UploadedAsset& asset, const Destination& d, const PixelBox& box) {
        begin(d, box);
        if (isInvertible(d.view))
            drawPicture(resources.programs, resources.picture, asset, d.view, box, d.finish,
                        options.markOverruns);
        end();
    }

    void drawScanned(UploadedAsset& asset, const Destination& d, const PixelBox& box) {
        const asset::View view = viewOf(d.view, box);
        asset.scanner->draw(view, {bytePixels.room(box.size()), std::size_t(view.width) * 4});
        bytePixels.draw(resources, d, box);
    }

    /// Filters read beyond the box, so it is not divided.
    void drawFiltered(const UploadedAsset& asset, const Destination& d, const PixelBox& box) {
        const asset::View view = viewOf(d.view, box);
        asset.filtered->evaluator.draw(view, {bytePixels.room(box.size()), std::size_t(view.width) * 4});
        bytePixels.draw(resources, d, box);
    }

    void drawGiven(const BytePixels& given, const Destination& d, const PixelBox& box) {
        const std::size_t rowBytes = std::size_t(box.size().x) * 4;
        std::uint8_t* to = bytePixels.room(box.size());
        for (int y = box.min.y; y < box.max.y; ++y, to += rowBytes)
            std::memcpy(to,
                        given.pixels + std::size_t(d.rowOf(y)) * given.rowBytes +
                            std::size_t(box.min.x - d.corner.x) * 4,
                        rowBytes);
        bytePixels.draw(resources, d, box);
    }

    /// What the boxes have of `frame`, from one target.
    void drawThroughTarget(UploadedAsset& asset, const Destination& d, const PixelBox& frame) {
        const asset::View view = viewOf(d.view, frame);
        const bool shows = isInvertible(view);
        Target target = shows ? paint(asset, view, finishOfTarget(d), layerFormat(asset)) : Target();
        for (const PixelBox& box : d.boxes) {
            const PixelBox part{glm::max(box.min, frame.min), glm::min(box.max, frame.max)};
            if (part.empty())
                continue;
            begin(d, part);
            if (shows)
                compose(resources, d, target, part, -frame.min);
        }
        end();
        if (shows)
            resources.pool.giveBack(std::move(target));
    }

    /// Calls use(target, part, corner) for each painted part.
    template <class Use>
    void paintParts(UploadedAsset& asset, const asset::View& view, Use&& use) {
        if (!isInvertible(view))
            return;
        forEachPart(wholeOf(view), maxPart, [&](const PixelBox& box) {
            const asset::View part = viewOf(view, box);
            Target target = paint(asset, part);
            use(target, part, box.min);
            resources.pool.giveBack(std::move(target));
            check("drawing");
        });
    }

    image::Bitmap bitmap(UploadedAsset& asset, const asset::View& view) {
        image::Bitmap bitmap{view.width, view.height, {}};
        bitmap.rgba.resize(std::size_t(view.width) * std::size_t(view.height) * 4);
        forEachPart(wholeOf(view), maxPart, [&](const PixelBox& box) {
            Target target = bytes.take(box.size(), GL_RGBA8);
            Output output;
            output.framebuffer = target.framebuffer.get();
            output.alpha = Output::Alpha::Straight;
            const asset::View part = viewOf(view, box);
            const Destination destination = destinationOf(part, output, 0);
            asset.filtered ? draw(asset, destination) : drawByShaders(asset, destination);
            const std::size_t first =
                (std::size_t(box.min.y) * std::size_t(view.width) + std::size_t(box.min.x)) * 4;
            readBack(target, part, GL_UNSIGNED_BYTE, view.width, &bitmap.rgba[first]);
            bytes.giveBack(std::move(target));
            bytes.dropUnused();
            check("reading back");
        });
        return bitmap;
    }
};

Renderer::Renderer(const RendererOptions& options) {
    requireContext();
    StateContract contract;
    const StateGuard guard(contract, options.restoreState);
    impl_ = std::make_unique<Impl>(options, contract);
}

Renderer::~Renderer() = default;

Texture Renderer::upload(const asset::AssetView& asset) {
    return impl_->call(Touched::uploads(), [&](const StateGuard&) {
        Programs& programs = impl_->resources.programs;
        const bool usesCpu = impl_->scans || (!impl_->hasFloats && asset.mode == asset::Mode::Compat);
        auto texture =
            std::make_unique<Texture::Impl>(asset, programs.materialSet(asset.materials), impl_->maxTurns(),
                                            usesCpu ? FilterEngine::Cpu : FilterEngine::Gpu);
        if (impl_->scans && asset::isSumOfMaps(asset) && asset.materials.empty())
            texture->scanner.emplace(asset);
        // Users' errors come at once, not with the first picture.
        if (texture->features.has(Features::Material) && !texture->filtered)
            asset.mode == asset::Mode::Exact ? programs.tile(texture->features, texture->materialSet, {})
                                             : programs.fill(texture->features, texture->materialSet);
        return Texture(std::move(texture), *this);
    });
}

std::size_t Renderer::update(Texture& texture, const asset::AssetView& asset,
                             const asset::Difference& difference) {
    if (!texture.impl_->canUpdate(asset, difference)) {
        texture.impl_ = std::move(upload(asset).impl_);
        return texture.impl_->records.bytes();
    }
    return impl_->call(Touched::uploads(),
                       [&](const StateGuard&) { return texture.impl_->update(asset, difference); });
}

bool Renderer::warmUp(const Texture& texture, const Output& output) {
    return impl_->call([&](const StateGuard& guard) {
        const Destination d = destinationOf({1, 1}, output, guard.drawFramebuffer());
        return impl_->warmUp(*texture.impl_, d);
    });
}

image::Raster Renderer::render(const Texture& texture, const asset::View& view) {
    asset::validate(view);
    if (const auto& filtered = texture.impl_->filtered)
        return filtered->evaluator.draw(view);
    image::Raster raster(view.width, view.height);
    impl_->call([&](const StateGuard&) {
        impl_->paintParts(
            *texture.impl_, view, [&](const Target& target, const asset::View& part, glm::ivec2 corner) {
                readBack(target, part, GL_FLOAT, raster.width, raster.pixel(corner.x, corner.y));
            });
    });
    // Rounding leaves sums some 1e-7 outside.
    std::ranges::transform(raster.rgba, raster.rgba.begin(),
                           [](float v) { return std::clamp(v, 0.0f, 1.0f); });
    return raster;
}

image::Bitmap Renderer::renderBitmap(const Texture& texture, const asset::View& view) {
    asset::validate(view);
    return impl_->call([&](const StateGuard&) { return impl_->bitmap(*texture.impl_, view); });
}

void Renderer::draw(const Texture& texture, const asset::View& view, const Output& output) {
    asset::validate(view);
    impl_->call(Impl::touchedBy(*texture.impl_, output), [&](const StateGuard& guard) {
        impl_->draw(*texture.impl_, destinationOf(view, output, guard.drawFramebuffer()));
    });
}

void Renderer::draw(const BytePixels& pixels, const Output& output) {
    if (output.linearLight)
        throw std::invalid_argument("pixels are already blended, so they cannot be added in linear light");
    const asset::View view{pixels.width, pixels.height};
    asset::validate(view);
    impl_->call(Touched::picture(output.write == Output::Write::Over), [&](const StateGuard& guard) {
        const Destination d = destinationOf(view, output, guard.drawFramebuffer());
        const OneDrawBuffer one;
        for (const PixelBox& box : d.boxes)
            forEachPart(box, impl_->maxPart,
                        [&](const PixelBox& part) { impl_->drawGiven(pixels, d, part); });
        impl_->check("drawing");
    });
}

void Renderer::draw(const Texture& texture, const asset::View& view) {
    asset::validate(view);
    impl_->call([&](const StateGuard&) {
        forEachPart(wholeOf(view), impl_->maxPart, [&](const PixelBox& box) {
            Target target = impl_->bytes.take(box.size(), GL_RGBA8);
            Output output;
            output.framebuffer = target.framebuffer.get();
            impl_->draw(*texture.impl_, destinationOf(viewOf(view, box), output, 0));
            impl_->bytes.giveBack(std::move(target));
            impl_->bytes.dropUnused();
        });
    });
    glFinish();
}

bool Renderer::lost() const {
    if (!impl_->lost && currentContext() == impl_->context && impl_->reset && impl_->reset() != GL_NO_ERROR)
        impl_->lost = true;
    return impl_->lost;
}

ProgramFigures Renderer::programs() const { return impl_->resources.programs.figures(); }

}  // namespace vtm::gl
