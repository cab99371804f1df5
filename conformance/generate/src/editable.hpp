/// \file
/// A scene whose parts can be changed one by one: nothing is shared with any other scene.
#pragma once

#include <vector>

#include <vtm/scene/scene.hpp>

namespace vtm::generate {

/// A copy of a scene and where its parts stand in it, in the order of painting. Masks and patterns are
/// kept as they are.
class Editable {
public:
    explicit Editable(const scene::Scene& original) : scene(original) { visit(scene.root); }
    Editable(const Editable&) = delete;
    Editable& operator=(const Editable&) = delete;

    scene::Scene scene;
    std::vector<scene::Group*> groups;
    std::vector<scene::Item*> items;
    std::vector<scene::Clip*> clips;
    std::vector<scene::Path*> paths;  ///< of items and clips

private:
    using SharedPath = std::shared_ptr<const scene::Path>;
    using SharedClip = std::shared_ptr<const scene::Clip>;

    void visit(scene::Group& group) {
        groups.push_back(&group);
        visit(group.clip);
        for (scene::Node& node : group.children) {
            if (auto* child = std::get_if<scene::Group>(&node.value)) {
                visit(*child);
                continue;
            }
            auto& item = std::get<scene::Item>(node.value);
            items.push_back(&item);
            visit(item.path);
        }
    }
    void visit(SharedClip& shared) {
        if (!shared)
            return;
        auto clip = std::make_shared<scene::Clip>(*shared);
        shared = clip;
        clips.push_back(clip.get());
        visit(clip->clip);
        for (scene::ClipShape& shape : clip->shapes) {
            visit(shape.path);
            visit(shape.clip);
        }
    }
    void visit(SharedPath& shared) {
        auto path = std::make_shared<scene::Path>(*shared);
        shared = path;
        paths.push_back(path.get());
    }
};

}  // namespace vtm::generate
