/* The header is C89. */
#include <vtm/gles.h>

VGboolean presentAll(VtmGl *gl, VtmSurface *surface);

VGboolean presentAll(VtmGl *gl, VtmSurface *surface) {
    VtmGlTarget target = {0, 0, 0, VG_FALSE, VG_FALSE, VG_FALSE, VG_FALSE, NULL, 0};
    return vtmPresentGl(gl, surface, &target);
}
