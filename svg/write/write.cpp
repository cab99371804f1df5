#include <vtm/svg/write.hpp>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vtm::svg {
namespace {

using namespace scene;

std::string text(Point p) { return fmt::format("{} {}", p.x, p.y); }

struct CommandText {
    std::string operator()(const MoveTo& c) const { return "M" + text(c.to); }
    std::string operator()(const LineTo& c) const { return "L" + text(c.to); }
    std::string operator()(const QuadTo& c) const { return "Q" + text(c.control) + " " + text(c.to); }
    std::string operator()(const CubicTo& c) const {
        return "C" + text(c.control1) + " " + text(c.control2) + " " + text(c.to);
    }
    std::string operator()(const ArcTo& c) const {
        return fmt::format("A{} {} {:d} {:d} {}", text(c.radii), c.rotation * 180 / std::numbers::pi,
                           c.largeArc, c.sweep, text(c.to));
    }
    std::string operator()(const Close&) const { return "Z"; }
};

std::string data(const Path& path) {
    std::string d;
    for (const Command& command : path)
        d += std::visit(CommandText(), command);
    return d;
}

std::string hex(const Color& c) {
    const auto byte = [](float v) { return std::lround(255 * v); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

std::string opacity(const char* attribute, float value) {
    return value == 1 ? "" : fmt::format(" {}=\"{}\"", attribute, value);
}

std::string strokeAttributes(const StrokeStyle& style) {
    constexpr const char* caps[] = {"butt", "round", "square"};
    constexpr const char* joins[] = {"miter", "miter-clip", "round", "bevel"};
    std::string s = fmt::format(
        " stroke-width=\"{}\" stroke-linecap=\"{}\" stroke-linejoin=\"{}\" stroke-miterlimit=\"{}\"",
        style.width, caps[int(style.cap)], joins[int(style.join)], style.miterLimit);
    if (!style.dashes.empty())
        s += fmt::format(" stroke-dasharray=\"{}\" stroke-dashoffset=\"{}\"", fmt::join(style.dashes, " "),
                         style.dashPhase);
    return s;
}

class Writer {
public:
    std::string run(const Scene& scene) {
        text_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
            "viewBox=\"0 0 {0} {1}\">\n",
            scene.width, scene.height);
        if (isPlain(scene.root))
            children(scene.root);
        else
            group(scene.root);
        return text_ + "</svg>\n";
    }

private:
    static bool isPlain(const Group& g) {
        return g.opacity == 1 && g.blend == BlendMode::Normal && !g.clip && !g.mask;
    }

    void group(const Group& g) {
        if (g.clip || g.mask || g.blend != BlendMode::Normal)
            throw WriteError("a group with a clip, a mask or a blend mode cannot be written as SVG");
        if (++depth_ > maxNesting)
            throw WriteError(fmt::format("groups are nested more than {} levels deep", maxNesting));
        text_ += "<g style=\"isolation:isolate\"" + opacity("opacity", g.opacity) + ">\n";
        children(g);
        text_ += "</g>\n";
        --depth_;
    }

    void children(const Group& g) {
        for (const Node& node : g.children) {
            if (const auto* child = std::get_if<Group>(&node.value))
                group(*child);
            else if (const auto* drawn = std::get_if<Item>(&node.value))
                item(*drawn);
            else
                throw WriteError("a selection cannot be written as SVG");
        }
    }

    void item(const Item& item) {
        const auto* color = std::get_if<Color>(&item.paint);
        if (!color)
            throw WriteError("a gradient, a pattern or an image cannot be written as SVG");
        text_ += "<path";
        if (const auto& m = item.transform; m != identity)
            text_ += fmt::format(" transform=\"matrix({} {} {})\"", text(m[0]), text(m[1]), text(m[2]));
        const float alpha = color->a * item.opacity;
        if (const auto* rule = std::get_if<FillRule>(&item.geometry)) {
            text_ += fmt::format(" fill=\"{}\"", hex(*color)) + opacity("fill-opacity", alpha);
            text_ += *rule == FillRule::EvenOdd ? " fill-rule=\"evenodd\"" : "";
        } else {
            text_ +=
                fmt::format(" fill=\"none\" stroke=\"{}\"", hex(*color)) + opacity("stroke-opacity", alpha);
            text_ += strokeAttributes(std::get<StrokeStyle>(item.geometry));
        }
        text_ += " d=\"" + data(*item.path) + "\"/>\n";
    }

    std::string text_;
    int depth_ = 0;
};

}  // namespace

std::string write(const Scene& scene) { return Writer().run(scene); }

}  // namespace vtm::svg
