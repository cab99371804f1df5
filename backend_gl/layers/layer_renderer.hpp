/// \file
/// Running the commands of an asset in compat mode under one view that fits a target.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/output/boxes.hpp"
#include "backend_gl/output/target.hpp"
#include "backend_gl/upload/upload.hpp"

namespace vtm::gl {

class Shelves {
public:
    explicit Shelves(glm::ivec2 size) : size_(size) {}

    /// The rectangle's min corner, or nothing where no room is left.
    std::optional<glm::ivec2> place(glm::ivec2 rectangle);
    /// All that was placed lies in rows [0, height()).
    int height() const { return shelf_ + shelfHeight_; }
    void clear();

private:
    glm::ivec2 size_;
    int x_ = 0, shelf_ = 0, shelfHeight_ = 0;
};

/// What a renderer keeps from picture to picture.
struct Resources {
    explicit Resources(const std::string& cacheDirectory);

    Programs programs;
    TargetPool pool;
    VertexArrayHandle vertexArray;
    BufferHandle boxes;
};

class LayerRenderer {
public:
    /// The pool's targets have the view's size; the view is invertible. GL is in the state of StateGuard.
    LayerRenderer(Resources& resources, UploadedAsset& asset, const asset::View& view);

    /// The picture; the caller gives it back to the pool.
    Target paint();

private:
    /// A FillMask that waits for its coverage: consecutive ones share a coverage pass, each in a
    /// rectangle of its own, and a composition pass, so that thousands of glyphs cost few passes.
    struct PendingFill {
        std::uint32_t drawn;
        PixelBox box;
        glm::ivec2 place;  ///< of the box's min corner, in the coverage target
        std::uint32_t paint;
    };
    void bindAsset();
    void execute(const asset::Command& command);
    void fill(const asset::Command& command);
    void flushFills();
    void drawCoverage();
    void clip(std::uint32_t drawn);
    void pop(const asset::Command& command);
    void popMask(const asset::Command& command, const Target& popped);
    void popOver(const asset::Command& command, const Target& popped);
    void popBlend(const asset::Command& command, const Target& popped);

    void drawInstances(const std::vector<std::uint32_t>& drawn);
    void use(const Program& program) const;
    void useFill();
    const Program& useLayer(Action action, const Target& layer);

    Resources& resources_;
    UploadedAsset& asset_;
    asset::View view_;
    std::vector<Target> stack_;
    Target coverage_;
    Shelves shelves_;
    std::vector<PendingFill> pending_;
    std::vector<bool> isPending_;  ///< by drawn mask
};

}  // namespace vtm::gl
