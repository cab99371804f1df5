/* What the qualities cost on this machine: the time of a frame in the best quality, and those of all three
   relative to it. cc quality.c $(pkg-config --cflags --libs openvg) -o quality; ./quality */
#define _POSIX_C_SOURCE 199309L
#include <VG/openvg.h>
#include <VG/vgu.h>
#include <time.h>

#include "offscreen.h"

enum { side = 512, image_side = 2048 };

static VGPath path;
static VGImage image;
static VGfloat scale;

/* Time of all the process's threads, which other programs do not disturb. */
static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

/* A thousand discs, one path: the outlines weigh, not the pixels. */
static void make_path(void) {
    path = vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    for (int i = 0; i < 1024; ++i)
        vguEllipse(path, (VGfloat)(16 * (i % 32) + 8), (VGfloat)(16 * (i / 32) + 8), 14, 14);
}

static void make_image(void) {
    static VGuint row[image_side];
    image =
        vgCreateImage(VG_sRGBX_8888, image_side, image_side,
                      VG_IMAGE_QUALITY_NONANTIALIASED | VG_IMAGE_QUALITY_FASTER | VG_IMAGE_QUALITY_BETTER);
    for (int y = 0; y < image_side; ++y) {
        for (int x = 0; x < image_side; ++x)
            row[x] = (VGuint)((x * 65793) ^ (y * 131)) << 8;
        vgImageSubData(image, row, sizeof row, VG_sRGBX_8888, 0, y, image_side, 1);
    }
}

static void draw_path(void) {
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
    vgLoadIdentity();
    vgRotate(3);
    vgDrawPath(path, VG_FILL_PATH);
}

static void draw_image(void) {
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgLoadIdentity();
    vgTranslate(side / 2, side / 2);
    vgRotate(10);
    vgScale(scale, scale);
    vgTranslate(-image_side / 2, -image_side / 2);
    vgDrawImage(image);
}

/* Milliseconds for each of the settings: the least of several rounds, in which the settings take turns. */
static void measure(const char* what, VGint parameter, const VGint settings[3], void (*draw)(void)) {
    double least[3] = {1e9, 1e9, 1e9};
    for (int round = 0; round < 15; ++round)
        for (int i = 0; i < 3; ++i) {
            vgSeti((VGParamType)parameter, settings[i]);
            draw(); /* what is kept between frames is made now */
            const double start = now();
            for (int frame = 0; frame < 4; ++frame)
                draw();
            vgFinish();
            const double time = (now() - start) * 250;
            least[i] = time < least[i] ? time : least[i];
        }
    require(vgGetError() == VG_NO_ERROR, "OpenVG reports an error");
    printf("%-28s %8.2f ms %6.2f %6.2f %6.2f\n", what, least[2], least[0] / least[2], least[1] / least[2],
           1.0);
}

int main(void) {
    static const VGint rendering[] = {VG_RENDERING_QUALITY_NONANTIALIASED, VG_RENDERING_QUALITY_FASTER,
                                      VG_RENDERING_QUALITY_BETTER};
    static const VGint images[] = {VG_IMAGE_QUALITY_NONANTIALIASED, VG_IMAGE_QUALITY_FASTER,
                                   VG_IMAGE_QUALITY_BETTER};
    open_pbuffer(side, side);
    make_path();
    make_image();
    printf("%-28s %11s %6s %6s %6s\n", "", "BETTER", "NON", "FASTER", "BETTER");
    measure("1024 discs, turned", VG_RENDERING_QUALITY, rendering, draw_path);
    scale = 2;
    measure("an image, twice as large", VG_IMAGE_QUALITY, images, draw_image);
    scale = 0.5f;
    measure("an image, half as large", VG_IMAGE_QUALITY, images, draw_image);
    scale = 0.25f;
    measure("an image, a quarter as large", VG_IMAGE_QUALITY, images, draw_image);
    close_pbuffer();
    return 0;
}
