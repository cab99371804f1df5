/// \file
/// A scene (vtm/scene/scene.hpp) as objects of OpenVG: a VGPath for every path, a VGPaint for every item,
/// made once and drawn under any matrix.
#pragma once

#include <map>

#include <VG/openvg.h>

#include <vtm/scene/scene.hpp>

namespace drawing {

/// Needs a current context, for its whole life. Clips become masks, a group's opacity scales the alpha of
/// what is in it. OpenVG has no word for isolated groups, a group's mask, blend modes of groups, selections,
/// or paints that are patterns, pictures or materials: they are left out, and counted.
class Drawing {
public:
    explicit Drawing(vtm::scene::Scene scene);
    ~Drawing();
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    double width() const { return scene_.width; }
    double height() const { return scene_.height; }
    int paths() const { return int(paths_.size()); }
    int leftOut() const { return leftOut_; }

    /// `toSurface` maps the scene, whose y runs down, to the surface of the given size. Uses
    /// its mask.
    void draw(const vtm::scene::Affine& toSurface, int surfaceWidth, int surfaceHeight);

private:
    void prepare(const vtm::scene::Group& group);
    void prepareClip(const vtm::scene::Clip* clip);
    VGPath pathOf(const std::shared_ptr<const vtm::scene::Path>& path);
    VGPaint paintOf(const vtm::scene::Paint& paint);

    void drawGroup(const vtm::scene::Group& group, float opacity);
    void drawItem(const vtm::scene::Item& item, float opacity);
    void intersectMask(const vtm::scene::Clip& clip);

    vtm::scene::Scene scene_;
    vtm::scene::Clip frame_;  ///< what lies outside the scene's rectangle is cut off
    std::map<const vtm::scene::Path*, VGPath> paths_;
    std::map<const vtm::scene::Item*, VGPaint> paints_;
    int leftOut_ = 0;
    vtm::scene::Affine toSurface_ = vtm::scene::identity;
    int surfaceWidth_ = 0, surfaceHeight_ = 0;
};

}  // namespace drawing
