#include "bench/engines/peer_cairo.hpp"

#ifdef VTM_HAVE_RSVG
#include <cairo.h>

#include "bench/engines/cairo_pixels.hpp"
#endif

namespace vtm::bench {

#ifdef VTM_HAVE_RSVG

namespace {

void trace(cairo_t* c, const scene::Path& path) {
    scene::Point at(0);
    for (const scene::Command& command : path) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command)) {
            cairo_move_to(c, move->to.x, move->to.y);
        } else if (const auto* line = std::get_if<scene::LineTo>(&command)) {
            cairo_line_to(c, line->to.x, line->to.y);
        } else if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            const scene::Point a = at + 2.0 / 3 * (quad->control - at),
                               b = quad->to + 2.0 / 3 * (quad->control - quad->to);
            cairo_curve_to(c, a.x, a.y, b.x, b.y, quad->to.x, quad->to.y);
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            cairo_curve_to(c, cubic->control1.x, cubic->control1.y, cubic->control2.x, cubic->control2.y,
                           cubic->to.x, cubic->to.y);
        } else {
            cairo_close_path(c);
        }
        if (const auto end = scene::endOf(command))
            at = *end;
    }
}

void stroke(cairo_t* c, const scene::StrokeStyle& style) {
    constexpr cairo_line_cap_t caps[]{CAIRO_LINE_CAP_BUTT, CAIRO_LINE_CAP_ROUND, CAIRO_LINE_CAP_SQUARE};
    constexpr cairo_line_join_t joins[]{CAIRO_LINE_JOIN_MITER, CAIRO_LINE_JOIN_MITER, CAIRO_LINE_JOIN_ROUND,
                                        CAIRO_LINE_JOIN_BEVEL};
    cairo_set_line_width(c, style.width);
    cairo_set_line_cap(c, caps[int(style.cap)]);
    cairo_set_line_join(c, joins[int(style.join)]);
    cairo_set_miter_limit(c, style.miterLimit);
    cairo_set_dash(c, style.dashes.data(), int(style.dashes.size()), style.dashPhase);
    cairo_stroke(c);
}

void fill(cairo_t* c, scene::FillRule rule) {
    cairo_set_fill_rule(
        c, rule == scene::FillRule::EvenOdd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
    cairo_fill(c);
}

}  // namespace

struct CairoCanvas::Impl {
    Impl(int width, int height)
        : surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)), c(cairo_create(surface)) {}
    ~Impl() {
        cairo_destroy(c);
        cairo_surface_destroy(surface);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    cairo_surface_t* surface;
    cairo_t* c;
};

CairoCanvas::CairoCanvas(int width, int height) : impl_(std::make_unique<Impl>(width, height)) {}
int CairoCanvas::width() const { return cairo_image_surface_get_width(impl_->surface); }
int CairoCanvas::height() const { return cairo_image_surface_get_height(impl_->surface); }

void CairoCanvas::draw(const std::vector<Shape>& shapes, const scene::Affine& view,
                       const scene::Color& ground) {
    cairo_t* c = impl_->c;
    cairo_identity_matrix(c);
    cairo_set_operator(c, CAIRO_OPERATOR_SOURCE);
    cairo_set_source_rgba(c, ground.r, ground.g, ground.b, ground.a);
    cairo_paint(c);
    cairo_set_operator(c, CAIRO_OPERATOR_OVER);
    for (const Shape& shape : shapes) {
        const scene::Affine m = scene::compose(view, shape.toPicture);
        cairo_matrix_t matrix;
        cairo_matrix_init(&matrix, m[0].x, m[0].y, m[1].x, m[1].y, m[2].x, m[2].y);
        cairo_set_matrix(c, &matrix);
        cairo_new_path(c);
        trace(c, shape.path);
        cairo_set_source_rgba(c, shape.color.r, shape.color.g, shape.color.b, shape.color.a);
        if (const auto* style = std::get_if<scene::StrokeStyle>(&shape.geometry))
            stroke(c, *style);
        else
            fill(c, std::get<scene::FillRule>(shape.geometry));
    }
    cairo_surface_flush(impl_->surface);
}

image::Bitmap CairoCanvas::pixels() const { return bitmapOf(impl_->surface); }

std::optional<std::string> cairoVersion() { return std::string("cairo ") + cairo_version_string(); }

#else

struct CairoCanvas::Impl {};
CairoCanvas::CairoCanvas(int, int) {}
int CairoCanvas::width() const { return 0; }
int CairoCanvas::height() const { return 0; }
void CairoCanvas::draw(const std::vector<Shape>&, const scene::Affine&, const scene::Color&) {}
image::Bitmap CairoCanvas::pixels() const { return {}; }
std::optional<std::string> cairoVersion() { return std::nullopt; }

#endif

CairoCanvas::~CairoCanvas() = default;
CairoCanvas::CairoCanvas(CairoCanvas&&) noexcept = default;
CairoCanvas& CairoCanvas::operator=(CairoCanvas&&) noexcept = default;

}  // namespace vtm::bench
