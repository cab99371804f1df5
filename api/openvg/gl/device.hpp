/// \file
/// The GPU as the compositor sees it: one context for the process, in a thread of its own, which gets what is
/// to be done in order.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "api/openvg/gl/batch.hpp"
#include "api/openvg/gl/painter.hpp"
#include "api/openvg/gl/worker.hpp"

namespace vtm::openvg::gl {

/// All functions may be called in every thread.
class Device {
public:
    /// Opened with the first call. Null if it cannot be, and fault() says why; also of one that is lost.
    static Device* open();
    static const char* fault();

    const Abilities& abilities() const { return abilities_; }
    /// Shaders run on the CPU, as far as the driver's name is known.
    bool isSoftware() const;
    /// Nothing is drawn any more: a program does not compile, the context was lost, GL failed, the process
    /// ends, or it was forked.
    bool isLost() const;

    /// Null where there is no memory for it.
    TexturePointer makeTexture(GLenum format, int width, int height);
    /// Of a context that shares with this one: GL_RGB or GL_RGBA, in eight bits. Deleted here.
    TexturePointer adoptTexture(GLenum format, GLuint name, int width, int height);
    void upload(TexturePointer texture, const Rectangle& part, std::vector<std::uint8_t> bytes);
    /// False if the context is gone.
    bool download(const Texture& texture, const Rectangle& part, std::uint8_t* bytes);
    /// `ramp`: of a gradient. Nothing for no tiles.
    void draw(const Draw& draw, Tiles tiles, Color color = Color(0), const RampRow* ramp = nullptr);

    /// Begins what was asked for, or ends it.
    void flush();
    void finish();

    /// That it was opened with.
    const gles_context::Context& context() const { return context_; }
    /// For contexts that share with this one (class Painter). Null if the context is gone.
    GLsync fence();
    void waitFor(GLsync fence);

private:
    enum class State {
        running,
        failing,  ///< what was drawn can still be read
        gone
    };

    explicit Device(bool mayFetch);
    static Device* make() noexcept;
    void stop();
    /// In the context's thread. What it throws ends the device.
    void post(std::function<void()> job);
    void run(const std::function<void()>& job);
    void guarded(const std::function<void()>& job) noexcept;
    void postBatch();

    std::recursive_mutex mutex_;
    const int process_;
    std::atomic<State> state_ = State::running;
    std::shared_ptr<Discarded> discarded_ = std::make_shared<Discarded>();
    std::unique_ptr<Painter> painter_;  ///< of the worker's thread
    Abilities abilities_;
    gles_context::Context context_;
    std::unique_ptr<Batch> batch_;
    std::unique_ptr<Worker> worker_;
};

}  // namespace vtm::openvg::gl
