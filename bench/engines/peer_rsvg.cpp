#include "bench/engines/peer_rsvg.hpp"

#include <fmt/core.h>

#ifdef VTM_HAVE_RSVG
#include <cairo.h>
#include <librsvg/rsvg.h>

#include "bench/engines/cairo_pixels.hpp"
#endif

namespace vtm::bench {

#ifdef VTM_HAVE_RSVG

namespace {

[[noreturn]] void fail(const char* what, GError* error) {
    const std::string reason = error ? error->message : "no reason given";
    g_clear_error(&error);
    throw RsvgError(fmt::format("librsvg cannot {}: {}", what, reason));
}

template <auto release>
struct Release {
    template <class T>
    void operator()(T* object) const {
        release(object);
    }
};

}  // namespace

struct Rsvg::Impl {
    std::unique_ptr<RsvgHandle, Release<g_object_unref>> handle;
    std::unique_ptr<cairo_surface_t, Release<cairo_surface_destroy>> surface;
    RsvgRectangle picture{};
};

Rsvg::Rsvg(const std::filesystem::path& path, double width, double height) : impl_(std::make_unique<Impl>()) {
    GError* error = nullptr;
    impl_->handle.reset(rsvg_handle_new_from_file(path.c_str(), &error));
    if (!impl_->handle)
        fail("read it", error);
    impl_->picture = {0, 0, width, height};
}

void Rsvg::draw(const asset::View& view) {
    auto& surface = impl_->surface;
    if (!surface || cairo_image_surface_get_width(surface.get()) != view.width ||
        cairo_image_surface_get_height(surface.get()) != view.height)
        surface.reset(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, view.width, view.height));
    const std::unique_ptr<cairo_t, Release<cairo_destroy>> cairo(cairo_create(surface.get()));
    cairo_set_operator(cairo.get(), CAIRO_OPERATOR_CLEAR);
    cairo_paint(cairo.get());
    cairo_set_operator(cairo.get(), CAIRO_OPERATOR_OVER);
    const glm::dmat3x2& m = view.toPixels;
    const cairo_matrix_t matrix{m[0][0], m[0][1], m[1][0], m[1][1], m[2][0], m[2][1]};
    cairo_transform(cairo.get(), &matrix);
    GError* error = nullptr;
    if (!rsvg_handle_render_document(impl_->handle.get(), cairo.get(), &impl_->picture, &error))
        fail("draw it", error);
    cairo_surface_flush(surface.get());
}

image::Bitmap Rsvg::pixels() const { return bitmapOf(impl_->surface.get()); }

std::optional<std::string> rsvgVersion() {
    return fmt::format("librsvg {}.{}.{} with cairo {}", LIBRSVG_MAJOR_VERSION, LIBRSVG_MINOR_VERSION,
                       LIBRSVG_MICRO_VERSION, cairo_version_string());
}

#else

struct Rsvg::Impl {};
Rsvg::Rsvg(const std::filesystem::path&, double, double) {
    throw RsvgError("librsvg is missing (librsvg2-dev)");
}
void Rsvg::draw(const asset::View&) {}
image::Bitmap Rsvg::pixels() const { return {}; }
std::optional<std::string> rsvgVersion() { return std::nullopt; }

#endif

Rsvg::~Rsvg() = default;
Rsvg::Rsvg(Rsvg&&) noexcept = default;
Rsvg& Rsvg::operator=(Rsvg&&) noexcept = default;

}  // namespace vtm::bench
