// Draws with shaders into a texture of its own context.
#include <cstdio>

#include <vtm/gl/context.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/vtm.hpp>

int main(int, char** arguments) try {
    const auto picture = vtm::Picture::load(arguments[1]);
    picture.render({.width = 80, .engine = vtm::Engine::Gl}).save(arguments[2]);
    const vtm::gl::Context context;
    vtm::gl::Texture texture = picture.texture();
    return texture.finestPixel() ? 0 : 2;
} catch (const vtm::gl::GlError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 77;
}
