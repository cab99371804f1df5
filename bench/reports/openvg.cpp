// OpenVG against cairo: the same outlines, colours and matrices, one call a shape, into the same kind of
// bitmap.

#include <cmath>
#include <random>
#include <variant>
#include <vector>

#include <fmt/core.h>
#include <glm/trigonometric.hpp>

#include "bench/engines/peer_cairo.hpp"
#include "bench/engines/vg_canvas.hpp"
#include "bench/input/files.hpp"
#include "bench/input/font.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/openvg_pixels.hpp"
#include "bench/reports/openvg_shaders.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

using scene::Affine;
using scene::Path;

constexpr int side = VgCanvas::side;
constexpr Budget workloadBudget{4000, 1000};

// ---- cairo ----------------------------------------------------------------------------------------

class Cairo {
public:
    void add(const Shape& shape) { shapes_.push_back(shape); }
    void change(std::size_t i, const Path& path) { shapes_[i].path = path; }
    void draw(const Affine& view) { canvas_.draw(shapes_, view, {1, 1, 1, 1}); }

private:
    CairoCanvas canvas_{side, side};
    std::vector<Shape> shapes_;
};

// ---- Workloads ------------------------------------------------------------------------------------

/// What is drawn in frame i.
struct Workload {
    std::string name;
    std::vector<Shape> shapes;
    std::function<Affine(int i)> view;
    std::function<Path(int i)> edited;  ///< the first shape's outline, where it changes every frame
};

Affine turned(double degrees, double zoom) {
    const double a = glm::radians(degrees), c = zoom * std::cos(a), s = zoom * std::sin(a), m = side / 2.0;
    return scene::compose(Affine{c, s, -s, c, m, m}, scene::translation(-m, -m));
}

void collect(const scene::Group& group, const Affine& fit, std::vector<Shape>& shapes) {
    for (const scene::Node& node : group.children) {
        if (const auto* inner = std::get_if<scene::Group>(&node.value)) {
            collect(*inner, fit, shapes);
        } else if (const auto* item = std::get_if<scene::Item>(&node.value)) {
            auto geometry = item->geometry;
            if (const auto* stroke = std::get_if<scene::StrokeStyle>(&geometry))
                geometry = scene::StrokeStyle{
                    .width = stroke->width, .miterLimit = stroke->miterLimit, .dashes = {}};
            const auto* color = std::get_if<scene::Color>(&item->paint);
            Shape shape{withoutArcs(*item->path), scene::compose(fit, item->transform), geometry,
                        color ? *color : scene::Color{0.5f, 0.5f, 0.5f, 1}};
            shape.color.a *= item->opacity;
            shapes.push_back(std::move(shape));
        }
    }
}

std::vector<Shape> shapesOf(const scene::Scene& scene) {
    std::vector<Shape> shapes;
    const double scale = side / std::max(scene.width, scene.height);
    collect(scene.root, scene::scaling(scale, scale), shapes);
    return shapes;
}

/// A closed curve of some quadratics round a point.
Path flower(scene::Point center, double radius, int petals, double depth) {
    const auto at = [&](double turn, double r) {
        return center +
               r * scene::Point(std::cos(glm::radians(360 * turn)), std::sin(glm::radians(360 * turn)));
    };
    Path path{scene::MoveTo{at(0, radius)}};
    for (int i = 0; i < petals; ++i)
        path.emplace_back(
            scene::QuadTo{at((i + 0.5) / petals, depth * radius), at((i + 1.0) / petals, radius)});
    path.emplace_back(scene::Close{});
    return path;
}

/// Crosses itself everywhere.
Path polygon(unsigned seed, int points) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, side);
    std::vector<scene::Point> corners;
    for (int i = 0; i < points; ++i)
        corners.emplace_back(place(random), place(random));
    return scene::polygon(corners);
}

std::vector<Workload> workloads(const std::vector<File>& files, std::vector<std::string>& notes) {
    std::vector<Workload> all;
    const auto turning = [](int i) { return turned(7 * i, 1); };
    for (const File& file : files) {
        const std::vector<Shape> shapes = shapesOf(load(file));
        all.push_back({file.name + ", turning", shapes, turning, {}});
        all.push_back(
            {file.name + ", turning at 8 times", shapes, [](int i) { return turned(7 * i, 8); }, {}});
    }
    Workload small{"10 000 small paths", {}, turning, {}};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(0, side), radius(3, 8);
    for (int i = 0; i < 10000; ++i)
        small.shapes.push_back({flower({place(random), place(random)}, radius(random), 5 + i % 4, 0.3)});
    all.push_back(std::move(small));

    std::string why;
    if (const std::optional<scene::Scene> font = fontSheet("", why)) {
        const std::vector<Shape> glyphs = shapesOf(*font);
        Workload text{"2000 glyphs of about 14 pixels", {}, turning, {}};
        for (int i = 0; i < 2000; ++i) {
            Shape glyph = glyphs[std::size_t(i) % glyphs.size()];
            const double scale = 0.16;
            const scene::Point moved(double(i % 50) * 20, double(i / 50) * 25);
            glyph.toPicture = scene::compose(Affine{scale, 0, 0, scale, moved.x, moved.y}, glyph.toPicture);
            text.shapes.push_back(std::move(glyph));
        }
        all.push_back(std::move(text));
    } else {
        notes.push_back("2000 glyphs: missing, " + why);
    }
    const auto edited = [](int i) { return flower({512, 512}, 400, 40, 0.7 + 0.2 * std::sin(i)); };
    const auto still = [](int) { return scene::identity; };
    all.push_back({"one path edited every frame", {{edited(0)}}, still, edited});
    all.push_back({"a random polygon of 3000 points every frame", {{polygon(0, 3000)}}, still, [](int i) {
                       return polygon(unsigned(i), 3000);
                   }});
    return all;
}

template <class Canvas>
void drawFrame(Canvas& canvas, const Workload& workload, int i) {
    if (workload.edited)
        canvas.change(0, workload.edited(i));
    canvas.draw(workload.view(i));
}

/// The same by shaders, on a canvas that replaces the current one.
void addShaders(const Workload& workload, double spend, Json& row) {
    VgCanvas canvas(VTM_COMPOSITOR_GL);
    if (!canvas.isDrawnBy(VTM_COMPOSITOR_GL))
        return;
    for (const Shape& shape : workload.shapes)
        canvas.add(shape);
    addShaderColumns([&](int i) { drawFrame(canvas, workload, i); }, spend, row);
}

Json callsRow(const Workload& workload, double spend) {
    VgCanvas ours;
    for (const Shape& shape : workload.shapes)
        ours.add(shape);
    const double first = spentTime([&] { drawFrame(ours, workload, 0); });
    Json row{{"workload", workload.name}, {"shapes", workload.shapes.size()}, {"first frame ms", first}};
    if (cairoVersion()) {
        Cairo cairo;
        for (const Shape& shape : workload.shapes)
            cairo.add(shape);
        int cairoFrame = 0, ourFrame = 0;
        const Paired paired = pairwise([&] { drawFrame(cairo, workload, ++cairoFrame); },
                                       [&] { drawFrame(ours, workload, ++ourFrame); }, spend, 100);
        row["cairo ms"] = paired.first;
        row["OpenVG ms"] = paired.second;
        row["OpenVG / cairo"] = paired.ratio;
        row["quartiles"] = fmt::format("{:.2f} to {:.2f}", paired.low, paired.high);
    } else {
        std::vector<double> times;
        for (int i = 1; i <= 20; ++i)
            times.push_back(spentTime([&] { drawFrame(ours, workload, i); }));
        row["OpenVG ms"] = median(times);
    }
    if (!workload.edited && ours.record()) {
        int callsFrame = 0, recordedFrame = 0;
        const Paired recorded =
            pairwise([&] { drawFrame(ours, workload, ++callsFrame); },
                     [&] { ours.drawRecording(workload.view(++recordedFrame)); }, spend, 100);
        row["recorded ms"] = recorded.second;
        row["recorded / OpenVG"] = recorded.ratio;
    }
    return row;
}

void addWorkload(const Workload& workload, double spend, Report& report) {
    Json row = callsRow(workload, spend);
    addShaders(workload, spend, row);
    report.rows.push_back(std::move(row));
}

}  // namespace

Report openvg(const Options& options) {
    Report report;
    report.name = "openvg";
    report.title = "OpenVG against cairo";
    report.text =
        "vgDrawPath, a call a shape, into 1024 × 1024 pixels in memory, under a matrix that changes every "
        "frame; cairo's image "
        "backend gets the same outlines, colours and matrices in turns with it. CPU milliseconds a frame, "
        "medians, and the median "
        "of the ratios pair by pair. Paints other than colours are grey, strokes have cairo's default caps "
        "and joins in both. The first "
        "frame of OpenVG covers paths without compiling them, the second one compiles them; edited paths are "
        "never "
        "compiled. Recorded: the same calls made once between vtmBeginRecording "
        "and vtmEndRecording, and drawn in turns with them by one vtmDrawRecording. Images, gradients and "
        "rectangles are drawn into 800 × 800 "
        "pixels, images of 512 × 512 are copied and blurred; cairo has no blur. Text: vgDrawGlyphs and "
        "cairo_show_glyphs, which puts glyphs on whole pixels. NanoVG is not in Debian. By shaders: the "
        "compositor of OpenGL ES, "
        "whose CPU time includes the shaders' where the driver is a software renderer, as Mesa's llvmpipe; "
        "of "
        "these, own thread: what is left to the program's thread on any driver, coverage above all.";
    if (!cairoVersion())
        report.notes.push_back("cairo: missing (librsvg2-dev)");
    for (const Workload& workload : workloads(oneFileOf(options), report.notes))
        addWorkload(workload, workloadBudget.of(options), report);
    addPixelRows(workloadBudget.of(options), report);
    return report;
}

}  // namespace vtm::bench
