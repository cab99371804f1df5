#include "api/openvg/gl/painter.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace vtm::openvg::gl {

namespace {

constexpr GLsizei verticesPerTile = 4;

bool hasExtension(const Functions& gl, std::string_view name) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, GLuint(i))) == name)
            return true;
    return false;
}

/// Three bytes of every four.
std::vector<std::uint8_t> withoutAlpha(const std::uint8_t* bytes, std::size_t count) {
    std::vector<std::uint8_t> colors(3 * count);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(&colors[3 * i], bytes + 4 * i, 3);
    return colors;
}

GLint limitOf(const Functions& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

}  // namespace

Painter::Painter(std::shared_ptr<Discarded> discarded, bool mayFetch)
    : gl_(currentFunctions()), discarded_(std::move(discarded)) {
    abilities_.renderer = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
    abilities_.fetches = mayFetch && hasExtension(gl_, "GL_EXT_shader_framebuffer_fetch");
    abilities_.drawsFloats = hasExtension(gl_, "GL_EXT_color_buffer_float");
    abilities_.maxSide = limitOf(gl_, GL_MAX_TEXTURE_SIZE);
    programs_ = std::make_unique<Programs>(gl_, abilities_.fetches);
    makeBuffers();
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.Disable(GL_DITHER);
    // A driver that does not take the first program takes no other.
    programs_->use(ProgramKey());
    check();
}

void Painter::makeBuffers() {
    gl_.GenFramebuffers(1, &framebuffer_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.GenVertexArrays(1, &vertices_);
    gl_.BindVertexArray(vertices_);
    gl_.GenBuffers(1, &instances_);
    gl_.GenBuffers(1, &blocks_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, instances_);
    for (GLuint attribute = 0; attribute < 3; ++attribute) {
        gl_.EnableVertexAttribArray(attribute);
        gl_.VertexAttribDivisor(attribute, 1);
    }
    const auto alignment = std::size_t(std::max(limitOf(gl_, GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT), 1));
    blockStride_ = (sizeof(LayerBlock) + alignment - 1) / alignment * alignment;
}

void Painter::check() {
    for (const GLuint name : discarded_->take())
        gl_.DeleteTextures(1, &name);
    if (gl_.GetGraphicsResetStatus && gl_.GetGraphicsResetStatus() != GL_NO_ERROR)
        throw std::runtime_error("the context was lost");
    if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR)
        throw std::runtime_error(fmt::format("GL failed (0x{:04x})", error));
}

GLsync Painter::fence() {
    const GLsync fence = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl_.Flush();
    return fence;
}

void Painter::waitFor(GLsync fence) {
    gl_.WaitSync(fence, 0, GL_TIMEOUT_IGNORED);
    gl_.DeleteSync(fence);
}

// ---- Textures -------------------------------------------------------------------------------------

void Painter::bind(Unit unit, GLuint texture) {
    gl_.ActiveTexture(GLenum(GL_TEXTURE0 + int(unit)));
    gl_.BindTexture(GL_TEXTURE_2D, texture);
}

TexturePointer Painter::makeTexture(GLenum format, int width, int height) {
    check();
    GLuint name = 0;
    gl_.GenTextures(1, &name);
    auto texture =
        std::make_shared<const Texture>(discarded_, name, width, height, format == GL_R8 ? GL_RED : GL_RGBA);
    bind(Unit::source, name);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    return gl_.GetError() == GL_NO_ERROR ? texture : nullptr;
}

void Painter::upload(const Texture& texture, const Rectangle& part, const std::uint8_t* bytes) {
    const int width = part.x1 - part.x0, height = part.y1 - part.y0;
    std::vector<std::uint8_t> opaque;
    if (texture.format() == GL_RGB) {
        opaque = withoutAlpha(bytes, std::size_t(width) * std::size_t(height));
        bytes = opaque.data();
    }
    bind(Unit::source, texture.name());
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, part.x0, part.y0, width, height, texture.format(), GL_UNSIGNED_BYTE,
                      bytes);
}

void Painter::target(const Texture& texture) {
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    gl_.Viewport(0, 0, texture.width(), texture.height());
}

void Painter::download(const Texture& texture, const Rectangle& part, std::uint8_t* bytes) {
    target(texture);
    gl_.ReadPixels(part.x0, part.y0, part.x1 - part.x0, part.y1 - part.y0, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
}

// ---- Batches --------------------------------------------------------------------------------------

void Painter::uploadRows(FloatRows& to, GLenum internal, GLenum format, int columns, int channels,
                         std::span<const float> values) {
    const int rowValues = columns * channels, rows = int(values.size()) / rowValues;
    if (rows == 0)
        return;
    if (rows > to.rows) {
        discarded_->add(to.texture);
        to.rows = std::max(rows, 2 * to.rows);
        gl_.GenTextures(1, &to.texture);
        bind(Unit::source, to.texture);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl_.TexStorage2D(GL_TEXTURE_2D, 1, internal, columns, to.rows);
    }
    bind(Unit::source, to.texture);
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, format, GL_FLOAT, values.data());
}

void Painter::uploadData(const Batch& batch) {
    std::vector<float> shares;
    shares.reserve(batch.shareCount + shareColumns);
    for (const std::vector<float>& part : batch.shares)
        shares.insert(shares.end(), part.begin(), part.end());
    shares.resize((shares.size() + shareColumns - 1) / shareColumns * shareColumns);
    uploadRows(shares_, GL_R32F, GL_RED, shareColumns, 1, shares);
    std::vector<float> ramps(batch.ramps.size() * rampColumns * 4);
    for (std::size_t i = 0; i < batch.ramps.size(); ++i)
        std::memcpy(&ramps[i * rampColumns * 4], batch.ramps[i].data(),
                    batch.ramps[i].size() * sizeof(glm::vec4));
    uploadRows(ramps_, GL_RGBA32F, GL_RGBA, rampColumns, 4, ramps);
    gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(batch.instances.size() * sizeof(Instance)),
                   batch.instances.data(), GL_STREAM_DRAW);
}

void Painter::uploadBlocks(const Batch& batch) {
    std::vector<std::uint8_t> bytes(batch.draws.size() * blockStride_);
    for (std::size_t i = 0; i < batch.draws.size(); ++i)
        std::memcpy(&bytes[i * blockStride_], &batch.draws[i].block, sizeof(LayerBlock));
    gl_.BindBuffer(GL_UNIFORM_BUFFER, blocks_);
    gl_.BufferData(GL_UNIFORM_BUFFER, GLsizeiptr(bytes.size()), bytes.data(), GL_STREAM_DRAW);
}

void Painter::copyTarget(const Texture& target, std::span<const Rectangle> parts) {
    if (!backdrop_ || backdrop_->width() < target.width() || backdrop_->height() < target.height()) {
        const int width = std::max(target.width(), backdrop_ ? backdrop_->width() : 0),
                  height = std::max(target.height(), backdrop_ ? backdrop_->height() : 0);
        backdrop_ = makeTexture(GL_RGBA8, width, height);
        if (!backdrop_)
            throw std::runtime_error("no memory for a copy of the target");
    }
    bind(Unit::backdrop, backdrop_->name());
    for (const Rectangle& part : parts)
        gl_.CopyTexSubImage2D(GL_TEXTURE_2D, 0, part.x0, part.y0, part.x0, part.y0, part.x1 - part.x0,
                              part.y1 - part.y0);
}

void Painter::drawOne(const Batch& batch, std::size_t i) {
    const Draw& draw = batch.draws[i];
    target(*draw.target);
    const bool copiesItself = draw.texels[0] == draw.target;
    if (copiesItself || (draw.readsTarget && !abilities_.fetches))
        copyTarget(*draw.target, draw.read);
    programs_->use(draw.key);
    bind(Unit::shares, shares_.texture);
    bind(Unit::ramps, ramps_.texture);
    const TexturePointer& source = copiesItself ? backdrop_ : draw.texels[0];
    bind(Unit::source, source ? source->name() : 0);
    bind(Unit::other, draw.texels[1] ? draw.texels[1]->name() : 0);
    bind(Unit::mask, draw.mask ? draw.mask->name() : 0);
    gl_.BindBufferRange(GL_UNIFORM_BUFFER, 0, blocks_, GLintptr(i * blockStride_),
                        GLsizeiptr(sizeof(LayerBlock)));
    const auto at = [&](std::size_t offset) {
        return reinterpret_cast<const void*>(draw.first * sizeof(Instance) + offset);
    };
    constexpr auto stride = GLsizei(sizeof(Instance));
    gl_.VertexAttribIPointer(0, 4, GL_UNSIGNED_SHORT, stride, at(0));
    gl_.VertexAttribIPointer(1, 1, GL_UNSIGNED_INT, stride, at(offsetof(Tile, shares)));
    gl_.VertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, stride, at(offsetof(Instance, color)));
    gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, verticesPerTile, GLsizei(draw.count));
}

void Painter::draw(const Batch& batch) {
    uploadData(batch);
    uploadBlocks(batch);
    for (std::size_t i = 0; i < batch.draws.size(); ++i)
        drawOne(batch, i);
    gl_.Flush();
}

}  // namespace vtm::openvg::gl
