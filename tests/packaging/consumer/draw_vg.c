#include <VG/openvg.h>
#include <vtm/vg.h>

int main(void) {
    VtmSurfaceFormat format = {8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE};
    VtmSurface *surface = vtmCreateSurface(8, 8, &format);
    VtmContext *context = vtmCreateContext(NULL);
    unsigned char pixels[8 * 8 * 4];
    const VGfloat red[4] = {1, 0, 0, 1};
    vtmMakeCurrent(context, surface);
    vgSetfv(VG_CLEAR_COLOR, 4, red);
    vgClear(0, 0, 8, 8);
    vtmReadSurface(surface, pixels, 8 * 4);
    return vgGetError() == VG_NO_ERROR && pixels[3] == 255 ? 0 : 1;
}
