// Sections 14 and 15.3: hardware queries and strings.

#include "api/openvg/state/context.hpp"

using namespace vtm::openvg;

VGHardwareQueryResult vgHardwareQuery(VGHardwareQueryType key, VGint setting) {
    return callOr(VG_HARDWARE_UNACCELERATED, [&](Context&) {
        require(key == VG_IMAGE_FORMAT_QUERY || key == VG_PATH_DATATYPE_QUERY);
        if (key == VG_IMAGE_FORMAT_QUERY)
            require(imageFormat(setting).has_value());
        else
            require(setting >= VG_PATH_DATATYPE_S_8 && setting <= VG_PATH_DATATYPE_F);
        return VG_HARDWARE_UNACCELERATED;
    });
}

const VGubyte* vgGetString(VGStringID name) {
    return callOr(static_cast<const VGubyte*>(nullptr), [&](Context& context) {
        const auto text = [](const char* s) { return reinterpret_cast<const VGubyte*>(s); };
        switch (name) {
            case VG_VENDOR:
                return text("VTM");
            case VG_RENDERER:
                return text("VTM vector texture maps");
            case VG_VERSION:
                return text("1.1");
            case VG_EXTENSIONS:
                context.state.knowsExtensions = true;
                return text(
                    "VG_KHR_iterative_average_blur VG_KHR_advanced_blending VG_KHR_parametric_filter "
                    "VG_NDS_paint_generation VG_NDS_projective_geometry VG_KHR_EGL_image");
            default:
                return static_cast<const VGubyte*>(nullptr);
        }
    });
}
