// The text form: a line for each node, its parts indented below it, defaults left out. Numbers are the
// shortest that read back as the same value. A shared part is written where it is first used, with a
// number, and only named by the number after that.

#include <array>
#include <span>
#include <unordered_map>

#include <fmt/format.h>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {

namespace {

constexpr std::array blendNames{"normal",     "multiply",    "screen",     "overlay",    "darken",
                                "lighten",    "color-dodge", "color-burn", "hard-light", "soft-light",
                                "difference", "exclusion",   "hue",        "saturation", "color",
                                "luminosity", "plus-lighter"};
constexpr std::array spreadNames{"pad", "reflect", "repeat"};
constexpr std::array capNames{"butt", "round", "square"};
constexpr std::array joinNames{"miter", "miter-clip", "round", "bevel"};
constexpr std::array ruleNames{"nonzero", "evenodd"};
constexpr std::array filterNames{"nearest", "bilinear", "trilinear", "bicubic"};
constexpr std::array maskNames{"luminance", "alpha"};
constexpr std::array transferNames{"table", "discrete", "linear", "gamma"};
constexpr std::array compositeNames{"over", "in", "out", "atop", "xor", "lighter", "arithmetic"};
constexpr std::array edgeNames{"duplicate", "wrap", "none"};
constexpr std::array channelNames{"r", "g", "b", "a"};

template <std::size_t N, class Enum>
const char* name(const std::array<const char*, N>& names, Enum value) {
    const auto i = std::size_t(value);
    return i < N ? names[i] : "?";
}

/// Adding zero turns -0 into 0.
std::string text(double v) { return fmt::format("{}", v + 0.0); }
std::string text(float v) { return fmt::format("{}", v + 0.0f); }
std::string text(Point p) { return text(p.x) + " " + text(p.y); }
std::string text(const Color& c) {
    return "rgba(" + text(c.r) + " " + text(c.g) + " " + text(c.b) + " " + text(c.a) + ")";
}
std::string matrix(const Affine& m) {
    return m == identity ? "" : " matrix(" + text(m[0]) + " " + text(m[1]) + " " + text(m[2]) + ")";
}

struct CommandText {
    std::string operator()(const MoveTo& c) const { return "M " + text(c.to); }
    std::string operator()(const LineTo& c) const { return "L " + text(c.to); }
    std::string operator()(const QuadTo& c) const { return "Q " + text(c.control) + " " + text(c.to); }
    std::string operator()(const CubicTo& c) const {
        return "C " + text(c.control1) + " " + text(c.control2) + " " + text(c.to);
    }
    std::string operator()(const ArcTo& c) const {
        return fmt::format("A {} {} {:d} {:d} {}", text(c.radii), text(c.rotation), c.largeArc, c.sweep,
                           text(c.to));
    }
    std::string operator()(const Close&) const { return "Z"; }
};

std::string text(const StrokeStyle& s) {
    std::string line = "stroke " + text(s.width) + " " + name(capNames, s.cap) + " " +
                       name(joinNames, s.join) + " limit " + text(s.miterLimit);
    if (!s.dashes.empty()) {
        line += " dashes";
        for (const double length : s.dashes)
            line.append(" ").append(text(length));
        line += " phase " + text(s.dashPhase);
    }
    return line;
}

template <class Gradient>
std::string gradientTail(const Gradient& g) {
    std::string line = std::string(" ") + name(spreadNames, g.spread) + matrix(g.transform);
    for (const GradientStop& stop : g.stops)
        line.append(" ").append(text(stop.offset)).append(" ").append(text(stop.color));
    return line;
}

std::string list(std::span<const float> numbers) {
    std::string line;
    for (const float v : numbers)
        line.append(" ").append(text(v));
    return line;
}

struct LightText {
    std::string operator()(const DistantLight& l) const {
        return " distant" + list(std::array{l.azimuth, l.elevation});
    }
    std::string operator()(const PointLight& l) const { return " point" + list(l.position); }
    std::string operator()(const SpotLight& l) const {
        return " spot" + list(l.position) + list(l.pointsAt) + list(std::array{l.exponent, l.coneAngle});
    }
};

struct OperationText {
    std::string operator()(const BlendFilter& f) const {
        return std::string("blend ") + name(blendNames, f.mode);
    }
    std::string operator()(const ColorMatrixFilter& f) const { return "matrix" + list(f.matrix); }
    std::string operator()(const ComponentTransferFilter& f) const {
        std::string line = "transfer";
        for (const TransferFunction& function : f.functions)
            line += std::string(" ") + name(transferNames, function.kind) + list(function.values);
        return line;
    }
    std::string operator()(const CompositeFilter& f) const {
        return std::string("composite ") + name(compositeNames, f.op) + list(f.k);
    }
    std::string operator()(const ConvolveMatrixFilter& f) const {
        return fmt::format("convolve {} x {} target {} {} edge {}", f.columns, f.rows, f.targetX, f.targetY,
                           name(edgeNames, f.edge)) +
               (f.preserveAlpha ? " preserve-alpha" : "") + list(std::array{f.divisor, f.bias}) +
               list(f.kernel);
    }
    std::string operator()(const LightingFilter& f) const {
        return (f.specular ? "specular" : "diffuse") +
               list(std::array{f.surfaceScale, f.constant, f.exponent}) + " " + text(f.color) +
               std::visit(LightText{}, f.light);
    }
    std::string operator()(const DisplacementMapFilter& f) const {
        return fmt::format("displace {} {} {}", text(f.scale), name(channelNames, f.x),
                           name(channelNames, f.y));
    }
    std::string operator()(const DropShadowFilter& f) const {
        return "shadow" + list(std::array{f.dx, f.dy, f.deviationX, f.deviationY}) + " " + text(f.color);
    }
    std::string operator()(const FloodFilter& f) const { return "flood " + text(f.color); }
    std::string operator()(const GaussianBlurFilter& f) const {
        return "blur" + list(std::array{f.deviationX, f.deviationY});
    }
    std::string operator()(const PictureFilter&) const { return "picture"; }
    std::string operator()(const MergeFilter&) const { return "merge"; }
    std::string operator()(const MorphologyFilter& f) const {
        return (f.dilate ? "dilate" : "erode") + list(std::array{f.radiusX, f.radiusY});
    }
    std::string operator()(const OffsetFilter& f) const { return "offset" + list(std::array{f.dx, f.dy}); }
    std::string operator()(const TileFilter&) const { return "tile"; }
    std::string operator()(const TurbulenceFilter& f) const {
        return fmt::format("{} {} {} octaves {} seed {}{}", f.fractalNoise ? "noise" : "turbulence",
                           text(f.frequencyX), text(f.frequencyY), f.octaves, f.seed,
                           f.stitch ? " stitched" : "");
    }
};

class Dumper {
public:
    std::string run(const Scene& s) {
        line("scene " + text(s.width) + " x " + text(s.height));
        group("group", s.root);
        return std::move(out_);
    }

private:
    class Indent {
    public:
        explicit Indent(Dumper& d) : dumper_(d) { ++dumper_.depth_; }
        ~Indent() { --dumper_.depth_; }
        Indent(const Indent&) = delete;
        Indent& operator=(const Indent&) = delete;

    private:
        Dumper& dumper_;
    };

    void line(const std::string& content) {
        out_.append(2 * std::size_t(depth_), ' ');
        out_ += content + "\n";
    }

    /// "kind #3", and whether that is the first use. Nothing may be there: "kind none".
    template <class Part>
    std::pair<std::string, bool> label(const std::string& kind, const std::shared_ptr<const Part>& part) {
        if (!part)
            return {kind + " none", false};
        const auto [entry, isNew] = numbers_.emplace(part.get(), numbers_.size() + 1);
        return {fmt::format("{} #{}", kind, entry->second), isNew};
    }

    bool tooDeep() {
        if (depth_ <= 2 * maxNesting)  // a clip or mask and its group take two steps of indentation each
            return false;
        line("...");
        return true;
    }

    void group(std::string head, const Group& g) {
        if (g.opacity != 1)
            head += " opacity " + text(g.opacity);
        if (g.blend != BlendMode::Normal)
            head += std::string(" blend ") + name(blendNames, g.blend);
        line(head);
        Indent in(*this);
        if (tooDeep())
            return;
        if (g.clip)
            clip(g.clip);
        if (g.mask)
            mask(g.mask);
        if (g.filter)
            filter(g.filter);
        for (const Node& child : g.children)
            node(child);
    }

    void node(const Node& n) {
        limits::check();
        std::visit([this](const auto& value) { write(value); }, n.value);
    }

    void write(const Group& g) { group("group", g); }

    template <class Shaped>
    static std::string geometry(const Shaped& s) {
        const auto* rule = std::get_if<FillRule>(&s.geometry);
        return rule ? std::string("fill ") + name(ruleNames, *rule) : text(std::get<StrokeStyle>(s.geometry));
    }

    void write(const Select& s) {
        line("select " + geometry(s.mask) + matrix(s.mask.transform));
        Indent in(*this);
        if (tooDeep())
            return;
        path(s.mask.path);
        side("inside", s.inside);
        side("outside", s.outside);
    }

    void side(const char* kind, const std::shared_ptr<const Group>& g) {
        const auto [head, isNew] = label(kind, g);
        isNew ? group(head, *g) : line(head);
    }

    void write(const Item& i) {
        std::string head = geometry(i);
        if (i.opacity != 1)
            head += " opacity " + text(i.opacity);
        line(head + matrix(i.transform));
        Indent in(*this);
        path(i.path);
        std::visit([&](const auto& p) { paint(p); }, i.paint);
    }

    void path(const std::shared_ptr<const Path>& shape) {
        auto [head, isNew] = label("path", shape);
        if (isNew)
            for (const Command& c : *shape)
                head += " " + std::visit(CommandText{}, c);
        line(head);
    }

    void paint(const Color& c) { line(text(c)); }
    void paint(const LinearGradient& g) {
        line("linear " + text(g.start) + " " + text(g.end) + gradientTail(g));
    }
    void paint(const RadialGradient& g) {
        line("radial " + text(g.center) + " " + text(g.radius) + " " + text(g.focus) + " " +
             text(g.focalRadius) + gradientTail(g));
    }
    void paint(const Pattern& p) {
        line("pattern " + text(p.min) + " " + text(p.max) + matrix(p.transform));
        Indent in(*this);
        content(p.content);
    }
    void paint(const ImagePaint& p) {
        auto [head, isNew] = label("image", p.bitmap);
        if (isNew)
            head += fmt::format(" {} x {}", p.bitmap->width, p.bitmap->height);
        line(head + " " + name(filterNames, p.filter) + matrix(p.transform));
    }

    void paint(const Material& m) {
        line(fmt::format("material {} {} bytes ", m.name, m.glsl.size()) + text(m.fallback) +
             matrix(m.transform));
    }

    void content(const std::shared_ptr<const Group>& g) {
        const auto [head, isNew] = label("group", g);
        isNew ? group(head, *g) : line(head);
    }

    void clip(const std::shared_ptr<const Clip>& shapes) {
        const auto [head, isNew] = label("clip", shapes);
        line(head);
        Indent in(*this);
        if (!isNew || tooDeep())
            return;
        if (shapes->clip)
            clip(shapes->clip);
        for (const ClipShape& shape : shapes->shapes)
            clipShape(shape);
    }

    void clipShape(const ClipShape& shape) {
        line(std::string("shape ") + name(ruleNames, shape.rule) + matrix(shape.transform));
        Indent in(*this);
        path(shape.path);
        if (shape.clip)
            clip(shape.clip);
    }

    void mask(const std::shared_ptr<const Mask>& shapes) {
        auto [head, isNew] = label("mask", shapes);
        if (isNew)
            head += std::string(" ") + name(maskNames, shapes->kind) + (shapes->linear ? " linear" : "");
        line(head);
        Indent in(*this);
        if (isNew)
            content(shapes->content);
    }

    void filter(const std::shared_ptr<const Filter>& shared) {
        const auto [head, isNew] = label("filter", shared);
        if (!isNew)
            return line(head);
        const Filter& f = *shared;
        line(head + " " + text(f.min) + " " + text(f.max) + matrix(f.transform));
        Indent in(*this);
        for (std::size_t i = 0; i < f.primitives.size(); ++i)
            primitive(i, f.primitives[i]);
    }

    void primitive(std::size_t index, const FilterPrimitive& p) {
        std::string head = std::to_string(index) + ": " + std::visit(OperationText{}, p.operation);
        for (const FilterInput& input : p.inputs)
            head += input.kind == FilterInput::Kind::SourceGraphic ? " source"
                    : input.kind == FilterInput::Kind::SourceAlpha ? " alpha"
                                                                   : " " + std::to_string(input.result);
        line(head + (p.linear ? " linear in " : " in ") + text(p.min) + " " + text(p.max));
        Indent in(*this);
        if (const auto* picture = std::get_if<PictureFilter>(&p.operation); picture && !tooDeep())
            content(picture->content);
    }

    std::string out_;
    int depth_ = 0;
    std::unordered_map<const void*, std::size_t> numbers_;
};

}  // namespace

std::string dump(const Scene& scene) { return Dumper().run(scene); }

}  // namespace vtm::scene
