#include "conformance/runner/suite/views.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <vtm/scene/affine.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/cases/texture_views.hpp"

namespace vtm::conformance {
namespace {

using scene::Point;

/// Uniform in [low, high), the same on every machine; std's distributions are not.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * std::ldexp(double(engine_() >> 11), -53);
    }
    std::size_t below(std::size_t n) { return std::size_t(engine_() % n); }

private:
    std::mt19937_64 engine_;
};

void collect(const scene::Path& path, const scene::Affine& transform, std::vector<Point>& points) {
    for (const scene::Command& command : path)
        if (const auto end = scene::endOf(command))
            points.push_back(scene::apply(transform, *end));
}

void collect(const scene::Group& group, std::vector<Point>& points) {
    for (const scene::Node& node : group.children) {
        if (const auto* child = std::get_if<scene::Group>(&node.value))
            collect(*child, points);
        else if (const auto* item = std::get_if<scene::Item>(&node.value))
            collect(*item->path, item->transform, points);
        else if (const auto& select = std::get<scene::Select>(node.value); select.mask.path)
            collect(*select.mask.path, select.mask.transform, points);
    }
}

/// Where it is worth looking: the middle, and ends of commands inside the picture.
std::vector<Point> focuses(const scene::Scene& scene) {
    std::vector<Point> points;
    collect(scene.root, points);
    std::erase_if(points, [&](Point p) {
        return !(p.x >= 0 && p.y >= 0 && p.x <= scene.width && p.y <= scene.height);
    });
    points.push_back({scene.width / 2, scene.height / 2});
    return points;
}

LabelledView affineView(const ViewPlan& plan, const scene::Scene& scene, const std::vector<Point>& focuses,
                        Random& random) {
    const double pixels = std::exp2(random.uniform(std::log2(plan.fewest), std::log2(plan.maximum)));
    const double scale = pixels / std::max(scene.width, scene.height);
    const double angle = random.uniform(0, 2 * std::numbers::pi),
                 lean = random.uniform(-plan.shear, plan.shear);
    const double mirror = random.below(4) == 0 ? -1 : 1;
    const Point x = scale * Point(std::cos(angle), std::sin(angle));
    const Point y = mirror * scale * Point(-std::sin(angle + lean), std::cos(angle + lean));
    const Point target =
        plan.raster / 2.0 + Point(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)) * double(plan.raster);
    // A picture smaller than the raster is seen whole, a larger one where it is interesting.
    const bool whole = pixels < plan.raster;
    const Point focus =
        whole ? Point(scene.width / 2, scene.height / 2) : focuses[random.below(focuses.size())];
    return {{plan.raster, plan.raster, {x, y, target - focus.x * x - focus.y * y}},
            fmt::format("{:.0f} px turned by {:.0f} degrees", pixels, angle * 180 / std::numbers::pi),
            {}};
}

LabelledView floorView(const ViewPlan& plan, Random& random) {
    const cases::Floor floor{plan.raster * 2, plan.raster, plan.ratio,
                             plan.raster * random.uniform(0.15, 0.4)};
    return {{floor.width, floor.height, {}},
            fmt::format("floor up to {} : 1, horizon {:.1f} px above", plan.ratio, floor.horizon),
            floor.toPicture(1)};
}

/// The longer side is `size` pixels, the other one the nearest number that is none too few.
LabelledView wholeView(const scene::Scene& scene, int size) {
    const double longer = std::max(scene.width, scene.height);
    const auto pixels = [&](double side) { return std::max(1, int(std::lround(side / longer * size))); };
    const int width = pixels(scene.width), height = pixels(scene.height);
    return {{width, height, {width / scene.width, 0, 0, height / scene.height, 0, 0}},
            fmt::format("{} px", size),
            {}};
}

/// Whole pictures, and turned parts of the same rasters magnified up to `maximum` pixels.
std::vector<LabelledView> viewsAtSizes(const ViewPlan& plan, const scene::Scene& scene,
                                       const std::vector<Point>& focuses, Random& random) {
    std::vector<LabelledView> views;
    for (const int size : plan.sizes) {
        views.push_back(wholeView(scene, size));
        ViewPlan part = plan;
        part.raster = size;
        part.fewest = size;
        views.push_back(affineView(part, scene, focuses, random));
        views.back().label = fmt::format("part at {} px ({})", size, views.back().label);
    }
    return views;
}

ViewPlan::Way wayOf(const std::string& name) {
    if (name == "affine")
        return ViewPlan::Way::Affine;
    if (name == "whole")
        return ViewPlan::Way::Whole;
    if (name == "sizes")
        return ViewPlan::Way::Sizes;
    if (name == "perspective")
        return ViewPlan::Way::Perspective;
    throw std::runtime_error("views: there is no way '" + name + "'");
}

}  // namespace

ViewPlan viewPlan(const nlohmann::json& json) {
    ViewPlan plan;
    for (const auto& [key, value] : json.items()) {
        if (key == "way")
            plan.way = wayOf(value.get<std::string>());
        else if (key == "count")
            plan.count = value.get<int>();
        else if (key == "raster")
            plan.raster = value.get<int>();
        else if (key == "pixels")
            plan.fewest = value.at(0).get<double>(), plan.maximum = value.at(1).get<double>();
        else if (key == "sizes")
            plan.sizes = value.get<std::vector<int>>();
        else if (key == "shear")
            plan.shear = value.get<double>();
        else if (key == "ratio")
            plan.ratio = value.get<double>();
        else if (key == "seed")
            plan.seed = value.get<std::uint64_t>();
        else
            throw std::runtime_error("views: there is no '" + key + "'");
    }
    if (plan.count < 1 || plan.raster < 1 || !(plan.fewest > 0) || !(plan.maximum >= plan.fewest))
        throw std::runtime_error("views: count and raster are at least 1, pixels are [fewest, most]");
    return plan;
}

std::uint64_t seedOf(const std::string& text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text)
        hash = (hash ^ std::uint8_t(c)) * 1099511628211u;
    return hash;
}

std::vector<LabelledView> viewsOf(const ViewPlan& plan, const scene::Scene& scene, const std::string& salt) {
    if (plan.way == ViewPlan::Way::Whole)
        return {{cases::wholePicture(scene, plan.raster), fmt::format("{} px", plan.raster), {}}};
    const std::vector<Point> points = focuses(scene);
    Random random(plan.seed ^ seedOf(salt));
    if (plan.way == ViewPlan::Way::Sizes)
        return viewsAtSizes(plan, scene, points, random);
    std::vector<LabelledView> views;
    for (int i = 0; i < plan.count; ++i) {
        views.push_back(plan.way == ViewPlan::Way::Affine ? affineView(plan, scene, points, random)
                                                          : floorView(plan, random));
        views.back().label = fmt::format("view {} ({})", i, views.back().label);
    }
    return views;
}

}  // namespace vtm::conformance
