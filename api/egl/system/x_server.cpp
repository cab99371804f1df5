#include "api/egl/system/x_server.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>

#include <dlfcn.h>
#include <sys/ipc.h>
#include <sys/shm.h>

namespace vtm::egl {

namespace {

// The interfaces of libxcb and libxcb-shm, as they have been since version 1.0. A connection is a pointer.

struct Cookie {
    unsigned sequence;
};
struct Geometry {
    std::uint8_t responseType, depth;
    std::uint16_t sequence;
    std::uint32_t length, root;
    std::int16_t x, y;
    std::uint16_t width, height, borderWidth;
};
struct Extension {
    std::uint8_t responseType, padding;
    std::uint16_t sequence;
    std::uint32_t length;
    std::uint8_t isPresent;
};
constexpr std::uint8_t zPixmap = 2;

using Freed = std::unique_ptr<void, decltype([](void* reply) { std::free(reply); })>;

/// A function of a library that may be missing, and then it is null.
template <class Signature>
class Loaded {
public:
    Loaded(void* library, const char* name)
        : function_(library ? reinterpret_cast<Signature*>(dlsym(library, name)) : nullptr) {}

    explicit operator bool() const { return function_; }
    template <class... Arguments>
    auto operator()(Arguments... arguments) const {
        return function_(arguments...);
    }

private:
    Signature* const function_;
};

void* open(const char* name) { return dlopen(name, RTLD_LAZY | RTLD_LOCAL); }

struct Xcb {
    void* const library = open("libxcb.so.1");
    const Loaded<void*(const char*, int*)> connect{library, "xcb_connect"};
    const Loaded<void(void*)> disconnect{library, "xcb_disconnect"};
    const Loaded<int(void*)> hasError{library, "xcb_connection_has_error"};
    const Loaded<std::uint32_t(void*)> maximumLength{library, "xcb_get_maximum_request_length"};
    const Loaded<std::uint32_t(void*)> generateId{library, "xcb_generate_id"};
    const Loaded<void*(void*)> pollForEvent{library, "xcb_poll_for_event"};
    const Loaded<const Extension*(void*, void*)> extensionData{library, "xcb_get_extension_data"};
    const Loaded<void*(void*, Cookie)> requestCheck{library, "xcb_request_check"};
    const Loaded<Cookie(void*, std::uint32_t)> getGeometry{library, "xcb_get_geometry"};
    const Loaded<Geometry*(void*, Cookie, void**)> geometryReply{library, "xcb_get_geometry_reply"};
    const Loaded<Cookie(void*, std::uint32_t, std::uint32_t, std::uint32_t, const void*)> createGc{
        library, "xcb_create_gc"};
    const Loaded<Cookie(void*, std::uint32_t)> freeGc{library, "xcb_free_gc"};
    const Loaded<Cookie(void*, std::uint8_t format, std::uint32_t drawable, std::uint32_t gc,
                        std::uint16_t width, std::uint16_t height, std::int16_t x, std::int16_t y,
                        std::uint8_t leftPad, std::uint8_t depth, std::uint32_t length,
                        const std::uint8_t* bytes)>
        putImage{library, "xcb_put_image"};

    bool isWhole() const {
        return connect && disconnect && hasError && maximumLength && generateId && pollForEvent &&
               extensionData && requestCheck && getGeometry && geometryReply && createGc && freeGc &&
               putImage;
    }
};

struct XcbShm {
    void* const library = open("libxcb-shm.so.0");
    void* const extension = library ? dlsym(library, "xcb_shm_id") : nullptr;
    const Loaded<Cookie(void*, std::uint32_t segment, std::uint32_t id, std::uint8_t isReadOnly)> attach{
        library, "xcb_shm_attach_checked"};
    const Loaded<Cookie(void*, std::uint32_t segment)> detach{library, "xcb_shm_detach"};
    const Loaded<Cookie(void*, std::uint32_t drawable, std::uint32_t gc, std::uint16_t pictureWidth,
                        std::uint16_t pictureHeight, std::uint16_t fromX, std::uint16_t fromY,
                        std::uint16_t width, std::uint16_t height, std::int16_t x, std::int16_t y,
                        std::uint8_t depth, std::uint8_t format, std::uint8_t sendsEvent,
                        std::uint32_t segment, std::uint32_t offset)>
        putImage{library, "xcb_shm_put_image"};

    bool isWhole() const { return extension && attach && detach && putImage; }
};

const Xcb& xcb() {
    static const auto& functions = *new Xcb;
    return functions;
}
const XcbShm& xcbShm() {
    static const auto& functions = *new XcbShm;
    return functions;
}

/// Lives for one put.
class GraphicsContext {
public:
    GraphicsContext(void* connection, std::uint32_t drawable)
        : connection_(connection), id_(xcb().generateId(connection)) {
        xcb().createGc(connection, id_, drawable, 0u, nullptr);
    }
    ~GraphicsContext() { xcb().freeGc(connection_, id_); }
    GraphicsContext(const GraphicsContext&) = delete;
    GraphicsContext& operator=(const GraphicsContext&) = delete;

    std::uint32_t id() const { return id_; }

private:
    void* const connection_;
    const std::uint32_t id_;
};

}  // namespace

XServer::XServer(void* connection)
    : connection_(connection), largestRequest_(std::size_t(xcb().maximumLength(connection)) * 4) {
    if (xcbShm().isWhole()) {
        const Extension* const extension = xcb().extensionData(connection, xcbShm().extension);
        sharesMemory_ = extension && extension->isPresent;
    }
}

const XServer* XServer::named(const std::string& name) {
    static auto& mutex = *new std::mutex;
    static auto& servers = *new std::map<std::string, const XServer*>;
    if (!xcb().isWhole() || name.empty())
        return nullptr;
    const std::lock_guard lock(mutex);
    const auto [it, isNew] = servers.try_emplace(name, nullptr);
    if (isNew) {
        void* const connection = xcb().connect(name.c_str(), static_cast<int*>(nullptr));
        if (connection && xcb().hasError(connection) == 0)
            it->second = new XServer(connection);
        else if (connection)
            xcb().disconnect(connection);
    }
    return it->second;
}

std::optional<XServer::Drawable> XServer::find(std::uintptr_t id) const {
    if (id == 0 || id > UINT32_MAX)
        return std::nullopt;
    const auto number = std::uint32_t(id);
    void* error = nullptr;
    const Freed reply(xcb().geometryReply(connection_, xcb().getGeometry(connection_, number), &error));
    std::free(error);
    // What went wrong with earlier requests: the window was gone.
    while (const Freed event{xcb().pollForEvent(connection_)}) {
    }
    if (!reply)
        return std::nullopt;
    const auto& geometry = *static_cast<const Geometry*>(reply.get());
    return Drawable{number, geometry.width, geometry.height, geometry.depth};
}

std::unique_ptr<XServer::SharedMemory> XServer::share(std::size_t bytes) const {
    if (!sharesMemory_)
        return nullptr;
    const int id = shmget(IPC_PRIVATE, bytes, IPC_CREAT | 0600);
    if (id < 0)
        return nullptr;
    void* const address = shmat(id, nullptr, 0);
    std::unique_ptr<SharedMemory> memory;
    if (address != reinterpret_cast<void*>(-1)) {
        const std::uint32_t segment = xcb().generateId(connection_);
        const Cookie attached = xcbShm().attach(connection_, segment, std::uint32_t(id), std::uint8_t(true));
        const Freed error(xcb().requestCheck(connection_, attached));
        if (error)
            shmdt(address);
        else
            memory =
                std::make_unique<SharedMemory>(*this, segment, static_cast<std::uint8_t*>(address), bytes);
    }
    // It lives as long as someone is attached.
    shmctl(id, IPC_RMID, nullptr);
    return memory;
}

XServer::SharedMemory::~SharedMemory() {
    xcbShm().detach(server_.connection_, segment_);
    shmdt(bytes_);
}

void XServer::put(const Drawable& to, const SharedMemory& picture) const {
    const GraphicsContext gc(connection_, to.id);
    const auto width = std::uint16_t(to.width), height = std::uint16_t(to.height);
    constexpr std::uint16_t none = 0;
    xcbShm().putImage(connection_, to.id, gc.id(), width, height, none, none, width, height, std::int16_t(0),
                      std::int16_t(0), std::uint8_t(to.depth), zPixmap, std::uint8_t(false), picture.segment_,
                      0u);
}

void XServer::put(const Drawable& to, const std::uint8_t* picture) const {
    // A request has a head of 24 bytes, or 28 if it is a large one.
    constexpr std::size_t head = 28;
    const std::size_t rowBytes = to.rowBytes();
    const int most =
        int(std::clamp<std::size_t>((largestRequest_ - head) / rowBytes, 1, std::size_t(to.height)));
    const GraphicsContext gc(connection_, to.id);
    for (int y = 0; y < to.height; y += most) {
        const int rows = std::min(most, to.height - y);
        xcb().putImage(connection_, zPixmap, to.id, gc.id(), std::uint16_t(to.width), std::uint16_t(rows),
                       std::int16_t(0), std::int16_t(y), std::uint8_t(0), std::uint8_t(to.depth),
                       std::uint32_t(rowBytes * std::size_t(rows)), picture + std::size_t(y) * rowBytes);
    }
}

}  // namespace vtm::egl
