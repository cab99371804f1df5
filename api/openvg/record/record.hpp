/// \file
/// Calls as a scene: what vtmBeginRecording() puts in a context. Layers of OpenVG are items of the scene, cut
/// by clips where scissoring and masking cut them; docs/openvg.md says what that changes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "api/openvg/image/pixels.hpp"
#include "api/openvg/record/record_mask.hpp"
#include "api/openvg/record/record_paint.hpp"
#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

class Recorder {
public:
    Recorder(double width, double height);

    // What the functions of the API do while there is a recorder. Arguments are legal.

    void drawPath(const State& state, const Path& path, VGbitfield modes, const glm::mat3& toSurface);
    void drawImage(const State& state, const Image& image, const glm::mat3& toSurface);
    /// vgSetPixels and vgWritePixels: a part of an image.
    void setPixels(const State& state, const Image& image, const CopyArea& area);
    /// Of surface pixels [x, x + width) × [y, y + height).
    void clear(const State& state, int x, int y, int width, int height);

    void renderToMask(const State& state, const Path& path, VGbitfield modes, VGMaskOperation operation);
    /// vgMask: `layer` is null where the operation takes none.
    void mask(const MaskLayer* layer, VGMaskOperation operation, const CopyArea& area);
    /// vgMask with an image: its values.
    void mask(const MaskValues& values, VGMaskOperation operation, const CopyArea& area);
    void fillMaskLayer(const MaskLayer& layer, const CopyArea& area, float value);
    void copyMask(const MaskLayer& layer, const CopyArea& area);

    /// Throws Error(VTM_NOT_RECORDABLE_ERROR). The first one is kept: "call 12: ...".
    [[noreturn]] void refuse(const std::string& why);
    /// Empty if nothing was refused.
    const std::string& fault() const { return fault_; }

    scene::Scene finish();

private:
    /// What cuts a layer: nothing, or one object for all layers that are cut alike.
    struct Cut {
        std::vector<VGint> rectangles;  ///< of scissoring
        bool isScissored = false;
        RecordedMask mask;
        friend bool operator==(const Cut&, const Cut&) = default;
        bool isNone() const { return !isScissored && mask == RecordedMask{}; }
    };
    Cut cutOf(const State& state) const;

    void refuseClipLines(const State& state);
    scene::Affine toPicture(const glm::mat3& toSurface);
    bool covers(const CopyArea& area) const;
    scene::Shape writtenShape(const State& state, int x, int y, int width, int height) const;
    /// What an image draws in the state's mode.
    scene::Node imageNode(const State& state, const Image& image, const scene::Shape& shape);
    void put(scene::Node node, const scene::Shape& shape);
    void draw(const State& state, scene::Node node, const scene::Shape& shape);
    void lay(scene::Node node, scene::BlendMode blend, const Cut& cut);
    void layBelow(scene::Node node, const Cut& cut);
    /// Puts it in the place of what is there.
    void replace(scene::Node node, const scene::Shape& shape);
    scene::Group groupOf(scene::Node node, const Cut& cut) const;
    void combineValues(const MaskValues& values, VGMaskOperation operation, const CopyArea& area);
    void combine(VGMaskOperation operation, const RecordedMask& other);

    const double width_, height_;
    const scene::Affine flip_;  ///< surface, y upwards, to picture
    const std::shared_ptr<const scene::Path> picture_;
    scene::Group root_;
    bool isPlain_ = true;  ///< all of root_ is laid over what is below
    Cut lastCut_;          ///< of root_'s last child, if it is a group that more may join; else none
    Bitmaps bitmaps_;
    RecordedMask mask_;
    std::map<VGHandle, RecordedMask> layers_;  ///< those that were written since the beginning
    long calls_ = 0;
    std::string fault_;
};

}  // namespace vtm::openvg
