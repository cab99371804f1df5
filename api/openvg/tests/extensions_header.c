/* vgext.h is plain C89. */
#include <VG/vgext.h>
#include <vtm/vg.h>

VGint extensionValuesInC(void);

VGint extensionValuesInC(void) {
    VGBlendModeKHR mode = VG_BLEND_XOR_KHR;
    return (VGint)mode;
}
