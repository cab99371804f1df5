#include "backend_gl/layers/layer_renderer.hpp"

#include <algorithm>
#include <optional>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "backend_gl/filters/run_filter.hpp"

namespace vtm::gl {

std::optional<glm::ivec2> Shelves::place(glm::ivec2 rectangle) {
    const bool newShelf = x_ + rectangle.x > size_.x;
    const int y = newShelf ? height() : shelf_;
    if (rectangle.x > size_.x || y + rectangle.y > size_.y)
        return std::nullopt;
    if (newShelf) {
        shelf_ = y;
        shelfHeight_ = 0;
        x_ = 0;
    }
    const glm::ivec2 place(x_, shelf_);
    x_ += rectangle.x;
    shelfHeight_ = std::max(shelfHeight_, rectangle.y);
    return place;
}

void Shelves::clear() { x_ = shelf_ = shelfHeight_ = 0; }

namespace {

using asset::Command;

void bindTexture(Unit unit, const TextureHandle& texture) {
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(GL_TEXTURE_2D, texture.get());
}

GLuint maskOp(Command::Kind kind) {
    switch (kind) {
        case Command::Kind::PopMaskLuminance:
            return GLuint(asset::Op::PopMaskLuminance);
        case Command::Kind::PopMaskLinear:
            return GLuint(asset::Op::PopMaskLinear);
        default:
            return GLuint(asset::Op::PopMaskAlpha);
    }
}

/// Runs of instances, neighbours joined.
std::vector<Range> runsOf(const InstanceList& list, const std::vector<std::uint32_t>& drawn,
                          LeafProgram program) {
    std::vector<Range> runs;
    for (const std::uint32_t d : drawn) {
        const Range& range = list.drawn[d].ranges[unsigned(program)];
        if (range.count == 0)
            continue;
        if (!runs.empty() && runs.back().first + runs.back().count == range.first)
            runs.back().count += range.count;
        else
            runs.push_back(range);
    }
    return runs;
}

}  // namespace

Resources::Resources(const std::string& cacheDirectory)
    : programs(cacheDirectory), vertexArray(makeVertexArray()), boxes(makeBuffer()) {}

LayerRenderer::LayerRenderer(Resources& resources, UploadedAsset& asset, const asset::View& view,
                             GLenum format, bool markOverruns)
    : resources_(resources),
      asset_(asset),
      view_(view),
      format_(format),
      markOverruns_(markOverruns),
      shelves_({view.width, view.height}),
      isPending_(asset.list.drawn.size()) {}

Target LayerRenderer::paint() {
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    push(view_);
    for (const Command& command : asset_.commands)
        execute(command);
    flushFills();
    if (coverage_.texture.get() != 0)
        resources_.pool.giveBack(std::move(coverage_));
    Target picture = std::move(top().target);
    stack_.clear();
    return picture;
}

// ---- The stack ------------------------------------------------------------------------------------

void LayerRenderer::push(asset::View view) {
    stack_.push_back({view, {}});
    if (!top().empty())
        top().target = resources_.pool.take({view.width, view.height}, format_);
    enterTop();
}

void LayerRenderer::giveBack(Picture&& picture) {
    if (!picture.empty())
        resources_.pool.giveBack(std::move(picture.target));
}

void LayerRenderer::enterTop() {
    const glm::ivec2 size(top().view.width, top().view.height);
    if (top().empty())
        return;
    glBindVertexArray(resources_.vertexArray.get());
    glViewport(0, 0, size.x, size.y);
    bindAsset();
    if (coverage_.texture.get() != 0 && coverage_.size != size)
        resources_.pool.giveBack(std::move(coverage_));
    shelves_ = Shelves(size);
}

void LayerRenderer::bindAsset() {
    bindTexture(Unit::Texels, asset_.records.texture());
    bindTexture(Unit::Images, asset_.images);
    bindTexture(Unit::Placements, asset_.placementTexels);
}

void LayerRenderer::execute(const Command& command) {
    if (command.kind == Command::Kind::FillMask)
        return fill(command);
    flushFills();
    switch (command.kind) {
        case Command::Kind::DrawMap:
            return drawMap(asset_.atlases[nextAtlas_++]);
        case Command::Kind::ClipMask:
            return clip(*asset_.list.drawnOfMap[command.map]);
        case Command::Kind::Push:
            return push(top().view);
        case Command::Kind::PushInput:
            return pushInput(command.map);
        case Command::Kind::Filter:
            return filter(asset_.filters.filters[command.map]);
        default:
            return pop(command);
    }
}

// ---- Maps and filters -----------------------------------------------------------------------------

void LayerRenderer::drawMap(Atlas& atlas) {
    if (top().empty())
        return;
    const PixelBox whole{{0, 0}, top().target.size};
    top().target.bind();
    glBlendFunc(GL_ONE, GL_ONE);
    top().target.touch(gl::drawMap(resources_.programs, resources_.picture, asset_, atlas, top().view, whole,
                                   {}, markOverruns_));
    enterTop();
}

void LayerRenderer::pushInput(std::uint32_t index) {
    const asset::Filter& filter = asset_.filters.filters[index];
    const Picture& last = top();
    const bool goesOn = last.place && last.filter == index && last.number + 1 < filter.pictures;
    const auto place = goesOn ? last.place
                              : std::make_shared<const asset::FilterPlace>(asset::placeOf(
                                    asset_.filters, filter, last.view, limit(GL_MAX_TEXTURE_SIZE)));
    const std::uint32_t number = goesOn ? last.number + 1 : 0;
    push(place->viewOf(number));
    top().place = place;
    top().filter = index;
    top().number = number;
}

void LayerRenderer::filter(const asset::Filter& filter) {
    const auto place = top().place;
    std::vector<Target> inputs;
    for (auto from = stack_.end() - std::ptrdiff_t(filter.pictures); from != stack_.end(); ++from)
        inputs.push_back(std::move(from->target));
    stack_.resize(stack_.size() - filter.pictures);
    push(top().view);
    if (!top().empty()) {
        FilterLayers layers(resources_.programs, resources_.pool, asset_);
        drawFilter(layers, asset_.filters, filter, *place, inputs, top().target);
    }
    for (Target& input : inputs)
        if (input.texture.get() != 0)
            resources_.pool.giveBack(std::move(input));
    enterTop();
}

// ---- Masks ----------------------------------------------------------------------------------------

/// Adds to the bound target: sums over undilated leaves need no order.
void LayerRenderer::drawInstances(const std::vector<std::uint32_t>& drawn) {
    glBlendFunc(GL_ONE, GL_ONE);
    glBindBuffer(GL_ARRAY_BUFFER, asset_.instances.get());
    glDisableVertexAttribArray(1);
    for (const LeafProgram kind : {LeafProgram::Solid, LeafProgram::Pieces}) {
        const std::vector<Range> runs = runsOf(asset_.list, drawn, kind);
        if (runs.empty())
            continue;
        const Program& program = resources_.programs.leaf(kind);
        use(program);
        for (const Range& run : runs) {
            pointAttribute(0, GL_UNSIGNED_INT, sizeof(Instance), run.first * sizeof(Instance));
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(run.count));
        }
    }
}

void LayerRenderer::fill(const Command& command) {
    if (top().empty())
        return;
    const std::uint32_t drawn = *asset_.list.drawnOfMap[command.map];
    const PixelBox box = pixelsOf(asset_.list.drawn[drawn], asset_.maps[command.map], top().view);
    if (box.empty())
        return;
    std::optional<glm::ivec2> place;
    if (!isPending_[drawn])
        place = shelves_.place(box.size());
    if (!place) {
        flushFills();
        place = shelves_.place(box.size());  // empty shelves have the view's size
    }
    pending_.push_back({drawn, box, *place, command.paint});
    isPending_[drawn] = true;
}

void LayerRenderer::flushFills() {
    if (pending_.empty())
        return;
    drawCoverage();
    std::vector<Box> boxes;
    for (const PendingFill& fill : pending_) {
        boxes.push_back(boxOf(fill.box, fill.place - fill.box.min, fill.paint));
        top().target.touch(fill.box);
        isPending_[fill.drawn] = false;
    }
    useFill();
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    drawBoxes(resources_.boxes, boxes);
    pending_.clear();
    shelves_.clear();
}

/// Of all pending fills, into the coverage target.
void LayerRenderer::drawCoverage() {
    if (coverage_.texture.get() == 0)
        coverage_ = resources_.pool.take(top().target.size);
    clear(coverage_, coverage_.touched);
    std::vector<std::uint32_t> drawn;
    std::uint32_t first = ~0u, last = 0;
    for (const PendingFill& fill : pending_) {
        const std::uint32_t map = asset_.list.drawn[fill.drawn].map;
        asset_.placements[map] = placementOf(asset_.maps[map], top().view, fill.place - fill.box.min,
                                             {fill.place, fill.place + fill.box.size()});
        first = std::min(first, map);
        last = std::max(last, map);
        drawn.push_back(fill.drawn);
    }
    bindTexture(Unit::Placements, asset_.placementTexels);
    asset_.uploadPlacements(first, last);
    coverage_.bind();
    coverage_.touched = {{0, 0}, {top().view.width, shelves_.height()}};
    drawInstances(drawn);
}

void LayerRenderer::clip(std::uint32_t drawn) {
    if (top().empty())
        return;
    const PixelBox box =
        pixelsOf(asset_.list.drawn[drawn], asset_.maps[asset_.list.drawn[drawn].map], top().view);
    if (box.empty()) {
        clear(top().target, top().target.touched);
        return;
    }
    const glm::ivec2 place = *shelves_.place(box.size());
    pending_.push_back({drawn, box, place, 0});
    drawCoverage();
    pending_.clear();
    shelves_.clear();
    const Program& program = useLayer(Action::Clip, coverage_);
    glUniform4i(program.uniform("maskBox"), box.min.x, box.min.y, box.max.x, box.max.y);
    glBlendFunc(GL_ZERO, GL_SRC_ALPHA);
    drawBoxes(resources_.boxes, {boxOf(top().target.touched, place - box.min)});
}

// ---- Groups ---------------------------------------------------------------------------------------

void LayerRenderer::pop(const Command& command) {
    Picture popped = std::move(stack_.back());
    stack_.pop_back();
    enterTop();
    if (top().empty())
        return;
    if (command.kind != Command::Kind::Pop)
        popMask(command, popped.target);
    else if (command.blend == asset::Blend::Normal)
        popOver(command, popped.target);
    else
        popBlend(command, popped.target);
    giveBack(std::move(popped));
}

void LayerRenderer::popMask(const Command& command, const Target& popped) {
    const Program& program = useLayer(Action::Mask, popped);
    glUniform1ui(program.uniform("maskOp"), maskOp(command.kind));
    glBlendFunc(GL_ZERO, GL_SRC_ALPHA);
    drawBoxes(resources_.boxes, {boxOf(top().target.touched)});
}

void LayerRenderer::popOver(const Command& command, const Target& popped) {
    const Program& program = useLayer(Action::Over, popped);
    glUniform1f(program.uniform("opacity"), command.opacity);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    drawBoxes(resources_.boxes, {boxOf(popped.touched)});
    top().target.touch(popped.touched);
}

/// The shader reads the backdrop from a copy, since a target cannot be read while it is drawn into.
void LayerRenderer::popBlend(const Command& command, const Target& popped) {
    const PixelBox& box = popped.touched;
    if (box.empty())
        return;
    Target backdrop = resources_.pool.take(top().target.size, format_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, top().target.framebuffer.get());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, backdrop.framebuffer.get());
    glBlitFramebuffer(box.min.x, box.min.y, box.max.x, box.max.y, box.min.x, box.min.y, box.max.x, box.max.y,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    backdrop.touch(box);
    const Program& program = resources_.programs.blend();
    use(program);
    bindTexture(Unit::Layer, popped.texture);
    bindTexture(Unit::Backdrop, backdrop.texture);
    top().target.bind();
    glUniform1f(program.uniform("opacity"), command.opacity);
    glUniform1ui(program.uniform("blendMode"), GLuint(command.blend));
    glDisable(GL_BLEND);
    drawBoxes(resources_.boxes, {boxOf(box)});
    glEnable(GL_BLEND);
    top().target.touch(box);
    resources_.pool.giveBack(std::move(backdrop));
}

// ---- Composition ----------------------------------------------------------------------------------

/// With what every program may ask for.
void LayerRenderer::use(const Program& program) const {
    const Sections& s = asset_.sections;
    program.use();
    glUniform2f(program.uniform("targetSize"), float(stack_.back().view.width),
                float(stack_.back().view.height));
    glUniform4ui(program.uniform("sections"), s.leaves, s.pieces, s.paints, s.data);
    glUniform1ui(program.uniform("imageSection"), s.images);
    glUniform1ui(program.uniform("rampSums"), s.rampSums);
}

void LayerRenderer::useFill() {
    const bool programs = std::ranges::any_of(
        pending_, [&](const PendingFill& fill) { return asset::isProgram(asset_.paints[fill.paint]); });
    const Program& program =
        resources_.programs.fill(programs ? asset_.features : Features(), asset_.materialSet);
    use(program);
    const asset::View& view = top().view;
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    const glm::dvec2 pixel = glm::dvec2(view.width, view.height) * 0.5;
    const glm::dvec2 picture = inverse * (pixel - view.toPixels[2]);
    glUniform4f(program.uniform("pixelToPicture"), float(inverse[0].x), float(inverse[0].y),
                float(inverse[1].x), float(inverse[1].y));
    glUniform4f(program.uniform("pictureAnchor"), float(picture.x), float(picture.y), float(pixel.x),
                float(pixel.y));
    bindTexture(Unit::Layer, coverage_.texture);
    top().target.bind();
}

const Program& LayerRenderer::useLayer(Action action, const Target& layer) {
    const Program& program = resources_.programs.layer();
    use(program);
    glUniform1ui(program.uniform("action"), GLuint(action));
    bindTexture(Unit::Layer, layer.texture);
    top().target.bind();
    return program;
}

}  // namespace vtm::gl
