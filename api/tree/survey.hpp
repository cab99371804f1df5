/// \file
/// What the writer of .vtmtree files must know of a tree before it writes: which parts occur several times.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include <vtm/authoring.hpp>

namespace vtm {

/// One layer of a chain in painter's order: `top` in the mask, if there is one, composited with `below`.
struct ChainLayer {
    const Mask* mask;
    const Vtm* top;
    const Compositing* how;
    const Vtm* below;
};

class TreeSurvey {
public:
    explicit TreeSurvey(const Vtm& root);

    /// The nodes that get names, each behind those that it contains; likewise clips. Shapes and bitmaps that
    /// occur several times.
    const std::vector<const VtmNode*>& namedNodes() const { return namedNodes_; }
    const std::vector<const scene::Clip*>& clips() const { return clips_; }
    const std::vector<const scene::Path*>& sharedPaths() const { return paths_.shared; }
    const std::vector<const image::Bitmap*>& sharedBitmaps() const { return bitmaps_.shared; }

    bool isNamed(const VtmNode* node) const;
    /// Of a layer, and of select(m, layer(X, T), T), which is layer(select(m, X), T) of the chain T.
    std::optional<ChainLayer> chainLayer(const VtmNode& node) const;
    /// Contents of masks and patterns as VTMs.
    const Vtm& content(const std::shared_ptr<const scene::Group>& group) const;

private:
    struct Info {
        std::size_t uses = 0;
        int height = 0;  ///< operands in each other, as written; 0 where the node has a name
        bool isNamed = false, isDone = false;
    };
    /// A part that is written as an operand of a node, `levels` further in.
    struct Operand {
        const VtmNode* node;
        int levels;
    };
    template <class Part>
    struct Counts {
        std::unordered_map<const Part*, std::size_t> uses;
        std::vector<const Part*> shared;  ///< in the order of their second use
        void add(const Part* part) {
            if (++uses[part] == 2)
                shared.push_back(part);
        }
    };

    void addContents(const VtmNode& node);
    void addContent(const std::shared_ptr<const scene::Group>& group);
    std::vector<const VtmNode*> parts(const VtmNode& node) const;
    std::vector<Operand> operands(const VtmNode& node) const;
    void countParts(const VtmNode* root);
    void countOperands(const VtmNode* root);
    void addShapes(const VtmNode& node);
    void addClip(const std::shared_ptr<const scene::Clip>& clip);
    void order(const VtmNode* root);
    void finish(const VtmNode& node);
    void name(const VtmNode* node);

    std::unordered_map<const VtmNode*, std::size_t> parents_;
    std::unordered_map<const VtmNode*, Info> infos_;
    std::unordered_map<const scene::Group*, Vtm> contents_;
    std::unordered_map<const scene::Clip*, bool> clipsDone_;
    std::vector<const VtmNode*> namedNodes_;
    std::vector<const scene::Clip*> clips_;
    Counts<scene::Path> paths_;
    Counts<image::Bitmap> bitmaps_;
};

}  // namespace vtm
