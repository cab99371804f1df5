// OpenVG in a program that draws with OpenGL ES: vg_in_gles DRAWING.svg OUT.png
//
// The program has a context of its own, here one without a window, and a framebuffer. It draws its own
// picture there, and over it what OpenVG drew in memory, and a recording, turned and at several sizes, by
// shaders.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include <GLES3/gl3.h>
#include <VG/vgu.h>
#include <vtm/gles.h>

#include <vtm/gl/context.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>
#include "examples/openvg/drawing.hpp"
#include "examples/openvg/paints.hpp"

using namespace vtm;

namespace {

constexpr int width = 960, height = 540;
constexpr int panelWidth = 260, panelHeight = 92;

void require(bool condition, const std::string& otherwise) {
    if (!condition)
        throw std::runtime_error(otherwise);
}

/// The program's own drawing: stripes, cleared one by one.
void drawStripes() {
    glEnable(GL_SCISSOR_TEST);
    for (int i = 0; i < 12; ++i) {
        glScissor(i * width / 12, 0, width / 12, height);
        const float light = i % 2 == 0 ? 0.22f : 0.26f;
        glClearColor(light, light + 0.03f, light + 0.1f, 1);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    glDisable(GL_SCISSOR_TEST);
}

/// With OpenVG, in memory: a translucent panel and a bar of dots.
void drawPanel() {
    const VGfloat clear[] = {0, 0, 0, 0};
    vgSetfv(VG_CLEAR_COLOR, 4, clear);
    vgClear(0, 0, panelWidth, panelHeight);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
    vgLoadIdentity();
    const VGPath panel =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    vguRoundRect(panel, 2, 2, panelWidth - 4, panelHeight - 4, 36, 36);
    paints::fillOnce(panel, paints::solid(0xFFFFFF30));
    paints::strokeOnce(panel, paints::solid(0xFFFFFFFF), 3);
    vgClearPath(panel, VG_PATH_CAPABILITY_ALL);
    for (int i = 0; i < 6; ++i)
        vguEllipse(panel, VGfloat(45 + 34 * i), panelHeight / 2, 22, 22);
    paints::fillOnce(panel, paints::solid(0x4CD6A4FF));
    vgDestroyPath(panel);
}

using Recording = std::unique_ptr<VtmRecording, decltype(&vtmDestroyRecording)>;
using Gl = std::unique_ptr<VtmGl, decltype(&vtmDestroyGl)>;
using Picture = std::unique_ptr<VtmGlPicture, decltype(&vtmDestroyPictureGl)>;

Recording record(const std::string& file) {
    svg::Options options;
    options.fileName = file;
    drawing::Drawing drawing(svg::load(image::readFile(file), options).scene);
    vtmBeginRecording(VGfloat(drawing.width()), VGfloat(drawing.height()));
    drawing.draw({1, 0, 0, -1, 0, drawing.height()}, int(drawing.width()) + 1, int(drawing.height()) + 1);
    Recording recording(vtmEndRecording(), vtmDestroyRecording);
    require(recording != nullptr, vtmGetRecordingFault());
    return recording;
}

/// The picture's middle at a place of the framebuffer, `size` pixels along its longer side.
std::array<VGfloat, 9> placed(const VtmRecording* recording, float x, float y, float size, float turn) {
    const float w = vtmRecordingWidth(recording), h = vtmRecordingHeight(recording);
    const float c = size / std::max(w, h) * std::cos(turn), s = size / std::max(w, h) * std::sin(turn);
    return {c, s, 0, -s, c, 0, x - (c * w - s * h) / 2, y - (s * w + c * h) / 2, 1};
}

image::Bitmap read() {
    image::Bitmap picture{width, height, {}};
    picture.rgba.resize(std::size_t(width) * height * 4);
    for (int y = 0; y < height; ++y)
        glReadPixels(0, height - 1 - y, width, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                     &picture.rgba[std::size_t(y) * width * 4]);
    return picture;
}

void draw(const std::string& file, const std::string& output) {
    const gl::Context context;
    GLuint texture = 0, framebuffer = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width, height);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    drawStripes();

    const VtmSurfaceFormat format = {8, 8, 8, 8, 0, 8, VG_FALSE, VG_TRUE};
    VtmSurface* const surface = vtmCreateSurface(panelWidth, panelHeight, &format);
    VtmContext* const vg = vtmCreateContext(nullptr);
    vtmMakeCurrent(vg, surface);
    const Recording recording = record(file);
    drawPanel();

    const Gl gl(vtmCreateGl(), vtmDestroyGl);
    require(gl != nullptr, vtmGetGlFault());
    const Picture picture(vtmUploadRecordingGl(gl.get(), recording.get()), vtmDestroyPictureGl);
    require(picture != nullptr, vtmGetGlFault());
    VtmGlTarget target{};
    target.framebuffer = framebuffer;
    target.over = VG_TRUE;
    const std::array<VGfloat, 9> places[] = {placed(recording.get(), 300, 270, 420, 0.12f),
                                             placed(recording.get(), 700, 330, 240, -0.2f),
                                             placed(recording.get(), 880, 150, 90, 0.5f)};
    for (const std::array<VGfloat, 9>& place : places)
        require(vtmDrawPictureGl(gl.get(), picture.get(), width, height, place.data(), &target),
                vtmGetGlFault());
    target.x = 580;
    target.y = 30;
    require(vtmPresentGl(gl.get(), surface, &target), vtmGetGlFault());
    image::writeFile(output, image::encodePng(read()));

    vtmMakeCurrent(nullptr, nullptr);
    vtmDestroyContext(vg);
    vtmDestroySurface(surface);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
}

}  // namespace

int main(int argc, char** argv) try {
    require(argc == 3, "usage: vg_in_gles DRAWING.svg OUT.png");
    draw(argv[1], argv[2]);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
