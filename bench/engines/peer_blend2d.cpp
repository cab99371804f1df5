// Blend2D as a peer process (docs/benchmarks.md). It reads no SVG, so it is given the paths of our scene, as
// svg::write writes them: one element an item, absolute commands, numbers between spaces, groups that have an
// opacity at most.

#include <charconv>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <blend2d/blend2d.h>
#include <pugixml.hpp>

#include "bench/engines/argb_pixels.hpp"
#include "bench/engines/peer_process.hpp"

namespace vtm::bench {
namespace {

void check(BLResult result, const char* step) {
    if (result != BL_SUCCESS)
        throw std::runtime_error(std::string("Blend2D cannot ") + step + " (error " + std::to_string(result) +
                                 ")");
}

// ---- Attributes -----------------------------------------------------------------------------------------

/// Words of one letter and numbers, between spaces or one right after the other.
class Words {
public:
    explicit Words(std::string_view text) : text_(text) { skip(); }

    bool empty() const { return text_.empty(); }

    double number() {
        double value = 0;
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
        if (error != std::errc())
            throw std::runtime_error("a number is missing before '" + std::string(text_.substr(0, 10)) + "'");
        text_.remove_prefix(std::size_t(end - text_.data()));
        skip();
        return value;
    }

    BLPoint point() {
        const double x = number();
        return {x, number()};
    }

    char letter() {
        const char found = text_.front();
        text_.remove_prefix(1);
        skip();
        return found;
    }

private:
    void skip() { text_.remove_prefix(std::min(text_.find_first_not_of(' '), text_.size())); }

    std::string_view text_;
};

BLPath pathOf(std::string_view data) {
    BLPath path;
    for (Words words(data); !words.empty();) {
        const char command = words.letter();
        BLPoint a, b;
        switch (command) {
            case 'M':
                path.move_to(words.point());
                break;
            case 'L':
                path.line_to(words.point());
                break;
            case 'Q':
                a = words.point();
                path.quad_to(a, words.point());
                break;
            case 'C':
                a = words.point();
                b = words.point();
                path.cubic_to(a, b, words.point());
                break;
            case 'A': {
                a = words.point();
                const double rotation = words.number() * std::numbers::pi / 180;
                const bool large = words.number() != 0, sweep = words.number() != 0;
                path.elliptic_arc_to(a, rotation, large, sweep, words.point());
                break;
            }
            case 'Z':
                path.close();
                break;
            default:
                throw std::runtime_error(std::string("it is given paths without the command ") + command);
        }
    }
    return path;
}

/// "matrix(A B C D E F)", "translate(X Y)" or nothing.
BLMatrix2D matrixOf(std::string_view text) {
    BLMatrix2D matrix = BLMatrix2D::make_identity();
    if (text.empty())
        return matrix;
    const std::size_t open = text.find('(');
    const std::string_view kind = text.substr(0, open);
    if (kind != "matrix" && kind != "translate")
        throw std::runtime_error("it is given matrices and translations alone");
    Words words(text.substr(open + 1));
    for (int i = kind == "matrix" ? 0 : 4; i < 6; ++i)
        matrix.m[i] = words.number();
    return matrix;
}

/// "#rrggbb"
BLRgba32 colorOf(std::string_view text, double alpha) {
    std::uint32_t rgb = 0;
    const bool starts = text.starts_with('#') && text.size() == 7;
    if (!starts || std::from_chars(text.data() + 1, text.data() + 7, rgb, 16).ptr != text.data() + 7)
        throw std::runtime_error("it is given colours of six digits alone");
    return BLRgba32(rgb | std::uint32_t(std::lround(255 * alpha)) << 24);
}

template <class Value>
Value keywordOf(std::string_view text, std::initializer_list<std::pair<std::string_view, Value>> known) {
    for (const auto& [name, value] : known)
        if (text == name || text.empty())
            return value;
    throw std::runtime_error("it has no " + std::string(text));
}

// ---- Paints ---------------------------------------------------------------------------------------------

BLExtendMode extendOf(const pugi::xml_node& element) {
    return keywordOf<BLExtendMode>(element.attribute("spreadMethod").value(),
                                   {{"pad", BL_EXTEND_MODE_PAD},
                                    {"reflect", BL_EXTEND_MODE_REFLECT},
                                    {"repeat", BL_EXTEND_MODE_REPEAT}});
}

/// Its geometry is scaled to the size at which it is drawn, since Blend2D is coarse with radial gradients of
/// the size of a unit square, which those in fractions of a box are.
BLGradient gradientOf(const pugi::xml_node& element) {
    BLMatrix2D transform = matrixOf(element.attribute("gradientTransform").value());
    const double scale = std::sqrt(std::abs(transform.determinant()));
    transform.scale(1 / scale);
    const auto length = [&](const char* name, double initial = 0) {
        return scale * element.attribute(name).as_double(initial);
    };
    const double cx = element.attribute("cx").as_double(), cy = element.attribute("cy").as_double();
    BLGradient gradient;
    if (std::string_view(element.name()) == "linearGradient")
        gradient.create(BLLinearGradientValues(length("x1"), length("y1"), length("x2"), length("y2")),
                        extendOf(element));
    else
        gradient.create(BLRadialGradientValues(scale * cx, scale * cy, length("fx", cx), length("fy", cy),
                                               length("r"), length("fr")),
                        extendOf(element));
    for (const pugi::xml_node& stop : element.children("stop"))
        gradient.add_stop(
            stop.attribute("offset").as_double(),
            colorOf(stop.attribute("stop-color").value(), stop.attribute("stop-opacity").as_double(1)));
    gradient.set_transform(transform);
    return gradient;
}

using Paint = std::variant<BLRgba32, BLGradient>;
using Gradients = std::unordered_map<std::string, BLGradient>;

Gradients gradientsOf(const pugi::xml_node& definitions) {
    Gradients gradients;
    for (const pugi::xml_node& element : definitions) {
        const std::string_view tag = element.name();
        if (tag != "linearGradient" && tag != "radialGradient")
            throw std::runtime_error("it draws no <" + std::string(tag) + ">");
        gradients[element.attribute("id").value()] = gradientOf(element);
    }
    return gradients;
}

/// "#rrggbb" or "url(#ID)"
Paint paintOf(std::string_view text, const Gradients& gradients) {
    if (!text.starts_with("url(#"))
        return colorOf(text, 1);
    const auto found = gradients.find(std::string(text.substr(5, text.size() - 6)));
    if (found == gradients.end())
        throw std::runtime_error("the gradient " + std::string(text) + " is missing");
    return found->second;
}

// ---- Items and groups -----------------------------------------------------------------------------------

BLStrokeOptions strokeOf(const pugi::xml_node& element) {
    if (element.attribute("stroke-dasharray"))
        throw std::runtime_error("it strokes without dashes only");
    BLStrokeOptions stroke;
    stroke.width = element.attribute("stroke-width").as_double(1);
    stroke.miter_limit = element.attribute("stroke-miterlimit").as_double(4);
    stroke.set_caps(keywordOf<BLStrokeCap>(
        element.attribute("stroke-linecap").value(),
        {{"butt", BL_STROKE_CAP_BUTT}, {"round", BL_STROKE_CAP_ROUND}, {"square", BL_STROKE_CAP_SQUARE}}));
    stroke.join = std::uint8_t(keywordOf<BLStrokeJoin>(element.attribute("stroke-linejoin").value(),
                                                       {{"miter", BL_STROKE_JOIN_MITER_BEVEL},
                                                        {"miter-clip", BL_STROKE_JOIN_MITER_CLIP},
                                                        {"round", BL_STROKE_JOIN_ROUND},
                                                        {"bevel", BL_STROKE_JOIN_BEVEL}}));
    return stroke;
}

struct Item {
    BLPath path;
    BLMatrix2D transform;
    std::variant<BLFillRule, BLStrokeOptions> geometry;
    Paint paint;
    double alpha;
};

Item itemOf(const pugi::xml_node& element, const Gradients& gradients) {
    const bool stroked = std::strcmp(element.attribute("fill").value(), "none") == 0;
    Item item{pathOf(element.attribute("d").value()), matrixOf(element.attribute("transform").value()),
              keywordOf<BLFillRule>(element.attribute("fill-rule").value(),
                                    {{"nonzero", BL_FILL_RULE_NON_ZERO}, {"evenodd", BL_FILL_RULE_EVEN_ODD}}),
              paintOf(element.attribute(stroked ? "stroke" : "fill").value(), gradients),
              element.attribute(stroked ? "stroke-opacity" : "fill-opacity").as_double(1)};
    if (stroked)
        item.geometry = strokeOf(element);
    return item;
}

struct Group {
    double opacity = 1;
    std::vector<std::variant<Item, Group>> children = {};
};

Group groupOf(const pugi::xml_node& parent, const Gradients& gradients) {
    Group group{parent.attribute("opacity").as_double(1)};
    if (parent.attribute("filter"))
        throw std::runtime_error("it has no filters");
    for (const pugi::xml_node& element : parent) {
        const std::string_view tag = element.name();
        if (tag == "path")
            group.children.emplace_back(itemOf(element, gradients));
        else if (tag == "g")
            group.children.emplace_back(groupOf(element, gradients));
        else if (tag != "defs")
            throw std::runtime_error("it draws no <" + std::string(tag) + ">");
    }
    return group;
}

// ---- Drawing --------------------------------------------------------------------------------------------

/// A picture's pixels, and those of the groups in it that have an opacity: Blend2D has no layers.
class Surface {
public:
    void draw(const Group& picture, const asset::View& view) {
        const glm::dmat3x2& m = view.toPixels;
        toPixels_ = BLMatrix2D(m[0][0], m[0][1], m[1][0], m[1][1], m[2][0], m[2][1]);
        width_ = view.width;
        height_ = view.height;
        drawLayer(picture, 0);
    }

    image::Bitmap pixels() const {
        BLImageData data;
        check(layers_.at(0).get_data(&data), "give its pixels");
        return bitmapOf(static_cast<const unsigned char*>(data.pixel_data), data.stride, data.size.w,
                        data.size.h);
    }

private:
    /// A group's children on transparent black.
    void drawLayer(const Group& group, std::size_t level) {
        layers_.resize(std::max(layers_.size(), level + 1));
        if (layers_[level].width() != width_ || layers_[level].height() != height_)
            check(layers_[level].create(width_, height_, BL_FORMAT_PRGB32), "make an image of this size");
        BLContext context;  // no threads unless they are asked for
        check(context.begin(layers_[level]), "draw into an image");
        context.clear_all();
        for (const auto& child : group.children)
            if (const auto* item = std::get_if<Item>(&child))
                drawItem(*item, context);
            else
                drawGroup(std::get<Group>(child), level, context);
        check(context.end(), "finish a drawing");
    }

    void drawGroup(const Group& group, std::size_t level, BLContext& context) {
        drawLayer(group, level + 1);
        context.set_transform(BLMatrix2D::make_identity());
        context.set_global_alpha(group.opacity);
        context.blit_image(BLPointI(0, 0), layers_[level + 1]);
        context.set_global_alpha(1);
    }

    void drawItem(const Item& item, BLContext& context) const {
        BLMatrix2D matrix = item.transform;
        matrix.post_transform(toPixels_);
        context.set_transform(matrix);
        const auto* stroke = std::get_if<BLStrokeOptions>(&item.geometry);
        if (stroke) {
            context.set_stroke_options(*stroke);
            context.set_stroke_alpha(item.alpha);
        } else {
            context.set_fill_rule(std::get<BLFillRule>(item.geometry));
            context.set_fill_alpha(item.alpha);
        }
        const auto paint = [&](const auto& style) {
            check(stroke ? context.stroke_path(item.path, style) : context.fill_path(item.path, style),
                  "draw a path");
        };
        std::visit(paint, item.paint);
    }

    BLMatrix2D toPixels_;
    int width_ = 0, height_ = 0;
    std::vector<BLImage> layers_;  ///< the picture's, and one for each level of groups in it
};

class Blend2dDocument : public Document {
public:
    Blend2dDocument(Surface& surface, const std::string& path) : surface_(surface) {
        pugi::xml_document document;
        if (const auto result = document.load_file(path.c_str()); !result)
            throw std::runtime_error(std::string("it cannot be read: ") + result.description());
        const pugi::xml_node root = document.child("svg");
        picture_ = groupOf(root, gradientsOf(root.child("defs")));
    }
    void draw(const asset::View& view) override { surface_.draw(picture_, view); }

private:
    Surface& surface_;
    Group picture_;
};

class Blend2d : public Peer {
public:
    std::unique_ptr<Document> read(const std::string& path, double, double) override {
        return std::make_unique<Blend2dDocument>(surface_, path);
    }
    image::Bitmap pixels() const override { return surface_.pixels(); }

private:
    Surface surface_;
};

std::string version() {
    BLRuntimeBuildInfo build;
    check(BLRuntime::query_build_info(&build), "say its version");
    return std::to_string(build.major_version) + "." + std::to_string(build.minor_version) + "." +
           std::to_string(build.patch_version);
}

}  // namespace
}  // namespace vtm::bench

int main() {
    using namespace vtm::bench;
    PeerProcess process;
    process.add("blend2d", "gradients", "Blend2D " + version() + ", the paths of our scene, no threads",
                std::make_unique<Blend2d>());
    process.run();
}
