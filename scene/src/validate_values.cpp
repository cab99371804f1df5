#include "scene/src/validate_values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace vtm::scene {

namespace {

bool inUnit(float v) { return v >= 0 && v <= 1; }
bool positive(double v) { return std::isfinite(v) && v > 0; }

/// What GLSL leaves to its users: no leading gl_, no double underscore (GLSL ES 3.00 section 3.8).
bool isMaterialName(const std::string& name) {
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto isRest = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; };
    return !name.empty() && name.size() <= maxMaterialName && isLetter(name[0]) &&
           std::all_of(name.begin(), name.end(), isRest) && name.find("__") == std::string::npos &&
           !name.starts_with("gl_");
}

struct AllFinite {
    bool operator()(const MoveTo& c) const { return finite(c.to); }
    bool operator()(const LineTo& c) const { return finite(c.to); }
    bool operator()(const QuadTo& c) const { return finite(c.control) && finite(c.to); }
    bool operator()(const CubicTo& c) const {
        return finite(c.control1) && finite(c.control2) && finite(c.to);
    }
    bool operator()(const ArcTo& c) const {
        return finite(c.radii) && std::isfinite(c.rotation) && finite(c.to);
    }
    bool operator()(const Close&) const { return true; }
};

std::string dashFault(const StrokeStyle& s) {
    if (!std::isfinite(s.dashPhase))
        return fmt::format("dash phase is {}", s.dashPhase);
    if (s.dashes.size() % 2 != 0)
        return fmt::format("dash list has the odd length {}", s.dashes.size());
    double sum = 0;
    for (const double length : s.dashes) {
        if (!(length >= 0))
            return fmt::format("dash length is {}, not >= 0", length);
        sum += length;
    }
    return s.dashes.empty() || positive(sum) ? "" : fmt::format("dash lengths add up to {}", sum);
}

template <class Gradient>
std::string gradientFault(const Gradient& g) {
    if (!finite(g.transform))
        return "gradient transform is not finite";
    if (!known(g.spread, Spread::Repeat))
        return fmt::format("gradient spread {} is unknown", int(g.spread));
    if (g.stops.size() < 2)
        return fmt::format("gradient has {} stops, not 2 or more", g.stops.size());
    float last = 0;
    for (const GradientStop& stop : g.stops) {
        if (!inUnit(stop.offset))
            return fmt::format("gradient offset is {}, not in [0, 1]", stop.offset);
        if (stop.offset < last)
            return fmt::format("gradient offset {} follows {}", stop.offset, last);
        if (std::string wrong = fault(stop.color); !wrong.empty())
            return "gradient " + wrong;
        last = stop.offset;
    }
    return {};
}

}  // namespace

std::string fault(const Scene& s) {
    const auto sideFault = [](const char* name, double side) {
        return side >= minSide && side <= maxSide ? ""
                                                  : fmt::format("{} is {}, not in [2^-40, 2^40]", name, side);
    };
    const std::string wrong = sideFault("width", s.width);
    return wrong.empty() ? sideFault("height", s.height) : wrong;
}

std::string fault(const Path& path) {
    if (!path.empty() && !std::holds_alternative<MoveTo>(path.front()))
        return "does not begin with MoveTo";
    const auto bad = std::find_if_not(path.begin(), path.end(),
                                      [](const Command& c) { return std::visit(AllFinite{}, c); });
    return bad == path.end() ? "" : fmt::format("command {} is not finite", bad - path.begin());
}

std::string fault(FillRule rule) {
    return known(rule, FillRule::EvenOdd) ? "" : fmt::format("fill rule {} is unknown", int(rule));
}

std::string fault(const StrokeStyle& s) {
    if (!positive(s.width))
        return fmt::format("stroke width is {}, not > 0", s.width);
    if (!known(s.cap, Cap::Square))
        return fmt::format("stroke cap {} is unknown", int(s.cap));
    if (!known(s.join, Join::Bevel))
        return fmt::format("stroke join {} is unknown", int(s.join));
    if (!(std::isfinite(s.miterLimit) && s.miterLimit >= 1))
        return fmt::format("mitre limit is {}, not >= 1", s.miterLimit);
    return dashFault(s);
}

std::string fault(const Color& c) {
    const bool holds = inUnit(c.r) && inUnit(c.g) && inUnit(c.b) && inUnit(c.a);
    return holds ? "" : fmt::format("colour ({}, {}, {}, {}) is not in [0, 1]", c.r, c.g, c.b, c.a);
}

std::string fault(const LinearGradient& g) {
    if (!(finite(g.start) && finite(g.end) && g.start != g.end))
        return "gradient vector is not finite or has no length";
    return gradientFault(g);
}

std::string fault(const RadialGradient& g) {
    if (!(finite(g.center) && finite(g.focus)))
        return "gradient centre or focus is not finite";
    if (!positive(g.radius))
        return fmt::format("gradient radius is {}, not > 0", g.radius);
    if (!(g.focalRadius >= 0 && std::isfinite(g.focalRadius)))
        return fmt::format("gradient focal radius is {}, not >= 0", g.focalRadius);
    if (g.center == g.focus && g.radius == g.focalRadius)
        return "gradient's circles are the same";
    return gradientFault(g);
}

std::string fault(const Pattern& p) {
    if (!finite(p.transform))
        return "pattern transform is not finite";
    const bool tile = finite(p.min) && finite(p.max) && p.max.x > p.min.x && p.max.y > p.min.y;
    return tile ? "" : "pattern tile is empty or not finite";
}

std::string fault(const ImagePaint& p) {
    if (!finite(p.transform))
        return "image transform is not finite";
    if (!known(p.filter, ImageFilter::Bicubic))
        return fmt::format("image filter {} is unknown", int(p.filter));
    if (!p.bitmap)
        return "image is missing";
    const image::Bitmap& b = *p.bitmap;
    if (b.width > 0 && b.height > 0 && b.rgba.size() == std::size_t(b.width) * std::size_t(b.height) * 4)
        return {};
    return fmt::format("image of {} x {} pixels has {} bytes", b.width, b.height, b.rgba.size());
}

std::string fault(const Material& m) {
    if (!finite(m.transform))
        return "material transform is not finite";
    if (!isMaterialName(m.name))
        return fmt::format("material name '{}' is not a plain identifier", m.name.substr(0, maxMaterialName));
    if (m.glsl.size() > maxMaterialText || m.glsl.find('\0') != std::string::npos)
        return fmt::format("text of material '{}' contains a zero byte or more than {} bytes", m.name,
                           maxMaterialText);
    return fault(m.fallback);
}

std::string fault(const Shape& s) {
    return finite(s.transform) ? std::visit([](const auto& g) { return fault(g); }, s.geometry)
                               : "transform is not finite";
}

std::string fault(const Item& i) {
    if (!finite(i.transform))
        return "transform is not finite";
    if (!inUnit(i.opacity))
        return fmt::format("opacity is {}, not in [0, 1]", i.opacity);
    if (std::string wrong = std::visit([](const auto& g) { return fault(g); }, i.geometry); !wrong.empty())
        return wrong;
    return std::visit([](const auto& p) { return fault(p); }, i.paint);
}

std::string fault(const Group& g) {
    if (!inUnit(g.opacity))
        return fmt::format("opacity is {}, not in [0, 1]", g.opacity);
    return known(g.blend, BlendMode::PlusLighter) ? ""
                                                  : fmt::format("blend mode {} is unknown", int(g.blend));
}

std::string fault(const ClipShape& shape) {
    return finite(shape.transform) ? fault(shape.rule) : "transform is not finite";
}

std::string fault(const Mask& mask) {
    return known(mask.kind, MaskKind::Alpha) ? "" : fmt::format("mask kind {} is unknown", int(mask.kind));
}

}  // namespace vtm::scene
