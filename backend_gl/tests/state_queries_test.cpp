// How often a call asks the driver for its state: each question may stop a driver that works on threads of
// its own. This program's functions stand before the driver's of the same names, and count.
#include <dlfcn.h>

#include "asset/testing.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace {

unsigned queries = 0;

template <class Function>
Function* driversOwn(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void glGetIntegerv(GLenum name, GLint* values) {
    static auto* const own = driversOwn<void(GLenum, GLint*)>("glGetIntegerv");
    ++queries;
    own(name, values);
}

void glGetBooleanv(GLenum name, GLboolean* values) {
    static auto* const own = driversOwn<void(GLenum, GLboolean*)>("glGetBooleanv");
    ++queries;
    own(name, values);
}

GLboolean glIsEnabled(GLenum name) {
    static auto* const own = driversOwn<GLboolean(GLenum)>("glIsEnabled");
    ++queries;
    return own(name);
}

GLboolean glIsProgram(GLuint program) {
    static auto* const own = driversOwn<GLboolean(GLuint)>("glIsProgram");
    ++queries;
    return own(program);
}

}  // extern "C"

namespace vtm::gl {
namespace {

using namespace asset::test;

class StateQueries : public Gl {
protected:
    template <class Call>
    static unsigned queriesOf(Call&& call) {
        const unsigned before = queries;
        call();
        return queries - before;
    }
    /// Capabilities differ from driver to driver.
    static unsigned capabilities() { return unsigned(StateContract().capabilities().size()); }
};

TEST_F(StateQueries, AreThoseOfWhatACallTouches) {
    const StateContract contract;
    const auto of = [&](Touched touched) {
        return queriesOf([&] { const StateGuard guard(contract, true, touched); });
    };
    // Transform feedback, draw framebuffer, program (and whether it still is one), vertex array, two buffers,
    // four of unpacking, active unit, texture and sampler of unit 0.
    constexpr unsigned uploads = 14;
    // Read framebuffer, viewport, scissor, colour mask; three more units.
    const unsigned drawing = 4 + 3 * 2 + capabilities();
    constexpr unsigned blending = 6, layers = 2 * 2, reading = 5;
    EXPECT_EQ(of(Touched::uploads()), uploads);
    EXPECT_EQ(of(Touched::picture(false)), uploads + drawing);
    EXPECT_EQ(of(Touched::picture(true)), uploads + drawing + blending);
    EXPECT_EQ(of({}), uploads + drawing + blending + layers + reading);
}

TEST_F(StateQueries, NoneWhereTheCallerRestores) {
    const StateContract contract;
    EXPECT_EQ(queriesOf([&] { const StateGuard guard(contract, false); }), 2u);  // feedback, draw framebuffer
}

TEST_F(StateQueries, OfAPictureAreFew) {
    RendererOptions options;
    options.pixels = Pixels::Shaders;
    Renderer fresh(options);
    const Texture texture = fresh.upload(disc());
    const asset::View view = turnedView(40, 40, {32, 32}, 0.6, 0.3);
    const TextureHandle target = makeTexture(GL_RGBA8, 40, 40);
    const FramebufferHandle framebuffer = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.get(), 0);
    fresh.draw(texture, view, Output());
    const unsigned state = 24 + capabilities();
    // The framebuffer's draw buffers, samples and size.
    const unsigned buffers = unsigned(limit(GL_MAX_DRAW_BUFFERS)), others = 6;
    EXPECT_LE(queriesOf([&] { fresh.draw(texture, view, Output()); }), state + buffers + others);
}

}  // namespace
}  // namespace vtm::gl
