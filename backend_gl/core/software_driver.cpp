#include "backend_gl/core/software_driver.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include <glm/vec4.hpp>

#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/program.hpp"
#include "backend_gl/core/shader_text.hpp"
#include "gles_context/renderer_name.hpp"

namespace vtm::gl {

namespace {

/// The work: turns of a loop over four floats, for each pixel of a square. One core does a share of them.
constexpr int side = 128, turns = 256, shareOfWork = 64;
/// The least of some times is free of what else the machine does.
constexpr int attempts = 4;

double cpuMilliseconds() { return double(std::clock()) * 1e3 / CLOCKS_PER_SEC; }

template <class Work>
double leastTime(Work&& work) {
    double least = HUGE_VAL;
    for (int i = 0; i < attempts; ++i) {
        const double start = cpuMilliseconds();
        work();
        least = std::min(least, cpuMilliseconds() - start);
    }
    return least;
}

/// Chaotic, so that it has to be computed.
glm::vec4 iterated(glm::vec4 v, int count) {
    for (int i = 0; i < count; ++i)
        v = 3.7f * v * (1.0f - v);
    return v;
}

double timeShare() {
    volatile float start = 0.3f, result = 0;
    return leastTime([&] {
        const glm::vec4 v = iterated(glm::vec4(start, 0.4f, 0.5f, 0.6f), side * side * turns / shareOfWork);
        result = v.x + v.y + v.z + v.w;
    });
}

}  // namespace

/// What drawing takes by itself, whatever is drawn, is subtracted.
WorkTimes timeWork() {
    const Program program({"work", {shaders::screen_vertex}, {shaders::work_fragment}});
    const TextureHandle texture = makeTexture(GL_RGBA8, side, side);
    const FramebufferHandle framebuffer = makeFramebuffer();
    const VertexArrayHandle array = makeVertexArray();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.get(), 0);
    glViewport(0, 0, side, side);
    glBindVertexArray(array.get());
    program.use();
    const auto draw = [&](int count) {
        glUniform1i(program.uniform("turns"), count);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glFinish();
    };
    draw(1);  // drivers finish compiling with the first drawing
    const double nothing = leastTime([&] { draw(1); }), all = leastTime([&] { draw(turns); });
    checkErrors("timing the driver");
    return {all - nothing, timeShare()};
}

/// A core does four floats at once, or one where compilers do not find that out; a driver on the CPU at most
/// 16, which takes 4 to 16 times as long as the share. What a driver of a GPU does on the CPU does not grow
/// with the work, unless it waits in a loop: some microseconds.
bool isCpuWork(const WorkTimes& times) { return times.drawing > times.share; }

bool isSoftwareDriver(std::string_view renderer) {
    if (const std::optional<bool> known = gles_context::isSoftwareName(renderer))
        return *known;
    static std::mutex mutex;
    static std::map<std::string, bool, std::less<>> timed;
    const std::lock_guard lock(mutex);
    auto found = timed.find(renderer);
    if (found == timed.end())
        found = timed.emplace(renderer, isCpuWork(timeWork())).first;
    return found->second;
}

bool isSoftwareDriver() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return isSoftwareDriver(name == nullptr ? "" : name);
}

bool drawsOnCpu(Pixels pixels) {
    return pixels == Pixels::Scanned || (pixels == Pixels::Automatic && isSoftwareDriver());
}

}  // namespace vtm::gl
