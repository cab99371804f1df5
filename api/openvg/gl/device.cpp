#include "api/openvg/gl/device.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include <unistd.h>

#include "gles_context/renderer_name.hpp"

namespace vtm::openvg::gl {

namespace {

/// Why there is no device, or no longer one: the first reason.
class Fault {
public:
    void set(const char* text) {
        if (isSet_)
            return;
        text_ = text;
        isSet_ = true;
    }
    const char* text() const { return isSet_ ? text_.c_str() : ""; }

private:
    std::atomic<bool> isSet_ = false;
    std::string text_;  ///< read by others once `isSet_`
};
Fault& fault() {
    static auto& fault = *new Fault;
    return fault;
}

/// For tests of what other drivers do.
bool isFetchAllowed() {
    const char* const value = std::getenv("VTM_OPENVG_COMPOSITOR");
    return !value || std::string_view(value) != "gl-copy";
}

}  // namespace

Device::Device(bool mayFetch) : process_(getpid()), worker_(std::make_unique<Worker>()) {
    worker_->run([&] { painter_ = std::make_unique<Painter>(discarded_, mayFetch); });
    abilities_ = painter_->abilities();
    context_ = painter_->context();
    batch_ = std::make_unique<Batch>(abilities_.fetches);
}

Device* Device::make() noexcept {
    try {
        static Device* device = nullptr;
        device = new Device(isFetchAllowed());
        // After the driver's own, so before them: it shall be idle when it is taken down.
        std::atexit([] { device->stop(); });
        return device;
    } catch (const std::exception& error) {
        gl::fault().set(error.what());
        return nullptr;
    }
}

Device* Device::open() {
    static Device* const device = make();
    return device;
}

const char* Device::fault() { return gl::fault().text(); }

bool Device::isSoftware() const { return gles_context::isSoftwareName(abilities_.renderer).value_or(false); }

bool Device::isLost() const { return state_ != State::running || getpid() != process_; }

void Device::stop() {
    if (getpid() != process_)
        return;
    const std::lock_guard lock(mutex_);
    batch_ = std::make_unique<Batch>(abilities_.fetches);
    state_ = State::gone;
    worker_->run([&] { painter_ = nullptr; });
    worker_ = nullptr;
}

void Device::guarded(const std::function<void()>& job) noexcept {
    if (state_ == State::gone)
        return;
    try {
        job();
        painter_->check();
    } catch (const ProgramError& error) {
        gl::fault().set(error.what());
        state_ = State::failing;
    } catch (const std::exception& error) {
        gl::fault().set(error.what());
        state_ = State::gone;
    }
}

void Device::post(std::function<void()> job) {
    worker_->post([this, job = std::move(job)] { guarded(job); });
}

void Device::run(const std::function<void()>& job) {
    worker_->run([&] { guarded(job); });
}

void Device::postBatch() {
    if (batch_->empty())
        return;
    auto batch = std::shared_ptr<const Batch>(std::move(batch_));
    batch_ = std::make_unique<Batch>(abilities_.fetches);
    post([this, batch] { painter_->draw(*batch); });
}

TexturePointer Device::makeTexture(GLenum format, int width, int height) {
    const std::lock_guard lock(mutex_);
    TexturePointer texture;
    if (!isLost() && width <= abilities_.maxSide && height <= abilities_.maxSide)
        run([&] { texture = painter_->makeTexture(format, width, height); });
    return texture;
}

TexturePointer Device::adoptTexture(GLenum format, GLuint name, int width, int height) {
    return std::make_shared<const Texture>(discarded_, name, width, height, format);
}

void Device::upload(TexturePointer texture, const Rectangle& part, std::vector<std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    if (isLost())
        return;
    postBatch();
    auto kept = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
    post([this, texture, part, kept] { painter_->upload(*texture, part, kept->data()); });
}

bool Device::download(const Texture& texture, const Rectangle& part, std::uint8_t* bytes) {
    const std::lock_guard lock(mutex_);
    if (state_ == State::gone || getpid() != process_)
        return false;
    postBatch();
    run([&] { painter_->download(texture, part, bytes); });
    return state_ != State::gone;
}

void Device::draw(const Draw& draw, Tiles tiles, Color color, const RampRow* ramp) {
    if (tiles.tiles.empty())
        return;
    // The texture of shares has 2048 rows at least.
    constexpr std::size_t maxShares = 1 << 20;
    const std::lock_guard lock(mutex_);
    for (Tiles& part : inParts(std::move(tiles), maxShares)) {
        if (isLost())
            return;
        batch_->add(draw, std::move(part), color, ramp);
        if (batch_->isFull())
            postBatch();
    }
}

void Device::flush() {
    const std::lock_guard lock(mutex_);
    if (!isLost())
        postBatch();
}

GLsync Device::fence() {
    const std::lock_guard lock(mutex_);
    if (isLost())
        return nullptr;
    postBatch();
    GLsync fence = nullptr;
    run([&] { fence = painter_->fence(); });
    return fence;
}

void Device::waitFor(GLsync fence) {
    const std::lock_guard lock(mutex_);
    if (!isLost())
        post([this, fence] { painter_->waitFor(fence); });
}

void Device::finish() {
    const std::lock_guard lock(mutex_);
    if (isLost())
        return;
    postBatch();
    run([&] { painter_->finish(); });
}

}  // namespace vtm::openvg::gl
