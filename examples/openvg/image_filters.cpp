// A show of image filters: vg_filters OUT.png|window
//
// One image holds the picture and what every filter makes of it, side by side; each is a child image,
// filtered into and drawn like any other. Below, three of them stand on a floor that mirrors them:
// vgDrawImage in perspective.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <VG/openvg.h>
#include <VG/vgu.h>

#include "examples/openvg/lake.hpp"
#include "examples/openvg/paints.hpp"
#include "examples/openvg/stage.hpp"

namespace {

constexpr int width = 960, height = 640;
constexpr int tileWidth = 168, tileHeight = 112, tileGap = 15, margin = 30;
constexpr int pictureWidth = 2 * tileWidth, pictureHeight = 2 * tileHeight;
constexpr VGbitfield anyQuality =
    VG_IMAGE_QUALITY_NONANTIALIASED | VG_IMAGE_QUALITY_FASTER | VG_IMAGE_QUALITY_BETTER;

// ---- Filters ------------------------------------------------------------------------------------------

/// Columns of the matrix: what red, green, blue and alpha give to each channel, and what is added.
void sepia(VGImage dst, VGImage src) {
    const VGfloat matrix[] = {0.42f, 0.35f, 0.26f, 0, 0.72f, 0.62f, 0.47f, 0, 0.14f, 0.12f,
                              0.09f, 0,     0,     0, 0,     1,     0,     0, 0,     0};
    vgColorMatrix(dst, src, matrix);
}

void night(VGImage dst, VGImage src) {
    const VGfloat matrix[] = {0.1f, 0.16f, 0.3f, 0, 0.2f, 0.3f, 0.45f, 0,    0.15f, 0.3f,
                              0.5f, 0,     0,    0, 0,    1,    0,     0.0f, 0.04f, 0};
    vgColorMatrix(dst, src, matrix);
}

void blur(VGImage dst, VGImage src) { vgGaussianBlur(dst, src, 5, 5, VG_TILE_PAD); }

/// The slope towards the upper left, about a middle grey.
void emboss(VGImage dst, VGImage src) {
    const VGfloat grey[] = {0.3f,  0.3f, 0.3f, 0, 0.59f, 0.59f, 0.59f, 0, 0.11f, 0.11f,
                            0.11f, 0,    0,    0, 0,     1,     0,     0, 0,     0};
    const VGshort kernel[] = {-2, -1, 0, -1, 0, 1, 0, 1, 2};
    const VGImage tones = vgCreateImage(VG_sRGBA_8888, pictureWidth, pictureHeight, anyQuality);
    vgColorMatrix(tones, src, grey);
    vgCopyImage(dst, 0, 0, src, 0, 0, pictureWidth, pictureHeight, VG_FALSE);
    vgSeti(VG_FILTER_CHANNEL_MASK, VG_RED | VG_GREEN | VG_BLUE);  // alpha stays as it is in dst
    vgConvolve(dst, tones, 3, 3, 1, 1, kernel, 1, 0.5f, VG_TILE_PAD);
    vgSeti(VG_FILTER_CHANNEL_MASK, VG_RED | VG_GREEN | VG_BLUE | VG_ALPHA);
    vgDestroyImage(tones);
}

/// Six tones a channel.
void posterise(VGImage dst, VGImage src) {
    VGubyte tones[256], same[256];
    for (int i = 0; i < 256; ++i) {
        tones[i] = VGubyte(i * 6 / 256 * 51);
        same[i] = VGubyte(i);
    }
    vgLookup(dst, src, tones, tones, tones, same, VG_FALSE, VG_FALSE);
}

/// A box as wide as there may be, and one pixel high.
void motion(VGImage dst, VGImage src) {
    const VGint size = std::min(41, vgGeti(VG_MAX_SEPARABLE_KERNEL_SIZE));
    const std::vector<VGshort> along(std::size_t(size), 1);
    const VGshort across[] = {1};
    vgSeparableConvolve(dst, src, size, 1, size / 2, 0, along.data(), across, 1 / VGfloat(size), 0,
                        VG_TILE_PAD);
}

/// Heat for brightness, of which green is a fair measure.
void heat(VGImage dst, VGImage src) {
    constexpr double glow[5][3] = {{5, 3, 30}, {95, 20, 110}, {200, 55, 75}, {250, 145, 25}, {255, 255, 190}};
    VGuint colors[256];
    for (int i = 0; i < 256; ++i) {
        const double place = i * 4 / 255.0;
        const int below = std::min(int(place), 3);
        colors[i] = 0xff;
        for (int channel = 0; channel < 3; ++channel)
            colors[i] |= VGuint(std::lerp(glow[below][channel], glow[below + 1][channel], place - below))
                         << (24 - 8 * channel);
    }
    vgLookupSingle(dst, src, colors, VG_GREEN, VG_FALSE, VG_FALSE);
}

/// Dots on a slanted grid, larger where the picture is darker, as an image of alpha alone.
VGImage halftone(const std::vector<std::uint32_t>& picture) {
    std::vector<VGubyte> alpha;
    for (int y = 0; y < pictureHeight; ++y)
        for (int x = 0; x < pictureWidth; ++x) {
            const std::uint32_t p = picture[std::size_t(y * pictureWidth + x)];
            const double light = (0.3 * (p >> 24) + 0.59 * (p >> 16 & 0xff) + 0.11 * (p >> 8 & 0xff)) / 255;
            const double u = (x + y) * 0.4, v = (x - y) * 0.4;  // a period is 2π
            const double hill = (std::cos(u) + std::cos(v) + 2) / 4;
            alpha.push_back(VGubyte(std::clamp((hill - light) * 6 + 0.5, 0.0, 1.0) * 255));
        }
    const VGImage image = vgCreateImage(VG_A_8, pictureWidth, pictureHeight, anyQuality);
    vgImageSubData(image, alpha.data(), pictureWidth, VG_A_8, 0, 0, pictureWidth, pictureHeight);
    return image;
}

// ---- The sheet ----------------------------------------------------------------------------------------

using Filter = void (*)(VGImage dst, VGImage src);
constexpr Filter filters[] = {nullptr, sepia, night, blur, emboss, posterise, motion, heat};
constexpr int children = int(std::size(filters));

/// Child 0 is the picture, the others what the filters make of it.
std::vector<VGImage> makeChildren(const std::vector<std::uint32_t>& picture) {
    const VGImage sheet = vgCreateImage(VG_sRGBA_8888, children * pictureWidth, pictureHeight, anyQuality);
    std::vector<VGImage> images;
    for (int i = 0; i < children; ++i)
        images.push_back(vgChildImage(sheet, i * pictureWidth, 0, pictureWidth, pictureHeight));
    vgDestroyImage(sheet);  // lives as long as its children
    vgImageSubData(images[0], picture.data(), pictureWidth * 4, VG_sRGBA_8888, 0, 0, pictureWidth,
                   pictureHeight);
    for (int i = 1; i < children; ++i)
        filters[i](images[std::size_t(i)], images[0]);
    return images;
}

// ---- Tiles --------------------------------------------------------------------------------------------

void setFill(VGPaint paint) {
    vgSetPaint(paint, VG_FILL_PATH);
    vgDestroyPaint(paint);
}

VGPath rectangle(VGfloat x, VGfloat y, VGfloat w, VGfloat h) {
    const VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_APPEND_TO);
    vguRect(path, x, y, w, h);
    return path;
}

void fillRectangle(VGfloat x, VGfloat y, VGfloat w, VGfloat h, VGPaint paint) {
    const VGPath path = rectangle(x, y, w, h);
    paints::fillOnce(path, paint);
    vgDestroyPath(path);
}

/// Place `index` counts row by row from the upper left. Paints are in the picture's pixels, too.
void drawTile(int index, VGImage image, VGImageMode mode = VG_DRAW_IMAGE_NORMAL) {
    const int x = margin + index % 5 * (tileWidth + tileGap);
    const int y = height - margin - tileHeight - index / 5 * (tileHeight + tileGap);
    fillRectangle(VGfloat(x - 3), VGfloat(y - 3), tileWidth + 6, tileHeight + 6, paints::solid(0xf4efe6ff));
    if (mode != VG_DRAW_IMAGE_NORMAL)
        setFill(mode == VG_DRAW_IMAGE_MULTIPLY
                    ? paints::radial(120, 150, 120, 150, 250,
                                     {{0, 0xffffffff}, {0.35f, 0xfff0d0ff}, {1, 0x30207040}})
                    : paints::linear(0, 0, pictureWidth, pictureHeight, {{0, 0x0b3d91ff}, {1, 0xd7263dff}}));
    vgSeti(VG_IMAGE_MODE, mode);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgLoadIdentity();
    vgTranslate(VGfloat(x), VGfloat(y));
    vgScale(0.5f, 0.5f);
    vgDrawImage(image);
    vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_NORMAL);
}

// ---- The floor ----------------------------------------------------------------------------------------

/// A panel that stands on the floor, its lower and upper edge at the left and at the right.
struct Panel {
    VGfloat left, leftFoot, leftTop, right, rightFoot, rightTop;
};

void loadWarp(const Panel& p, VGfloat rise) {
    VGfloat warp[9];
    vguComputeWarpQuadToQuad(p.left, p.leftFoot, p.right, p.rightFoot, p.right,
                             p.rightFoot + rise * (p.rightTop - p.rightFoot), p.left,
                             p.leftFoot + rise * (p.leftTop - p.leftFoot), 0, 0, pictureWidth, 0,
                             pictureWidth, pictureHeight, 0, pictureHeight, warp);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgLoadMatrix(warp);
}

/// In perspective paint is not multiplied with images (specification 10.8), so the mask fades what the floor
/// mirrors.
void setFadingMask(VGint top) {
    std::vector<VGubyte> rows;
    for (VGint y = 0; y < top; ++y)
        rows.push_back(VGubyte(std::max(0.0, 110.0 * y / top)));
    const VGImage column = vgCreateImage(VG_A_8, width, top, anyQuality);
    for (VGint y = 0; y < top; ++y) {
        const std::vector<VGubyte> row(width, rows[std::size_t(y)]);
        vgImageSubData(column, row.data(), width, VG_A_8, 0, y, width, 1);
    }
    vgMask(column, VG_SET_MASK, 0, 0, width, top);
    vgDestroyImage(column);
}

void drawPanel(const Panel& panel, VGImage image) {
    const VGImage blurred = vgCreateImage(VG_sRGBA_8888, pictureWidth, pictureHeight, anyQuality);
    vgGaussianBlur(blurred, image, 2.5f, 1.2f, VG_TILE_PAD);
    vgSeti(VG_MASKING, VG_TRUE);
    loadWarp(panel, -1);
    vgDrawImage(blurred);
    vgSeti(VG_MASKING, VG_FALSE);
    vgDestroyImage(blurred);
    loadWarp(panel, 1);
    vgDrawImage(image);
}

}  // namespace

int main(int argc, char** argv) {
    return stage::run([&] {
        if (argc != 2)
            throw std::runtime_error("usage: vg_filters OUT.png|window");
        const auto stage = stage::open(argv[1], width, height, "Image filters");
        const std::vector<std::uint32_t> picture = lake::picture(pictureWidth, pictureHeight);
        const std::vector<VGImage> images = makeChildren(picture);
        const VGImage dots = halftone(picture);
        vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_BETTER);
        setFadingMask(130);
        stage->show(0, [&](double) {
            fillRectangle(
                0, 0, width, height,
                paints::linear(
                    0, 0, 0, height,
                    {{0, 0x0d1017ff}, {0.195f, 0x2a303bff}, {0.205f, 0x171b23ff}, {1, 0x3b4352ff}}));
            for (int i = 0; i < children; ++i)
                drawTile(i, images[std::size_t(i)]);
            drawTile(8, images[0], VG_DRAW_IMAGE_MULTIPLY);
            drawTile(9, dots, VG_DRAW_IMAGE_STENCIL);
            drawPanel({60, 118, 290, 300, 104, 318}, images[5]);
            drawPanel({660, 104, 318, 900, 118, 290}, images[7]);
            drawPanel({330, 92, 292, 630, 92, 292}, images[0]);
        });
        for (const VGImage image : images)
            vgDestroyImage(image);
        vgDestroyImage(dots);
    });
}
