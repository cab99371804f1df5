#include "api/openvg/path/path_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

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

}  // namespace

// ---- Storage --------------------------------------------------------------------------------------

void PathData::clear() {
    commands_.clear();
    coordinates_.clear();
}

void PathData::requireRoomFor(std::size_t segments) const {
    if (segments > maxSegments - commands_.size())
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
    const auto rounded = [&](double minimum, double maximum) {
        return std::clamp(std::floor(v + 0.5), minimum, maximum);
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

}  // namespace vtm::openvg
