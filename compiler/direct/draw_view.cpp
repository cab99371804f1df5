#include <vtm/compiler/draw_view.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <vtm/limits/limits.hpp>
#include "compiler/compile/settings.hpp"
#include "compiler/compile/view_plan.hpp"
#include "compiler/direct/view_drawing.hpp"
#include "compiler/filters/compile_filtered.hpp"

namespace vtm::compiler {
namespace {

/// An empty picture.
scene::Scene emptyScene() {
    scene::Scene scene;
    scene.width = scene.height = 1;
    return scene;
}

bool isFlat(const asset::View& view) {
    const double determinant = glm::determinant(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    return !(std::abs(determinant) > std::numeric_limits<double>::min());
}

}  // namespace

std::unique_ptr<ViewDrawing::Impl> ViewDrawing::Impl::make(const scene::Scene& scene, const Excerpt& excerpt,
                                                           const asset::View& view, const Options& options) {
    auto made = std::make_unique<Impl>();
    made->width = view.width;
    made->height = view.height;
    if (hasFilters(scene)) {
        made->filtered = FilteredDrawing::make(scene, excerpt, view, options);
        if (!made->filtered)
            return nullptr;
        made->warnings = made->filtered->warnings;
    } else {
        made->plain = PlainDrawing::make(scene, excerpt, view, options);
        if (!made->plain)
            return nullptr;
        made->warnings = made->plain->warnings();
    }
    return made;
}

ViewDrawing::ViewDrawing(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
ViewDrawing::~ViewDrawing() = default;

std::unique_ptr<const ViewDrawing> ViewDrawing::make(const scene::Scene& scene, const scene::Frame& frame,
                                                     const Options& options) {
    const limits::Stage stage("compiling");
    const std::optional<ViewPlan> plan = planView(scene, frame, options);
    if (options.mode != asset::Mode::Exact)
        return nullptr;
    const scene::Scene nothing = emptyScene();
    std::unique_ptr<Impl> impl =
        plan ? Impl::make(scene, plan->excerpt, plan->view, plan->options)
             : Impl::make(nothing, wholeOf(nothing), {int(frame.width), int(frame.height)}, options);
    if (!impl)
        return nullptr;
    if (auto warning = plan ? plan->warning() : warningOfNothing(scene, frame))
        impl->warnings.push_back(std::move(*warning));
    return std::unique_ptr<const ViewDrawing>(new ViewDrawing(std::move(impl)));
}

std::unique_ptr<const ViewDrawing> ViewDrawing::make(const scene::Scene& scene, const asset::View& view,
                                                     const Options& options) {
    const limits::Stage stage("compiling");
    checkOptions(options);
    scene::validate(scene);
    asset::validate(view);
    if (options.mode != asset::Mode::Exact)
        return nullptr;
    const scene::Scene nothing = emptyScene();
    auto impl = isFlat(view) ? Impl::make(nothing, wholeOf(nothing), {view.width, view.height}, options)
                             : Impl::make(scene, wholeOf(scene), view, options);
    return impl ? std::unique_ptr<const ViewDrawing>(new ViewDrawing(std::move(impl))) : nullptr;
}

int ViewDrawing::width() const { return impl_->width; }
int ViewDrawing::height() const { return impl_->height; }
const std::vector<std::string>& ViewDrawing::warnings() const { return impl_->warnings; }

void ViewDrawing::draw(const asset::ByteTarget& target) const {
    if (impl_->plain)
        impl_->plain->draw(target);
    else
        impl_->filtered->picture.draw(target);
}

image::Raster ViewDrawing::draw() const {
    return impl_->plain ? impl_->plain->draw() : impl_->filtered->picture.draw();
}

void ViewDrawing::scan(int first, int end,
                       const std::function<void(int, const asset::ColorRun&)>& take) const {
    if (impl_->plain)
        return impl_->plain->scan(first, end, take);
    int y = first;
    impl_->filtered->picture.giveRows(first, end, [&](std::span<const float> row) {
        for (int x = 0; x < impl_->width; ++x) {
            const float* c = &row[4 * std::size_t(x)];
            take(y, {x, x + 1, {c[0], c[1], c[2], c[3]}});
        }
        ++y;
    });
}

}  // namespace vtm::compiler
