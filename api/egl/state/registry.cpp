#include "api/egl/state/registry.hpp"

#include <atomic>
#include <cstddef>

#include "api/system_egl/system.hpp"

namespace vtm::egl {

void* newHandle() {
    // Never written to: it costs addresses, not memory.
    static char room[1 << 24];
    static std::atomic<std::size_t> next = 0;
    return room + next++ % sizeof(room);
}

namespace {

struct Displays {
    std::mutex mutex;
    std::map<EGLDisplay, std::unique_ptr<Display>> all;
};

Displays& displays() {
    static auto& displays = *new Displays;
    return displays;
}

}  // namespace

Table<Config>& configs() {
    static auto& table = *new Table<Config>;
    return table;
}

Table<Surface>& surfaces() {
    static auto& table = *new Table<Surface>;
    return table;
}

Table<Context>& contexts() {
    static auto& table = *new Table<Context>;
    return table;
}

Table<Image>& images() {
    static auto& table = *new Table<Image>;
    return table;
}

Display* findDisplay(EGLDisplay handle) {
    const std::lock_guard lock(displays().mutex);
    const auto it = displays().all.find(handle);
    return it == displays().all.end() ? nullptr : it->second.get();
}

Display& addDisplay(EGLDisplay handle, bool isSystems, bool mayBeAlone, std::optional<void*> native) {
    const std::lock_guard lock(displays().mutex);
    std::unique_ptr<Display>& display = displays().all[handle];
    if (!display) {
        display = std::make_unique<Display>();
        display->handle = handle;
        display->isSystems = isSystems;
        display->mayBeAlone = mayBeAlone;
        display->native = native;
    }
    return *display;
}

Display& ownDisplay() {
    static Display& display = addDisplay(newHandle(), false, true);
    return display;
}

Display& initializedDisplay(EGLDisplay handle) {
    Display* const display = findDisplay(handle);
    require(display != nullptr, EGL_BAD_DISPLAY);
    require(display->isInitialized, EGL_NOT_INITIALIZED);
    return *display;
}

std::shared_ptr<Config> getConfig(const Display& display, EGLConfig handle) {
    std::shared_ptr<Config> config = configs().find(handle);
    if (config && config->display == &display)
        return config;
    EGLint id = 0;
    const bool isSystems = !config && display.systemRuns &&
                           systemEgl()->GetConfigAttrib(display.handle, handle, EGL_CONFIG_ID, &id);
    throw Error{isSystems ? EGL_BAD_MATCH : EGL_BAD_CONFIG};
}

}  // namespace vtm::egl
