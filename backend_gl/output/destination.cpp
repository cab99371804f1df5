#include "backend_gl/output/destination.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace vtm::gl {

namespace {

/// The attachment of the bound framebuffer's first draw buffer, as queries name it.
struct Attachment {
    explicit Attachment(GLuint framebuffer) : buffer(GLenum(limit(GL_DRAW_BUFFER0))) {
        const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
        if (status != GL_FRAMEBUFFER_COMPLETE)
            throw GlError(fmt::format("framebuffer {} is not complete (0x{:04x})", framebuffer, status));
        if (buffer == GL_NONE)
            throw GlError(fmt::format("framebuffer {} has no first draw buffer", framebuffer));
        const GLenum type = get(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE);
        if (type != GL_UNSIGNED_NORMALIZED && type != GL_FLOAT)
            throw GlError(fmt::format("framebuffer {} has neither a normalised nor a float format (0x{:04x})",
                                      framebuffer, type));
    }
    bool isSrgb() const { return get(GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING) == GL_SRGB; }
    bool isFloat() const { return get(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT; }
    GLenum redBits() const { return get(GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE); }

    GLenum buffer;

private:
    GLenum get(GLenum name) const {
        GLint value = 0;
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, buffer, name, &value);
        return GLenum(value);
    }
};

Finish finishOf(const Output& output, const Attachment& attachment) {
    const bool dither = output.dither && attachment.redBits() == 8 && !attachment.isFloat();
    unsigned flags = 0;
    if (output.linearLight)
        flags |= Finish::LinearLight;
    if (output.encoding == Output::Encoding::Linear || attachment.isSrgb())
        flags |= Finish::LinearOut;
    if (output.alpha == Output::Alpha::Straight)
        flags |= Finish::StraightOut;
    if (dither)
        flags |= Finish::Dither | (attachment.isSrgb() ? unsigned(Finish::EncodedStore) : 0u);
    return Finish(flags);
}

void refuseContradictions(const Output& output, const Attachment& attachment) {
    if (output.write != Output::Write::Over)
        return;
    if (output.alpha == Output::Alpha::Straight)
        throw std::invalid_argument(
            "straight colours replace what is there; only premultiplied ones go over it");
    if (attachment.isFloat() && attachment.redBits() == 32 && !hasExtension("GL_EXT_float_blend"))
        throw GlError("the driver cannot blend into 32-bit floats (no GL_EXT_float_blend)");
}

/// Pixels of the view in the framebuffer.
PixelBox placed(const PixelRectangle& r, const asset::View& view, const Output& output) {
    const glm::i64vec2 view0(0), view1(view.width, view.height), corner(r.x, r.y), size(r.width, r.height);
    glm::i64vec2 minimum = glm::clamp(corner, view0, view1),
                 maximum = glm::clamp(corner + size, view0, view1);
    if (output.firstRow == Output::FirstRow::Top) {
        std::swap(minimum.y, maximum.y);
        minimum.y = view.height - minimum.y;
        maximum.y = view.height - maximum.y;
    }
    const glm::i64vec2 origin(output.x, output.y), none(0), largest(1 << 30);
    return {glm::ivec2(glm::clamp(minimum + origin, none, largest)),
            glm::ivec2(glm::clamp(maximum + origin, none, largest))};
}

asset::View viewOf(const asset::View& view, const Output& output, glm::ivec2 size) {
    asset::View result = view;
    if (output.firstRow == Output::FirstRow::Top) {
        for (int i = 0; i < 3; ++i)
            result.toPixels[i].y = -result.toPixels[i].y;
        result.toPixels[2].y += view.height;
    }
    result.toPixels[2] += glm::dvec2(output.x, output.y);
    result.width = size.x;
    result.height = size.y;
    return result;
}

/// Calls use(part) for what `from` has and `hole`, which it overlaps, has not.
template <class Use>
void subtract(const PixelBox& from, const PixelBox& hole, Use&& use) {
    const glm::ivec2 minimum = glm::max(from.min, hole.min), maximum = glm::min(from.max, hole.max);
    for (const PixelBox& part :
         {PixelBox{from.min, {from.max.x, minimum.y}}, PixelBox{{from.min.x, maximum.y}, from.max},
          PixelBox{{from.min.x, minimum.y}, {minimum.x, maximum.y}},
          PixelBox{{maximum.x, minimum.y}, {from.max.x, maximum.y}}})
        if (!part.empty())
            use(part);
}

bool overlap(const PixelBox& a, const PixelBox& b) {
    return !PixelBox{glm::max(a.min, b.min), glm::min(a.max, b.max)}.empty();
}

}  // namespace

std::vector<PixelBox> disjoint(const std::vector<PixelBox>& boxes) {
    std::vector<PixelBox> result;
    for (const PixelBox& box : boxes) {
        std::vector<PixelBox> parts;
        if (!box.empty())
            parts.push_back(box);
        for (std::size_t i = 0, end = result.size(); i < end && !parts.empty(); ++i) {
            std::vector<PixelBox> rest;
            for (const PixelBox& part : parts)
                if (overlap(part, result[i]))
                    subtract(part, result[i], [&](const PixelBox& p) { rest.push_back(p); });
                else
                    rest.push_back(part);
            parts = std::move(rest);
        }
        result.insert(result.end(), parts.begin(), parts.end());
    }
    return result;
}

Destination destinationOf(const asset::View& view, const Output& output, GLuint bound) {
    Destination destination;
    destination.framebuffer = output.framebuffer.value_or(bound);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, destination.framebuffer);
    const Attachment attachment(destination.framebuffer);
    refuseContradictions(output, attachment);
    destination.multisampled = limit(GL_SAMPLE_BUFFERS) > 0;
    destination.bits = attachment.isFloat() ? 0 : attachment.redBits();
    destination.over = output.write == Output::Write::Over;
    destination.finish = finishOf(output, attachment);
    destination.corner = {output.x, output.y};
    destination.rows = view.height;
    destination.isTopFirst = output.firstRow == Output::FirstRow::Top;

    std::vector<PixelBox> boxes;
    for (const PixelRectangle& r :
         output.damage.value_or(std::vector<PixelRectangle>{{0, 0, view.width, view.height}}))
        boxes.push_back(placed(r, view, output));
    destination.boxes = disjoint(boxes);
    // A larger viewport would be cut by GL, and no framebuffer has more pixels.
    glm::ivec2 maximum(0), largest(0);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, &largest.x);
    for (PixelBox& box : destination.boxes) {
        box.min = glm::min(box.min, largest);
        box.max = glm::min(box.max, largest);
        maximum = glm::max(maximum, box.max);
    }
    std::erase_if(destination.boxes, [](const PixelBox& box) { return box.empty(); });
    destination.view = viewOf(view, output, maximum);
    return destination;
}

OneDrawBuffer::OneDrawBuffer() : framebuffer_(GLuint(limit(GL_DRAW_FRAMEBUFFER_BINDING))) {
    if (framebuffer_ == 0)
        return;
    const int count = limit(GL_MAX_DRAW_BUFFERS);
    bool others = false;
    for (int i = 0; i < count; ++i) {
        buffers_.push_back(GLenum(limit(GL_DRAW_BUFFER0 + GLenum(i))));
        others |= i > 0 && buffers_.back() != GL_NONE;
    }
    if (others)
        glDrawBuffers(1, buffers_.data());
    else
        buffers_.clear();
}

OneDrawBuffer::~OneDrawBuffer() {
    if (buffers_.empty())
        return;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    glDrawBuffers(GLsizei(buffers_.size()), buffers_.data());
}

}  // namespace vtm::gl
