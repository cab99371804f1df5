#include "conformance/vgscript/src/path_text.hpp"

#include <fmt/format.h>

#include <vtm/svg/load.hpp>

namespace vtm::vgscript {

namespace {

/// Appends a command and its points.
struct Appender {
    PathData& data;

    void append(VGPathCommand command, std::initializer_list<double> numbers) const {
        data.segments.push_back(VGubyte(command));
        for (const double number : numbers)
            data.coordinates.push_back(VGfloat(number));
    }
    void operator()(const scene::MoveTo& c) const { append(VG_MOVE_TO_ABS, {c.to.x, c.to.y}); }
    void operator()(const scene::LineTo& c) const { append(VG_LINE_TO_ABS, {c.to.x, c.to.y}); }
    void operator()(const scene::QuadTo& c) const {
        append(VG_QUAD_TO_ABS, {c.control.x, c.control.y, c.to.x, c.to.y});
    }
    void operator()(const scene::CubicTo& c) const {
        append(VG_CUBIC_TO_ABS, {c.control1.x, c.control1.y, c.control2.x, c.control2.y, c.to.x, c.to.y});
    }
    /// SVG's sweep turns from x towards y, which OpenVG calls counter-clockwise.
    void operator()(const scene::ArcTo& c) const {
        const VGPathCommand command = c.largeArc ? (c.sweep ? VG_LCCWARC_TO_ABS : VG_LCWARC_TO_ABS)
                                                 : (c.sweep ? VG_SCCWARC_TO_ABS : VG_SCWARC_TO_ABS);
        append(command, {c.radii.x, c.radii.y, c.rotation * 180 / 3.14159265358979323846, c.to.x, c.to.y});
    }
    void operator()(const scene::Close&) const { append(VGPathCommand(VG_CLOSE_PATH), {}); }
};

}  // namespace

PathData pathData(const std::string& text) {
    // A stroke with caps: the importer leaves out what covers nothing.
    const std::string document = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'>"
        "<path fill='none' stroke='#000' stroke-linecap='round' d='{}'/></svg>",
        text);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(document.data());
    const svg::Document read = svg::load({bytes, document.size()});
    PathData data;
    for (const scene::Node& node : read.scene.root.children)
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            for (const scene::Command& command : *item->path)
                std::visit(Appender{data}, command);
    return data;
}

}  // namespace vtm::vgscript
