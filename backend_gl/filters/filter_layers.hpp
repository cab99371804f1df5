/// \file
/// The layers that a filter works on, on the GPU, and the passes that make one from others.
#pragma once

#include <optional>

#include <glm/vec4.hpp>

#include "backend_gl/core/programs.hpp"
#include "backend_gl/output/target.hpp"
#include "backend_gl/upload/upload.hpp"
#include "raster/filter_place.hpp"

namespace vtm::gl {

/// Premultiplied colours of the pixels of a box of a filter's raster, transparent beyond it: in linear light
/// or sRGB-encoded, in steps of 1/65535. GLES 3.0 draws into such textures without an extension.
struct FilterLayer {
    Target target;  ///< none where the box is empty
    PixelBox box;
    bool linear = false;

    bool empty() const { return box.empty(); }
};

class FilterLayers {
public:
    FilterLayers(Programs& programs, TargetPool& pool, const UploadedAsset& asset)
        : programs_(programs), pool_(pool), asset_(asset) {}

    FilterLayer make(const PixelBox& box, bool linear);
    void giveBack(FilterLayer&& layer);

    /// One program on a layer that is made by it.
    class Pass {
    public:
        GLint uniform(const char* name) const { return program_->uniform(name); }
        Pass& first(const FilterLayer& layer) { return input(layer, Unit::Layer, "firstBox"); }
        Pass& second(const FilterLayer& layer) { return input(layer, Unit::Backdrop, "secondBox"); }
        /// The parameters that the program reads.
        Pass& numbers(const asset::FilterPrimitive& primitive);
        /// What of the result stays; else all.
        Pass& cut(const asset::PixelRect& to);
        /// A box of the raster, in the result's pixels.
        Pass& box(const char* name, const PixelBox& box);
        void draw();

    private:
        friend class FilterLayers;
        Pass(const Program& program, const UploadedAsset& asset, const FilterLayer& result);
        Pass& input(const FilterLayer& layer, Unit unit, const char* box);

        const Program* program_;
        const UploadedAsset* asset_;
        const FilterLayer* result_;
    };
    /// `result` is not empty.
    Pass pass(FilterProgram program, const FilterLayer& result, FilterVariant variant = 0) {
        return {programs_.filter(program, variant), asset_, result};
    }

    Programs& programs() { return programs_; }

private:
    Programs& programs_;
    TargetPool& pool_;
    const UploadedAsset& asset_;
};

}  // namespace vtm::gl
