#include "api/openvg/src/path_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/trigonometric.hpp>

namespace vtm::openvg {

namespace {

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

// ---- Storage --------------------------------------------------------------------------------------

void PathData::clear() {
    commands_.clear();
    coordinates_.clear();
}

void PathData::requireRoomFor(std::size_t segments) const {
    if (segments > mostSegments - commands_.size())
        throw std::length_error("too much path data");
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
    requireRoomFor(std::size_t(count));
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
    requireRoomFor(commands);
    commands_.reserve(commands_.size() + commands);
    coordinates_.reserve(coordinates_.size() + numbers);
    for (std::size_t i = 0; i < numbers; ++i)
        put(other.scaled(i));
    for (std::size_t i = 0; i < commands; ++i)
        commands_.push_back(other.commands_[i]);
}

void PathData::append(const std::vector<VGubyte>& commands, const std::vector<double>& coordinates) {
    requireRoomFor(commands.size());
    commands_.insert(commands_.end(), commands.begin(), commands.end());
    for (const double coordinate : coordinates)
        put(coordinate);
}

void PathData::append(const std::vector<Segment>& segments) {
    requireRoomFor(segments.size());
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
        if (s.isRational()) {
            appendRational(s);
            continue;
        }
        put(s.to.x);
        put(s.to.y);
    }
}

void PathData::appendRational(const Segment& s) {
    const auto putPoint = [&](Point p, double weight) {
        put(p.x);
        put(p.y);
        put(weight);
    };
    put(s.weights[0]);
    putPoint(s.control1, s.weights[1]);
    if (s.type == VG_RCUBIC_TO_NDS)
        putPoint(s.control2, s.weights[2]);
    putPoint(s.to, s.weights[s.type == VG_RCUBIC_TO_NDS ? 3 : 2]);
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
            case VG_RQUAD_TO_NDS:
            case VG_RCUBIC_TO_NDS:
                segment.weights[0] = scaled(next++);
                segment.control1 = point();
                segment.weights[1] = scaled(next++);
                if (type == VG_RCUBIC_TO_NDS) {
                    segment.control2 = point();
                    segment.weights[2] = scaled(next++);
                }
                o = p = segment.to = point();
                segment.weights[type == VG_RCUBIC_TO_NDS ? 3 : 2] = scaled(next++);
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

// ---- Transformation, interpolation ----------------------------------------------------------------

void PathData::appendTransformed(const PathData& other, const glm::mat3& affine) {
    requireRoomFor(other.commands_.size());
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
            case VG_RQUAD_TO_NDS:
            case VG_RCUBIC_TO_NDS:
                // Weights stay: w, then x, y, w of each point.
                put(raw[next++]);
                for (int k = 1; k < coordinateCount(type); k += 3) {
                    point();
                    put(raw[next++]);
                }
                break;
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
    // The same of points (w x, w y, w).
    const auto raiseRational = [](Segment& s) {
        if (s.type != VG_RQUAD_TO_NDS)
            return;
        s.type = VG_RCUBIC_TO_NDS;
        const auto [w0, w1, w2, unused] = s.weights;
        const Point q = s.control1;
        s.weights = {w0, (w0 + 2 * w1) / 3, (w2 + 2 * w1) / 3, w2};
        s.control1 = (w0 * s.from + 2 * w1 * q) / (w0 + 2 * w1);
        s.control2 = (w2 * s.to + 2 * w1 * q) / (w2 + 2 * w1);
    };
    const auto blend = [&](auto x, auto y) { return x + amount * (y - x); };
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (Segment* s : {&a[i], &b[i]}) {
            raise(*s);
            raiseRational(*s);
        }
        if (!isSame(a[i].type, b[i].type))
            return false;
        if (amount >= 0.5)
            a[i].type = b[i].type;
        a[i].control1 = blend(a[i].control1, b[i].control1);
        a[i].control2 = blend(a[i].control2, b[i].control2);
        a[i].radii = blend(a[i].radii, b[i].radii);
        a[i].rotation = blend(a[i].rotation, b[i].rotation);
        a[i].to = blend(a[i].to, b[i].to);
        for (std::size_t k = 0; k < 4; ++k)
            a[i].weights[k] = blend(a[i].weights[k], b[i].weights[k]);
    }
    result.append(a);
    return true;
}

}  // namespace vtm::openvg
