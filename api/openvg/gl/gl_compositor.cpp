// The compositor of pixels in textures.

#include <cstdlib>
#include <string_view>

#include "api/openvg/draw/clip.hpp"
#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/draw/row_compositor.hpp"
#include "api/openvg/draw/source_description.hpp"
#include "api/openvg/gl/device.hpp"
#include "api/openvg/gl/filters.hpp"
#include "api/openvg/gl/layer_blocks.hpp"
#include "api/openvg/gl/texture_copy.hpp"
#include "api/openvg/image/images.hpp"

namespace vtm::openvg {

namespace {

using gl::Device;
using gl::Draw;
using gl::LayerBlock;
using gl::ProgramKey;
using gl::SourceKind;
using gl::TexturePointer;
using gl::Tiles;

Rectangle targetOf(const CopyArea& area) {
    return {area.dx, area.dy, area.dx + area.width, area.dy + area.height};
}

Rectangle sourceOf(const CopyArea& area) {
    return {area.sx, area.sy, area.sx + area.width, area.sy + area.height};
}

bool isEmpty(const CopyArea& area) { return area.width == 0 || area.height == 0; }

/// What scissoring leaves of a rectangle.
Tiles scissored(const Context& context, const Rectangle& box) {
    const Clip clip(context);
    if (clip.isBox())
        return gl::oneTile(box.intersected(clip.bounds()));
    gl::TileBuilder builder;
    for (int y = box.y0; y < box.y1; ++y)
        clip.parts(y, box.x0, box.x1, [&](int first, int end) { builder.add(y, first, end, 1); });
    return builder.finish();
}

/// One drawing call on its way to the device.
class LayerDraw {
public:
    LayerDraw(Device& device, const Context& context) : device_(device), context_(context) {}

    /// False for a source that shaders do not know, or where there is no room for its textures.
    bool setSource(const Layer& layer);
    void draw(Tiles tiles);

private:
    bool setOther(const Layer& layer);
    bool setColors();
    bool setTexels(int i, const TexelField& field);
    bool setMask();
    void setConversion();
    bool isOverwriting(const Tiles& tiles) const;
    void place(glm::ivec2 origin);

    Device& device_;
    const Context& context_;
    SourceDescription source_;
    std::optional<TexelField> other_;  ///< a factor, or a stencil
    Draw draw_;
    Color color_{0};
    std::optional<gl::RampRow> ramp_;
    bool isOpaque_ = false;  ///< the source
};

bool LayerDraw::setTexels(int i, const TexelField& field) {
    draw_.texels[i] = gl::readTexture(device_, field.image->storage->pixels);
    return draw_.texels[i] != nullptr;
}

bool LayerDraw::setMask() {
    const Surface& surface = *context_.surface;
    draw_.key.isMasked = context_.state.masking && surface.mask;
    if (draw_.key.isMasked)
        draw_.mask = gl::maskTexture(device_, *surface.mask);
    return !draw_.key.isMasked || draw_.mask;
}

bool LayerDraw::setColors() {
    ProgramKey& key = draw_.key;
    if (const auto* const color = std::get_if<Color>(&source_.colors)) {
        key.source = SourceKind::solid;
        color_ = *color;
        return true;
    }
    if (const auto* const texels = std::get_if<TexelField>(&source_.colors)) {
        key.source = SourceKind::texels;
        isOpaque_ = texels->image->format().alpha.bits == 0 &&
                    (texels->tiling != VG_TILE_FILL || texels->fill.a == 1);
        return setTexels(0, *texels);
    }
    if (const auto* const linear = std::get_if<LinearField>(&source_.colors)) {
        key.source = SourceKind::linear;
        ramp_ = gl::rampRow(*linear->ramp);
    } else {
        key.source = SourceKind::radial;
        ramp_ = gl::rampRow(*std::get<RadialField>(source_.colors).ramp);
    }
    return ramp_.has_value();
}

bool LayerDraw::setOther(const Layer& layer) {
    other_ = source_.factor;
    draw_.key.multiplies = other_.has_value();
    if (layer.stencil) {
        SourceDescription stencil;
        if (!layer.stencil->describe(stencil) || !std::holds_alternative<TexelField>(stencil.colors))
            return false;
        other_ = std::get<TexelField>(stencil.colors);
        draw_.key.isStencil = true;
    }
    return !other_ || setTexels(1, *other_);
}

void LayerDraw::setConversion() {
    const PixelFormat& format = context_.surface->pixels().format();
    const ScaleAndBias transform(context_.state);
    if (draw_.key.source == SourceKind::solid && !draw_.key.multiplies) {
        prepareColors(std::span(&color_, 1), source_.space, transform, format);
        isOpaque_ = color_.a == 1;
        return;
    }
    LayerBlock& block = draw_.block;
    block.conversion.x = source_.space.linear;
    block.conversion.y = source_.space.luminance;
    block.conversion.z = transform.isOn();
    if (transform.isOn()) {
        block.scale = transform.scale();
        block.bias = transform.bias();
    }
    if (source_.transform)
        gl::setTransform(block, *source_.transform, source_.colorSpace);
    isOpaque_ = isOpaque_ && !transform.isOn() && !source_.transform && !draw_.key.multiplies;
}

bool LayerDraw::setSource(const Layer& layer) {
    const Surface& surface = *context_.surface;
    if (!layer.source.describe(source_) || !setOther(layer) || !setColors() || !setMask())
        return false;
    draw_.key.blendMode = context_.state.blendMode;
    draw_.key.transforms = source_.transform.has_value();
    gl::setSurface(draw_.block, surface.pixels().format(), surface.width(), surface.height());
    setConversion();
    return true;
}

/// Whether nothing of what was there is left.
bool LayerDraw::isOverwriting(const Tiles& tiles) const {
    const int mode = draw_.key.blendMode;
    return tiles.areAllCovered() && !draw_.key.isMasked && !draw_.key.isStencil &&
           (mode == VG_BLEND_SRC || (mode == VG_BLEND_SRC_OVER && isOpaque_));
}

void LayerDraw::place(glm::ivec2 origin) {
    LayerBlock& block = draw_.block;
    if (draw_.key.source == SourceKind::solid && !other_)
        return;  // colours are the same everywhere
    gl::setOrigin(block, origin);
    if (const auto* const texels = std::get_if<TexelField>(&source_.colors))
        block.texels[0] = gl::texelBlock(*texels, origin);
    else if (const auto* const linear = std::get_if<LinearField>(&source_.colors))
        gl::setGradient(block, *linear, origin);
    else if (const auto* const radial = std::get_if<RadialField>(&source_.colors))
        gl::setGradient(block, *radial, origin);
    if (other_)
        block.texels[1] = gl::texelBlock(*other_, origin);
}

void LayerDraw::draw(Tiles tiles) {
    place({tiles.box.x0, tiles.box.y0});
    draw_.target = gl::writeTexture(device_, context_.surface->pixels());
    draw_.readsTarget = device_.abilities().fetches || !isOverwriting(tiles);
    device_.draw(draw_, std::move(tiles), color_, ramp_ ? &*ramp_ : nullptr);
}

class GlCompositor final : public Compositor {
public:
    explicit GlCompositor(Device& device) : device_(device) {}

    void draw(Context& context, const Layer& layer, const Coverage& coverage) override {
        LayerDraw draw(device_, context);
        if (!isReady(context) || !draw.setSource(layer))
            return cpuCompositor().draw(context, layer, coverage);
        const Clip clip(context);
        gl::TileBuilder builder;
        coverage(clip.bounds(), [&](int y, std::span<const CoverageRun> runs) {
            for (const CoverageRun& run : runs)
                clip.parts(y, run.first, run.end,
                           [&](int first, int end) { builder.add(y, first, end, run.share); });
        });
        Tiles tiles = builder.finish();
        if (!tiles.tiles.empty())
            draw.draw(std::move(tiles));
    }

    void clear(Context& context, const CopyArea& area, std::uint32_t word) override {
        if (isEmpty(area))
            return;
        if (!isReady(context))
            return cpuCompositor().clear(context, area, word);
        const Draw draw = drawInto(context.surface->pixels(), ProgramKey::Task::store);
        device_.draw(draw, scissored(context, targetOf(area)),
                     context.surface->pixels().format().decode(word));
    }

    void setPixels(Context& context, const Image& from, const CopyArea& area) override {
        if (isEmpty(area))
            return;
        TexturePointer source;
        if (isReady(context))
            source = gl::readTexture(device_, from.storage->pixels);
        if (!source)
            return cpuCompositor().setPixels(context, from, area);
        const glm::ivec2 shift(from.area.x0 + area.sx - area.dx, from.area.y0 + area.sy - area.dy);
        copy(source, from.format(), shift, context.surface->pixels(), scissored(context, targetOf(area)));
    }

    void writePixels(Context& context, const MemoryPixels& from, const CopyArea& area) override {
        if (isEmpty(area))
            return;
        const Clip clip(context);
        if (!isReady(context) || !clip.isBox())
            return cpuCompositor().writePixels(context, from, area);
        const Rectangle box = targetOf(area).intersected(clip.bounds());
        if (box.empty())
            return;
        Pixels pixels(box.x1 - box.x0, box.y1 - box.y0, context.surface->pixels().format());
        const CopyArea part{
            0, 0, area.sx + box.x0 - area.dx, area.sy + box.y0 - area.dy, pixels.width(), pixels.height()};
        openvg::copyPixels(from, pixels, part);
        gl::writePart(device_, context.surface->pixels(), box, pixels);
    }

    void getPixels(Context& context, Image& to, const CopyArea& area) override {
        if (isEmpty(area))
            return;
        if (!isReady(context) || !gl::readTexture(device_, to.storage->pixels))
            return cpuCompositor().getPixels(context, to, area);
        const Rectangle box = moved(targetOf(area), to);
        copy(gl::readTexture(device_, context.surface->pixels()), context.surface->pixels().format(),
             {area.sx - box.x0, area.sy - box.y0}, to.storage->pixels, gl::oneTile(box));
    }

    void readPixels(Context& context, const MemoryPixels& to, const CopyArea& area) override {
        if (isEmpty(area))
            return;
        if (!isReady(context))
            return cpuCompositor().readPixels(context, to, area);
        Pixels pixels(area.width, area.height, context.surface->pixels().format());
        gl::readPart(device_, context.surface->pixels(), sourceOf(area), pixels);
        openvg::copyPixels(std::as_const(pixels), to, {area.dx, area.dy, 0, 0, area.width, area.height});
    }

    void copyPixels(Context& context, const CopyArea& area) override {
        if (isEmpty(area))
            return;
        // In one part: what is copied must not have been overwritten.
        if (!isReady(context) || !Clip(context).isBox())
            return cpuCompositor().copyPixels(context, area);
        StoredPixels& pixels = context.surface->pixels();
        const Rectangle source = sourceOf(area);
        copy(gl::readTexture(device_, pixels), pixels.format(), {area.sx - area.dx, area.sy - area.dy},
             pixels, scissored(context, targetOf(area)), source);
    }

    bool clearImage(Image& to, const CopyArea& area, std::uint32_t word) override {
        if (!isInTexture(to))
            return false;
        device_.draw(drawInto(to.storage->pixels, ProgramKey::Task::store),
                     gl::oneTile(moved(targetOf(area), to)), to.format().decode(word));
        return true;
    }

    bool copyImage(Image& to, const Image& from, const CopyArea& area) override {
        if (!isInTexture(to) && !isInTexture(from))
            return false;
        const TexturePointer source = gl::readTexture(device_, from.storage->pixels);
        if (!source || !gl::readTexture(device_, to.storage->pixels))
            return false;
        const Rectangle box = moved(targetOf(area), to), read = moved(sourceOf(area), from);
        copy(source, from.format(), {read.x0 - box.x0, read.y0 - box.y0}, to.storage->pixels,
             gl::oneTile(box), read);
        return true;
    }

    bool writeImage(Image& to, const MemoryPixels& from, const CopyArea& area) override {
        if (!isInTexture(to))
            return false;
        Pixels pixels(area.width, area.height, to.format());
        openvg::copyPixels(from, pixels, {0, 0, area.sx, area.sy, area.width, area.height});
        gl::writePart(device_, to.storage->pixels, moved(targetOf(area), to), pixels);
        return true;
    }

    bool readImage(const Image& from, const MemoryPixels& to, const CopyArea& area) override {
        if (from.storage->pixels.areInMemory() || !isInTexture(from))
            return false;
        Pixels pixels(area.width, area.height, from.format());
        gl::readPart(device_, from.storage->pixels, moved(sourceOf(area), from), pixels);
        openvg::copyPixels(std::as_const(pixels), to, {area.dx, area.dy, 0, 0, area.width, area.height});
        return true;
    }

    bool filterImage(Image& to, const Image& from, const ImageFilter& filter) override {
        return isInTexture(from) && gl::filterImage(device_, to, from, filter);
    }

    void flush() override { device_.flush(); }
    void finish() override { device_.finish(); }

private:
    bool isInTexture(const Image& image) const {
        return !device_.isLost() && image.storage->pixels.areInTexture();
    }

    /// A part of an image in its storage.
    static Rectangle moved(const Rectangle& part, const Image& image) {
        const int x = image.area.x0, y = image.area.y0;
        return {part.x0 + x, part.y0 + y, part.x1 + x, part.y1 + y};
    }

    /// False: the CPU draws on this surface, now or from now on.
    bool isReady(Context& context) {
        Surface& surface = *context.surface;
        if (!device_.isLost() && gl::readTexture(device_, surface.pixels()))
            return true;
        surface.compositor = &cpuCompositor();
        setError(context, VG_OUT_OF_MEMORY_ERROR);
        return false;
    }

    Draw drawInto(StoredPixels& pixels, ProgramKey::Task task) {
        Draw draw;
        draw.key.task = task;
        draw.target = gl::writeTexture(device_, pixels);
        gl::setSurface(draw.block, pixels.format(), pixels.width(), pixels.height());
        return draw;
    }

    /// Pixels of one texture into another, `shift` from target to source. `read`: of the target.
    void copy(const TexturePointer& source, const PixelFormat& format, glm::ivec2 shift, StoredPixels& to,
              Tiles tiles, const std::optional<Rectangle>& read = std::nullopt) {
        Draw draw = drawInto(to, ProgramKey::Task::copy);
        draw.texels[0] = source;
        gl::setCopied(draw.block, format, shift);
        if (read)
            draw.read.push_back(*read);
        device_.draw(draw, std::move(tiles));
    }

    Device& device_;
};

VtmCompositor wishOfEnvironment() {
    const char* const value = std::getenv("VTM_OPENVG_COMPOSITOR");
    const std::string_view text = value ? value : "";
    return text == "cpu"            ? VTM_COMPOSITOR_CPU
           : text.starts_with("gl") ? VTM_COMPOSITOR_GL
                                    : VTM_COMPOSITOR_AUTOMATIC;
}

/// Without making a context where there is no hope.
Compositor* gpuCompositor() {
    static const bool mayBe = gl::likelyDrivers() == gles_context::Drivers::perhapsGpu;
    return mayBe && glCompositor() && !Device::open()->isSoftware() ? glCompositor() : nullptr;
}

}  // namespace

Compositor* glCompositor() {
    Device* const device = Device::open();
    if (!device)
        return nullptr;
    static auto& compositor = *new GlCompositor(*device);
    return device->isLost() ? nullptr : &compositor;
}

const char* compositorFault() { return Device::fault(); }

Compositor& chosenCompositor(VtmCompositor wanted) {
    if (wanted == VTM_COMPOSITOR_AUTOMATIC)
        wanted = wishOfEnvironment();
    Compositor* const compositor = wanted == VTM_COMPOSITOR_CPU  ? nullptr
                                   : wanted == VTM_COMPOSITOR_GL ? glCompositor()
                                                                 : gpuCompositor();
    return compositor ? *compositor : cpuCompositor();
}

}  // namespace vtm::openvg
