#include "compiler/instances/alike_paths.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

#include "compiler/containers/hash.hpp"
#include "geometry/arc.hpp"

namespace vtm::compiler {
namespace {

using scene::Path;
using scene::Point;

/// Calls visit(point) for all points that a path is made of, and three of each arc's: an ellipse is known by
/// them.
template <class Visit>
class PointWalk {
public:
    explicit PointWalk(Visit visit) : visit_(std::move(visit)) {}

    void operator()(const scene::MoveTo& c) { visit(c.to); }
    void operator()(const scene::LineTo& c) { visit(c.to); }
    void operator()(const scene::QuadTo& c) {
        visit(c.control);
        visit(c.to);
    }
    void operator()(const scene::CubicTo& c) {
        visit(c.control1);
        visit(c.control2);
        visit(c.to);
    }
    void operator()(const scene::ArcTo& c) {
        const auto arc = geometry::centerForm({last_, c.radii, c.rotation, c.largeArc, c.sweep, c.to});
        for (const double share : {0.25, 0.5, 0.75})
            visit_(arc ? arc->at(arc->start + share * arc->sweep) : glm::mix(last_, c.to, share));
        visit(c.to);
    }
    void operator()(const scene::Close&) {}

private:
    void visit(Point p) {
        visit_(p);
        last_ = p;
    }
    Visit visit_;
    Point last_{0};
};

/// Of a turn, the one of a few usual ones that moves no point by more than `slack`: then instances of one
/// size have one matrix, bit for bit.
std::complex<double> usual(std::complex<double> factor, double slack) {
    const double length = std::abs(factor);
    if (!(length > 0))
        return factor;
    const std::complex<double> unit = factor / length;
    for (const std::complex<double> turn : {std::complex<double>(1, 0), {-1, 0}, {0, 1}, {0, -1}})
        if (std::abs(factor - turn) <= slack)
            return turn;
        else if (std::abs(factor - length * turn) <= slack)
            return length * turn;
    return std::abs(factor - unit) <= slack ? unit : factor;
}

/// The largest distance from the first point. By squares first, which are off by a few roundings.
double sizeOf(std::span<const std::complex<double>> points) {
    double largest = 0;
    for (const std::complex<double> p : points)
        largest = std::max(largest, std::norm(p - points.front()));
    constexpr double safe = 0x1p900, rounding = 0x1p-40;
    const double close = largest > 1 / safe && largest < safe ? largest * (1 - rounding) : 0;
    double size = 0;
    for (const std::complex<double> p : points)
        if (std::norm(p - points.front()) >= close)
            size = std::max(size, std::abs(p - points.front()));
    return size;
}

/// Steps of a distance in a radius; what is farther is not compared.
constexpr double distanceSteps = 4096, farDistance = 0xFFFF;

}  // namespace

void AlikePaths::findPoints(const Path& path, Points& points) {
    points.commands = 0;
    points.mean = 0;
    points.fromMean.clear();
    PointWalk walk([&](Point p) { points.fromMean.emplace_back(p.x, p.y); });
    for (const scene::Command& command : path) {
        points.commands = hashCombine(points.commands, command.index());
        std::visit(walk, command);
    }
    for (const Complex p : points.fromMean)
        points.mean += p;
    const auto count = double(points.fromMean.size());
    points.mean /= count;
    double squares = 0;
    Complex moment = 0;
    for (Complex& p : points.fromMean) {
        p -= points.mean;
        squares += std::norm(p);
        moment += p * p;
    }
    points.radius = std::sqrt(squares / count);
    // The weight keeps shapes apart in which one part grows as the other shrinks.
    constexpr double weight = 1.618;
    points.form = 0;
    if (squares > 0)
        points.form = std::abs(points.fromMean.front()) / points.radius + weight * std::abs(moment) / squares;
}

AlikePaths::Distances AlikePaths::distancesOf(const Points& points) {
    Distances distances{};
    if (!(points.radius > 0))
        return distances;
    const std::size_t count = points.fromMean.size(), of = distances.size();
    for (std::size_t i = 0; i < of; ++i) {
        const Complex between =
            points.fromMean[count * i / of] - points.fromMean[count * ((i + 1) % of) / of];
        const double steps = std::abs(between) / points.radius * distanceSteps;
        distances[i] = std::uint16_t(steps < farDistance ? std::round(steps) : farDistance);
    }
    return distances;
}

/// Necessary for turnOf() to find a turn. If it moves no point farther than the slack from where it should
/// be, a distance is off by twice that, and the radius by no more than the slack.
bool AlikePaths::mayBeAlike(const Distances& from, const Distances& to, double slackInRadii) {
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double a = from[i], b = to[i];
        if (a < farDistance && b < farDistance &&
            std::abs(a - b) > slackInRadii * (2 * distanceSteps + a + 1) + 2)
            return false;
    }
    return true;
}

/// By least squares: the factor is the mean of conj(q) p over that of |q|².
std::optional<AlikePaths::Turn> AlikePaths::turnOf(const Points& from, const Points& to, double slack) {
    if (from.fromMean.size() != to.fromMean.size())
        return std::nullopt;
    if (from.radius == 0 || to.radius <= slack)
        return from.radius == 0 && to.radius == 0 ? std::optional(Turn{1, false}) : std::nullopt;
    const std::size_t count = from.fromMean.size();
    double reach = 0;
    Complex direct = 0, mirrored = 0;
    for (std::size_t i = 0; i < count; ++i) {
        direct += std::conj(from.fromMean[i]) * to.fromMean[i];
        mirrored += from.fromMean[i] * to.fromMean[i];
        reach = std::max(reach, std::abs(from.fromMean[i]));
    }
    const bool isMirrored = std::abs(mirrored) > std::abs(direct) * (1 + 0x1p-30);
    const double squares = double(count) * from.radius * from.radius;
    const Turn turn{usual((isMirrored ? mirrored : direct) / squares, slack / (2 * reach)), isMirrored};
    for (std::size_t i = 0; i < count; ++i) {
        const Complex q = isMirrored ? std::conj(from.fromMean[i]) : from.fromMean[i];
        if (!(std::abs(turn.factor * q - to.fromMean[i]) <= slack))
            return std::nullopt;
    }
    return turn;
}

AlikePaths::Image AlikePaths::image(std::uint32_t kind, const Kind& of, const Points& points,
                                    const Turn& turn) {
    const Complex y = turn.isMirrored ? Complex(0, -1) : Complex(0, 1);
    const Complex along = turn.factor, across = turn.factor * y;
    const Complex start = of.origin - of.points.mean;
    const Complex origin = points.mean + turn.factor * (turn.isMirrored ? std::conj(start) : start);
    return {kind,
            {Point(along.real(), along.imag()), Point(across.real(), across.imag()),
             Point(origin.real(), origin.imag())},
            std::abs(turn.factor),
            of.size};
}

AlikePaths::Kind AlikePaths::kindOf(Points points) {
    Kind kind{std::move(points), {}, 0};
    kind.origin = kind.points.mean + kind.points.fromMean.front();
    kind.size = sizeOf(kind.points.fromMean);
    return kind;
}

AlikePaths::Summary AlikePaths::summaryOf(const Path& path) {
    Points points;
    points.fromMean.reserve(3 * path.size());  // of cubics
    findPoints(path, points);
    return {points.commands,    points.mean, points.mean + points.fromMean.front(),
            points.radius,      points.form, sizeOf(points.fromMean),
            distancesOf(points)};
}

/// Of the path being added, if it is of that kind.
std::optional<AlikePaths::Image> AlikePaths::imageOf(std::uint32_t number, double slack) {
    First& first = firsts_[number];
    std::unique_ptr<const Kind> found;
    if (!first.kind) {
        Points points;
        findPoints(*first.path, points);
        found = std::make_unique<const Kind>(kindOf(std::move(points)));
    }
    const Kind& kind = found ? *found : *first.kind;
    const std::optional<Turn> turn = turnOf(kind.points, points_, slack);
    if (!turn)
        return std::nullopt;
    const Image made = image(number, kind, points_, *turn);
    if (found)
        first.kind = std::move(found);
    return made;
}

AlikePaths::Image AlikePaths::add(const Path& path, const Summary& summary, double slack) {
    const double form = summary.form, radius = summary.radius;
    auto& known = byCommands_[summary.commands];
    // Points, their mean and the radius may all be off by the slack.
    const double near = radius > 0 ? 8 * (1 + form) * slack / radius : 0;
    const double slackInRadii = radius > 0 ? slack / radius : 0;
    bool hasPoints = false;
    constexpr int maxTried = 32;  // the nearest
    auto above = known.lowerBound(form), below = above;
    for (int tried = 0; tried < maxTried; ++tried) {
        const double up = above == known.end() ? HUGE_VAL : known[above].key - form;
        const double down = below == known.begin() ? HUGE_VAL : form - known[known.before(below)].key;
        if (!(std::min(up, down) <= near))
            break;
        const bool isAbove = up <= down;
        below = isAbove ? below : known.before(below);
        const Known& nearest = known[isAbove ? above : below].value;
        above = isAbove ? known.next(above) : above;
        if (!mayBeAlike(nearest.distances, summary.distances, slackInRadii))
            continue;
        if (!std::exchange(hasPoints, true))
            findPoints(path, points_);
        if (const auto found = imageOf(nearest.kind, slack))
            return *found;
    }
    const auto number = std::uint32_t(firsts_.size());
    known.insert(form, {number, summary.distances});
    firsts_.push_back({&path, nullptr});
    Kind kind;
    kind.points.mean = summary.mean;
    kind.origin = summary.first;
    kind.size = summary.size;
    return image(number, kind, kind.points, {1, false});
}

}  // namespace vtm::compiler
