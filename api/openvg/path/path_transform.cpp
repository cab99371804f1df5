// Paths made of paths: transformed (section 8.6.8), interpolated (section 8.6.9).

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "api/openvg/path/path_data.hpp"

namespace vtm::openvg {

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

namespace {

bool isSame(unsigned a, unsigned b) {
    const auto isArc = [](unsigned type) { return type >= VG_SCCWARC_TO && type <= VG_LCWARC_TO; };
    return a == b || (isArc(a) && isArc(b));
}

}  // namespace

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
