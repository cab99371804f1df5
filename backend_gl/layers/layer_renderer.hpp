/// \file
/// Running the commands of an asset, in compat mode or with filters, under one view that fits a target.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/output/boxes.hpp"
#include "backend_gl/output/target.hpp"
#include "backend_gl/tiles/picture.hpp"
#include "backend_gl/upload/upload.hpp"
#include "raster/filter_place.hpp"

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
    PictureBuffers picture;
};

class LayerRenderer {
public:
    /// The view is invertible; GL is in the state of StateGuard. `format`: of the pictures, 0: floats.
    LayerRenderer(Resources& resources, UploadedAsset& asset, const asset::View& view, GLenum format,
                  bool markOverruns);

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
    /// One of the stack. Nothing is drawn into one that has no pixels.
    struct Picture {
        asset::View view;
        Target target;
        /// Of an input of a filter: where that works, and the input's number.
        std::shared_ptr<const asset::FilterPlace> place = nullptr;
        std::uint32_t filter = 0, number = 0;

        bool empty() const { return view.width == 0 || view.height == 0; }
    };

    Picture& top() { return stack_.back(); }
    void push(asset::View view);
    void pushInput(std::uint32_t filter);
    void filter(const asset::Filter& filter);
    void drawMap(Atlas& atlas);
    void giveBack(Picture&& picture);
    /// After each change of the stack: the viewport, and room for coverage.
    void enterTop();
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
    GLenum format_;
    bool markOverruns_;
    std::vector<Picture> stack_;
    Target coverage_;  ///< as large as the picture on top
    Shelves shelves_;
    std::size_t nextAtlas_ = 0;
    std::vector<PendingFill> pending_;
    std::vector<bool> isPending_;  ///< by drawn mask
};

}  // namespace vtm::gl
