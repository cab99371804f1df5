#include "api/egl/surfaces/x_pixmaps.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include <dlfcn.h>

namespace vtm::egl {

namespace {

// What is used of libxcb, as its interface has been since version 1.0. Unlike libX11 it ends no process for a
// pixmap that is none.
struct Connection;
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
constexpr std::uint8_t zPixmap = 2;

struct Xcb {
    void* const library = dlopen("libxcb.so.1", RTLD_LAZY | RTLD_LOCAL);

    template <class F>
    F* find(const char* name) const {
        return library ? reinterpret_cast<F*>(dlsym(library, name)) : nullptr;
    }

    using Connect = Connection*(const char*, int*);
    using HasError = int(Connection*);
    using GetGeometry = Cookie(Connection*, std::uint32_t);
    using GeometryReply = Geometry*(Connection*, Cookie, void**);
    using GenerateId = std::uint32_t(Connection*);
    using CreateGc = Cookie(Connection*, std::uint32_t, std::uint32_t, std::uint32_t, const void*);
    using FreeGc = Cookie(Connection*, std::uint32_t);
    using PutImage = Cookie(Connection*, std::uint8_t, std::uint32_t, std::uint32_t, std::uint16_t,
                            std::uint16_t, std::int16_t, std::int16_t, std::uint8_t, std::uint8_t,
                            std::uint32_t, const std::uint8_t*);
    using MaximumLength = std::uint32_t(Connection*);
    Connect* const connect = find<Connect>("xcb_connect");
    HasError* const hasError = find<HasError>("xcb_connection_has_error");
    GetGeometry* const getGeometry = find<GetGeometry>("xcb_get_geometry");
    GeometryReply* const geometryReply = find<GeometryReply>("xcb_get_geometry_reply");
    GenerateId* const generateId = find<GenerateId>("xcb_generate_id");
    CreateGc* const createGc = find<CreateGc>("xcb_create_gc");
    FreeGc* const freeGc = find<FreeGc>("xcb_free_gc");
    PutImage* const putImage = find<PutImage>("xcb_put_image");
    MaximumLength* const maximumLength = find<MaximumLength>("xcb_get_maximum_request_length");
    /// To the server that DISPLAY names, kept for ever; null if there is none.
    Connection* const connection = open();

    Connection* open() const {
        if (!connect || !hasError || !getGeometry || !geometryReply || !generateId || !createGc || !freeGc ||
            !putImage || !maximumLength || !std::getenv("DISPLAY"))
            return nullptr;
        Connection* const result = connect(nullptr, nullptr);
        return result && hasError(result) == 0 ? result : nullptr;
    }

    struct Free {
        void operator()(void* pointer) const { std::free(pointer); }
    };
    std::unique_ptr<Geometry, Free> geometry(std::uint32_t drawable) const {
        void* error = nullptr;
        std::unique_ptr<Geometry, Free> reply(
            geometryReply(connection, getGeometry(connection, drawable), &error));
        std::free(error);
        return reply;
    }
};

/// As the server has them: words of 32 bits, 8 of each colour, or of 16 bits, 5, 6 and 5. Rows end at
/// multiples of four bytes.
std::vector<std::uint8_t> converted(int width, int height, int depth, const std::uint8_t* pixels) {
    const std::size_t pixelBytes = depth == 16 ? 2 : 4,
                      rowBytes = (std::size_t(width) * pixelBytes + 3) / 4 * 4;
    std::vector<std::uint8_t> result(rowBytes * std::size_t(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, pixels += 4) {
            std::uint8_t* const to = &result[std::size_t(y) * rowBytes + std::size_t(x) * pixelBytes];
            if (depth == 16) {
                const unsigned word =
                    unsigned(pixels[0] >> 3) << 11 | unsigned(pixels[1] >> 2) << 5 | pixels[2] >> 3;
                to[0] = std::uint8_t(word);
                to[1] = std::uint8_t(word >> 8);
            } else {
                to[0] = pixels[2];
                to[1] = pixels[1];
                to[2] = pixels[0];
                to[3] = pixels[3];
            }
        }
    return result;
}

}  // namespace

bool putPicture(EGLNativePixmapType pixmap, int width, int height, const std::uint8_t* pixels) {
    static const Xcb xcb;
    if (!xcb.connection || pixmap > UINT32_MAX)
        return false;
    const auto drawable = std::uint32_t(pixmap);
    const auto geometry = xcb.geometry(drawable);
    if (!geometry || geometry->width != width || geometry->height != height ||
        (geometry->depth != 16 && geometry->depth != 24 && geometry->depth != 32))
        return false;
    const std::vector<std::uint8_t> image = converted(width, height, geometry->depth, pixels);
    const std::size_t rowBytes = image.size() / std::size_t(height);
    // A request has a head of 24 bytes, or 28 if it is a large one.
    const std::size_t room = std::size_t(xcb.maximumLength(xcb.connection)) * 4 - 28;
    const int rows = int(std::clamp<std::size_t>(room / rowBytes, 1, std::size_t(height)));
    const std::uint32_t gc = xcb.generateId(xcb.connection);
    xcb.createGc(xcb.connection, gc, drawable, 0, nullptr);
    for (int y = 0; y < height; y += rows) {
        const int count = std::min(rows, height - y);
        xcb.putImage(xcb.connection, zPixmap, drawable, gc, std::uint16_t(width), std::uint16_t(count), 0,
                     std::int16_t(y), 0, geometry->depth, std::uint32_t(rowBytes * std::size_t(count)),
                     &image[std::size_t(y) * rowBytes]);
    }
    xcb.freeGc(xcb.connection, gc);
    // The reply comes after all that was sent before.
    return xcb.geometry(drawable) != nullptr;
}

}  // namespace vtm::egl
