#include "api/openvg/src/path_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/trigonometric.hpp>

namespace vtm::openvg {

namespace {

constexpr std::array<int, 13> counts{0, 2, 2, 1, 1, 4, 6, 2, 4, 5, 5, 5, 5};

/// What no number is becomes 0 (section 3.3), what is out of reach the farthest that is not.
double tame(double v) {
    constexpr double farthest = std::numeric_limits<float>::max();
    return std::isnan(v) ? 0 : std::clamp(v, -farthest, farthest);
}

template <class T>
void appendNumbers(std::vector<double>& to, const void* data, std::size_t count) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < count; ++i) {
        T value;
        std::memcpy(&value, bytes + i * sizeof(T), sizeof(T));
        to.push_back(tame(double(value)));
    }
}

bool isSame(unsigned a, unsigned b) {
    const auto isArc = [](unsigned type) { return type >= VG_SCCWARC_TO && type <= VG_LCWARC_TO; };
    return a == b || (isArc(a) && isArc(b));
}

}  // namespace

int coordinateCount(unsigned segment) { return counts[segment >> 1]; }

bool isCommand(unsigned segment) { return segment >> 1 < counts.size(); }

// ---- Storage --------------------------------------------------------------------------------------

void PathData::clear() {
    commands_.clear();
    coordinates_.clear();
}

void PathData::read(const void* data, std::size_t first, std::size_t count) {
    std::vector<double> numbers;
    numbers.reserve(count);
    switch (datatype_) {
        case VG_PATH_DATATYPE_S_8:
            appendNumbers<std::int8_t>(numbers, data, count);
            break;
        case VG_PATH_DATATYPE_S_16:
            appendNumbers<std::int16_t>(numbers, data, count);
            break;
        case VG_PATH_DATATYPE_S_32:
            appendNumbers<std::int32_t>(numbers, data, count);
            break;
        default:
            appendNumbers<float>(numbers, data, count);
            break;
    }
    if (coordinates_.size() < first + count)
        coordinates_.resize(first + count);
    std::ranges::copy(numbers, coordinates_.begin() + std::ptrdiff_t(first));
}

void PathData::append(const VGubyte* commands, int count, const void* data) {
    std::size_t numbers = 0;
    for (int i = 0; i < count; ++i)
        numbers += std::size_t(coordinateCount(commands[i]));
    commands_.reserve(commands_.size() + std::size_t(count));
    read(data, coordinates_.size(), numbers);
    commands_.insert(commands_.end(), commands, commands + count);
}

void PathData::modify(int first, int count, const void* data) {
    std::size_t start = 0, numbers = 0;
    for (int i = 0; i < first + count; ++i)
        (i < first ? start : numbers) += std::size_t(coordinateCount(commands_[std::size_t(i)]));
    read(data, start, numbers);
}

double PathData::scaled(std::size_t i) const {
    return tame(double(scale_) * coordinates_[i] + double(bias_));
}

double PathData::stored(double coordinate) const {
    const double v = tame((coordinate - double(bias_)) / double(scale_));
    const auto rounded = [&](double least, double most) {
        return std::clamp(std::floor(v + 0.5), least, most);
    };
    switch (datatype_) {
        case VG_PATH_DATATYPE_S_8:
            return rounded(-128, 127);
        case VG_PATH_DATATYPE_S_16:
            return rounded(-32768, 32767);
        case VG_PATH_DATATYPE_S_32:
            return rounded(-2147483648.0, 2147483647.0);
        default:
            return double(float(v));
    }
}

void PathData::append(const PathData& other) {
    const std::size_t commands = other.commands_.size(), numbers = other.coordinates_.size();
    commands_.reserve(commands_.size() + commands);
    coordinates_.reserve(coordinates_.size() + numbers);
    for (std::size_t i = 0; i < numbers; ++i)
        put(other.scaled(i));
    for (std::size_t i = 0; i < commands; ++i)
        commands_.push_back(other.commands_[i]);
}

void PathData::append(const std::vector<VGubyte>& commands, const std::vector<double>& coordinates) {
    commands_.insert(commands_.end(), commands.begin(), commands.end());
    for (const double coordinate : coordinates)
        put(coordinate);
}

void PathData::append(const std::vector<Segment>& segments) {
    for (const Segment& s : segments) {
        commands_.push_back(VGubyte(s.type | VG_ABSOLUTE));
        if (s.type == VG_CLOSE_PATH)
            continue;
        if (s.isArc()) {
            put(s.radii.x);
            put(s.radii.y);
            put(s.rotation);
        }
        if (s.type == VG_QUAD_TO || s.type == VG_CUBIC_TO) {
            put(s.control1.x);
            put(s.control1.y);
        }
        if (s.type == VG_CUBIC_TO) {
            put(s.control2.x);
            put(s.control2.y);
        }
        put(s.to.x);
        put(s.to.y);
    }
}

// ---- Segments -------------------------------------------------------------------------------------

std::vector<Segment> PathData::segments() const {
    std::vector<Segment> segments;
    segments.reserve(commands_.size());
    Point s(0), o(0), p(0);  // the reference points of section 8.5.1
    std::size_t next = 0;
    for (const VGubyte command : commands_) {
        const unsigned type = command & ~1u;
        const Point base = command & VG_RELATIVE ? o : Point(0);
        const auto point = [&] {
            const Point q(scaled(next), scaled(next + 1));
            next += 2;
            return base + q;
        };
        Segment segment;
        segment.from = o;
        segment.type = type;
        switch (type) {
            case VG_CLOSE_PATH:
                o = p = segment.to = s;
                break;
            case VG_MOVE_TO:
                s = o = p = segment.to = point();
                break;
            case VG_LINE_TO:
                o = p = segment.to = point();
                break;
            case VG_HLINE_TO:
                segment.type = VG_LINE_TO;
                o = p = segment.to = {base.x + scaled(next++), o.y};
                break;
            case VG_VLINE_TO:
                segment.type = VG_LINE_TO;
                o = p = segment.to = {o.x, base.y + scaled(next++)};
                break;
            case VG_QUAD_TO:
                p = segment.control1 = point();
                o = segment.to = point();
                break;
            case VG_CUBIC_TO:
                segment.control1 = point();
                p = segment.control2 = point();
                o = segment.to = point();
                break;
            case VG_SQUAD_TO:
                segment.type = VG_QUAD_TO;
                p = segment.control1 = 2.0 * o - p;
                o = segment.to = point();
                break;
            case VG_SCUBIC_TO:
                segment.type = VG_CUBIC_TO;
                segment.control1 = 2.0 * o - p;
                p = segment.control2 = point();
                o = segment.to = point();
                break;
            default:
                segment.radii = {scaled(next), scaled(next + 1)};
                segment.rotation = scaled(next + 2);
                next += 3;
                o = p = segment.to = point();
                break;
        }
        segments.push_back(segment);
    }
    return segments;
}

scene::Path outline(const std::vector<Segment>& segments) {
    scene::Path path;
    path.reserve(segments.size() + 1);
    if (!segments.empty() && segments.front().type != VG_MOVE_TO)
        path.emplace_back(scene::MoveTo{Point(0)});
    for (const Segment& s : segments) {
        switch (s.type) {
            case VG_CLOSE_PATH:
                path.emplace_back(scene::Close{});
                break;
            case VG_MOVE_TO:
                path.emplace_back(scene::MoveTo{s.to});
                break;
            case VG_LINE_TO:
                path.emplace_back(scene::LineTo{s.to});
                break;
            case VG_QUAD_TO:
                path.emplace_back(scene::QuadTo{s.control1, s.to});
                break;
            case VG_CUBIC_TO:
                path.emplace_back(scene::CubicTo{s.control1, s.control2, s.to});
                break;
            default: {
                EllipticalArc arc;
                if (!arcOf(s, arc)) {
                    path.emplace_back(scene::LineTo{s.to});
                    break;
                }
                const bool large = s.type == VG_LCCWARC_TO || s.type == VG_LCWARC_TO;
                const bool counterClockwise = s.type == VG_SCCWARC_TO || s.type == VG_LCCWARC_TO;
                path.emplace_back(scene::ArcTo{glm::abs(s.radii), glm::radians(std::fmod(s.rotation, 360.0)),
                                               large, counterClockwise, s.to});
                break;
            }
        }
    }
    return path;
}

// ---- Arcs -----------------------------------------------------------------------------------------

Point EllipticalArc::at(double t) const { return center + std::cos(t) * axisX + std::sin(t) * axisY; }
Point EllipticalArc::derivative(double t) const { return -std::sin(t) * axisX + std::cos(t) * axisY; }

bool arcOf(const Segment& s, EllipticalArc& arc) {
    const Point radii = glm::abs(s.radii);
    if (!(radii.x > 0) || !(radii.y > 0) || s.from == s.to)
        return false;
    const double angle = glm::radians(std::fmod(s.rotation, 360.0)), c = std::cos(angle), n = std::sin(angle);
    // Half the chord where the ellipse is the unit circle.
    const Point half = (s.to - s.from) / 2.0;
    Point h((half.x * c + half.y * n) / radii.x, (-half.x * n + half.y * c) / radii.y);
    const double length2 = glm::dot(h, h), grown = std::max(1.0, std::sqrt(length2));
    if (!std::isfinite(length2) || !(length2 > 0))
        return false;
    h /= grown;
    arc.axisX = grown * radii.x * Point(c, n);
    arc.axisY = grown * radii.y * Point(-n, c);
    const bool large = s.type == VG_LCCWARC_TO || s.type == VG_LCWARC_TO;
    const bool counterClockwise = s.type == VG_SCCWARC_TO || s.type == VG_LCCWARC_TO;
    // The centre lies left of the chord for small counter-clockwise arcs and large clockwise ones.
    const double unit2 = glm::dot(h, h), distance = std::sqrt(std::max(0.0, 1 / unit2 - 1));
    const double side = large == counterClockwise ? -distance : distance;
    const Point middle = h + side * Point(-h.y, h.x);  // of the circle, from the arc's start
    arc.center = s.from + middle.x * arc.axisX + middle.y * arc.axisY;
    const Point first = -middle, last = 2.0 * h - middle;
    arc.start = std::atan2(first.y, first.x);
    arc.sweep = std::atan2(first.x * last.y - first.y * last.x, glm::dot(first, last));
    constexpr double turn = 2 * 3.14159265358979323846;
    if (counterClockwise && arc.sweep < 0)
        arc.sweep += turn;
    if (!counterClockwise && arc.sweep > 0)
        arc.sweep -= turn;
    return true;
}

void transformEllipse(const glm::dmat2& linear, Point& radii, double& rotation) {
    // The image of the unit circle under M has the singular values of M as radii; by M Mᵀ = (a b; b d).
    const double angle = glm::radians(rotation), c = std::cos(angle), n = std::sin(angle);
    const glm::dvec2 x = linear * (radii.x * Point(c, n)), y = linear * (radii.y * Point(-n, c));
    const double a = x.x * x.x + y.x * y.x, b = x.x * x.y + y.x * y.y, d = x.y * x.y + y.y * y.y;
    const double mean = (a + d) / 2, spread = std::hypot((a - d) / 2, b);
    const double larger = std::sqrt(mean + spread);
    // The product of the radii is |det|, which keeps the smaller one exact.
    const double area = std::abs(x.x * y.y - x.y * y.x);
    radii = {larger, larger > 0 ? area / larger : 0};
    rotation = glm::degrees(0.5 * std::atan2(2 * b, a - d));
}

// ---- Transformation, interpolation ----------------------------------------------------------------

void PathData::appendTransformed(const PathData& other, const glm::mat3& affine) {
    const glm::dmat3 m(affine);
    const glm::dmat2 linear(m[0], m[1]);
    const Point shift(m[2]);
    const bool mirrors = glm::determinant(linear) < 0;
    // A copy of the numbers: `other` may be this path.
    const std::vector<Segment> segments = other.segments();
    const std::vector<VGubyte> commands = other.commands_;
    std::size_t next = 0;
    const std::size_t numbers = other.coordinates_.size();
    std::vector<double> raw(numbers);
    for (std::size_t i = 0; i < numbers; ++i)
        raw[i] = other.scaled(i);
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const bool relative = commands[i] & VG_RELATIVE;
        unsigned type = commands[i] & ~1u;
        const auto point = [&] {
            const Point p(raw[next], raw[next + 1]);
            next += 2;
            const Point q = linear * p + (relative ? Point(0) : shift);
            put(q.x);
            put(q.y);
        };
        switch (type) {
            case VG_CLOSE_PATH:
                break;
            case VG_HLINE_TO:
            case VG_VLINE_TO: {
                // Where the line ends, from where it starts if it is relative.
                const Point q = linear * (segments[i].to - (relative ? segments[i].from : Point(0))) +
                                (relative ? Point(0) : shift);
                ++next;
                put(q.x);
                put(q.y);
                type = VG_LINE_TO;
                break;
            }
            case VG_SCCWARC_TO:
            case VG_SCWARC_TO:
            case VG_LCCWARC_TO:
            case VG_LCWARC_TO: {
                Point radii = glm::abs(segments[i].radii);
                double rotation = segments[i].rotation;
                transformEllipse(linear, radii, rotation);
                put(radii.x);
                put(radii.y);
                put(rotation);
                next += 3;
                point();
                if (mirrors)
                    type = type == VG_SCCWARC_TO   ? VG_SCWARC_TO
                           : type == VG_SCWARC_TO  ? VG_SCCWARC_TO
                           : type == VG_LCCWARC_TO ? VG_LCWARC_TO
                                                   : VG_LCCWARC_TO;
                break;
            }
            default:
                for (int k = 0; k < coordinateCount(type); k += 2)
                    point();
                break;
        }
        commands_.push_back(VGubyte(type | (relative ? VG_RELATIVE : VG_ABSOLUTE)));
    }
}

bool appendInterpolated(PathData& result, const PathData& from, const PathData& to, double amount) {
    std::vector<Segment> a = from.segments(), b = to.segments();
    if (a.size() != b.size())
        return false;
    const auto raise = [](Segment& s) {
        if (s.type != VG_QUAD_TO)
            return;
        s.type = VG_CUBIC_TO;
        const Point q = s.control1;
        s.control1 = (s.from + 2.0 * q) / 3.0;
        s.control2 = (s.to + 2.0 * q) / 3.0;
    };
    const auto blend = [&](auto x, auto y) { return x + amount * (y - x); };
    for (std::size_t i = 0; i < a.size(); ++i) {
        raise(a[i]);
        raise(b[i]);
        if (!isSame(a[i].type, b[i].type))
            return false;
        if (amount >= 0.5)
            a[i].type = b[i].type;
        a[i].control1 = blend(a[i].control1, b[i].control1);
        a[i].control2 = blend(a[i].control2, b[i].control2);
        a[i].radii = blend(a[i].radii, b[i].radii);
        a[i].rotation = blend(a[i].rotation, b[i].rotation);
        a[i].to = blend(a[i].to, b[i].to);
    }
    result.append(a);
    return true;
}

}  // namespace vtm::openvg
