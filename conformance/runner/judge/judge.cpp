#include "conformance/runner/judge/judge.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

namespace vtm::conformance {
namespace {

using image::Raster;

/// Values of a channel that differ by less are the same: rounding of single precision.
constexpr float sameValue = 1e-5f;

bool same(const float* a, const float* b) {
    for (int c = 0; c < 4; ++c)
        if (!(std::abs(a[c] - b[c]) <= sameValue))
            return false;
    return true;
}

bool flatAt(const Raster& raster, int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (!same(raster.pixel(x, y), raster.pixel(x + dx, y + dy)))
                return false;
    return true;
}

double worstChannel(const float* a, const float* b) {
    double worst = 0;
    for (int c = 0; c < 4; ++c) {
        const double d = 255 * std::abs(double(a[c]) - double(b[c]));
        worst = std::isnan(d) ? Bounds::any : std::max(worst, d);
    }
    return worst;
}

double flatError(const Raster& expected, const Raster& drawn) {
    double worst = 0;
    for (int y = 1; y + 1 < expected.height; ++y)
        for (int x = 1; x + 1 < expected.width; ++x)
            if (const double error = worstChannel(expected.pixel(x, y), drawn.pixel(x, y));
                error > worst && flatAt(expected, x, y))
                worst = error;
    return worst;
}

std::string brokenBound(const Figure& figure, const Bounds& bounds) {
    const compare::Difference& d = figure.difference;
    // Written so that what is not a number breaks its bound.
    if (!(d.max <= bounds.max))
        return fmt::format("max {:.3f} at {}, {} (at most {})", d.max, d.worstX, d.worstY, bounds.max);
    if (!(d.rms <= bounds.rms))
        return fmt::format("rms {:.3f} (at most {})", d.rms, bounds.rms);
    if (!(d.mean <= bounds.mean))
        return fmt::format("mean {:.4f} (at most {:.4f})", d.mean, bounds.mean);
    if (!(d.p999 <= bounds.p999))
        return fmt::format("p99.9 {:.3f} (at most {})", d.p999, bounds.p999);
    if (!(figure.flat <= bounds.flat))
        return fmt::format("{:.3f} where all is flat (at most {})", figure.flat, bounds.flat);
    return {};
}

/// Broken bounds first, then the larger difference.
bool worse(const Figure& a, const Figure& b) {
    if (a.broken.empty() != b.broken.empty())
        return !a.broken.empty();
    return a.difference.max > b.difference.max;
}

/// Collects what a case shows, and keeps the pictures of the worst.
class Findings {
public:
    Findings(bool keepPictures) : keepPictures_(keepPictures) {}

    void add(Figure figure, const Raster& expected, const Raster& drawn) {
        if ((keepPictures_ || !figure.broken.empty()) && (!worst_ || worse(figure, *worst_))) {
            worst_ = figure;
            pictures_ = Pictures{figure.engine, figure.view, expected, drawn};
        }
        const auto known = std::ranges::find(figures_, figure.engine, &Figure::engine);
        if (known == figures_.end())
            figures_.push_back(std::move(figure));
        else if (worse(figure, *known))
            *known = std::move(figure);
    }

    Outcome outcome() const {
        if (figures_.empty())
            return Outcome::skipped("no engine that was asked for draws this");
        Outcome outcome;
        for (const Figure& figure : figures_)
            if (!figure.broken.empty()) {
                outcome.status = Outcome::Status::Failed;
                outcome.message += fmt::format("{}{}, {}: {}", outcome.message.empty() ? "" : "; ",
                                               figure.engine, figure.view, figure.broken);
            }
        outcome.figures = figures_;
        outcome.pictures = pictures_;
        return outcome;
    }

private:
    bool keepPictures_;
    std::vector<Figure> figures_;
    std::optional<Figure> worst_;
    std::optional<Pictures> pictures_;
};

}  // namespace

Figure measure(const Raster& expected, const Raster& drawn, const Bounds& bounds) {
    Figure figure;
    if (expected.width != drawn.width || expected.height != drawn.height) {
        figure.difference.max = figure.flat = Bounds::any;
        figure.broken = fmt::format("{} x {} pixels instead of {} x {}", drawn.width, drawn.height,
                                    expected.width, expected.height);
        return figure;
    }
    figure.difference = compare::compare(drawn, expected);
    figure.flat = flatError(expected, drawn);
    figure.broken = brokenBound(figure, bounds);
    return figure;
}

namespace {

/// One view, all its engines.
class Look {
public:
    Look(Subject& subject, std::size_t view, const Setting& setting)
        : subject_(subject), view_(view), setting_(setting) {}

    void at(Engine engine, Raster& before, Findings& findings) {
        if (!expected_)
            expected_ = subject_.expected(view_);
        const Raster drawn = draw(engine);
        const Raster shown = damaged(drawn, setting_.fault, before);
        before = drawn;
        const Bounds bounds = subject_.bounds(engine);
        Figure figure = measure(*expected_, shown, bounds);
        figure.engine = nameOf(engine);
        figure.view = subject_.labelOf(view_);
        if (figure.broken.empty() && (engine == Engine::Gl || engine == Engine::Scan))
            figure.broken = brokenTwin(shown, bounds.twin);
        findings.add(std::move(figure), *expected_, shown);
    }

private:
    Raster draw(Engine engine) {
        if (engine != Engine::Asset)
            return subject_.drawn(view_, engine);
        if (!asset_)
            asset_ = subject_.drawn(view_, engine);
        return *asset_;
    }
    std::string brokenTwin(const Raster& shown, double twin) {
        if (twin == Bounds::any)
            return {};
        const compare::Difference d = compare::compare(shown, draw(Engine::Asset));
        return d.max <= twin ? std::string()
                             : fmt::format("{:.3f} off the asset's own evaluator at {}, {} (at most {})",
                                           d.max, d.worstX, d.worstY, twin);
    }

    Subject& subject_;
    std::size_t view_;
    const Setting& setting_;
    std::optional<Raster> expected_, asset_;
};

}  // namespace

Outcome judge(Subject& subject, const Setting& setting) {
    Findings findings(setting.keepPictures);
    std::map<Engine, Raster> before;
    for (std::size_t view = 0; view < subject.views(); ++view) {
        Look look(subject, view, setting);
        for (const Engine engine : subject.engines(view))
            if (std::ranges::find(setting.engines, engine) != setting.engines.end())
                look.at(engine, before[engine], findings);
    }
    return findings.outcome();
}

}  // namespace vtm::conformance
