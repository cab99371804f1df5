/// \file
/// Path data in the standard format (specification section 8.5) and what can be done with it (section 8.6).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <VG/openvg.h>

#include "scene/path.hpp"

namespace vtm::openvg {

using Point = glm::dvec2;

/// Numbers that a segment takes (table 6). `segment`: a VGPathCommand or VGPathSegment.
int coordinateCount(unsigned segment);

/// A VGPathCommand, or closing with either of its spellings.
bool isCommand(unsigned segment);

/// A segment with all that is implicit made explicit (sections 8.5.1 and 8.5.2): absolute points, one of
/// VG_CLOSE_PATH, VG_MOVE_TO, VG_LINE_TO, VG_QUAD_TO, VG_CUBIC_TO and the four arcs.
struct Segment {
    unsigned type = VG_CLOSE_PATH;
    Point from{0};  ///< (ox, oy)
    Point control1{0}, control2{0};
    Point radii{0};       ///< of arcs, as given
    double rotation = 0;  ///< of arcs, degrees
    Point to{0};

    bool isArc() const { return type >= VG_SCCWARC_TO && type <= VG_LCWARC_TO; }
};

/// Coordinates are kept as what the datatype can hold; scaled ones are scale · v + bias.
class PathData {
public:
    PathData() = default;
    /// `scale` is not 0.
    PathData(VGPathDatatype datatype, VGfloat scale, VGfloat bias)
        : datatype_(datatype), scale_(scale), bias_(bias) {}

    VGPathDatatype datatype() const { return datatype_; }
    VGfloat scale() const { return scale_; }
    VGfloat bias() const { return bias_; }
    const std::vector<VGubyte>& commands() const { return commands_; }
    std::size_t coordinates() const { return coordinates_.size(); }

    void clear();
    /// `commands` are legal, `data` holds as many numbers of the datatype as they take.
    void append(const VGubyte* commands, int count, const void* data);
    /// Of the segments first to first + count - 1, which exist.
    void modify(int first, int count, const void* data);
    /// Appends `other` as it is, its numbers put into this path's format.
    void append(const PathData& other);
    /// Appends commands with scaled coordinates, as many as they take.
    void append(const std::vector<VGubyte>& commands, const std::vector<double>& coordinates);
    /// Appends segments; relative commands and smooth ones are no longer so.
    void append(const std::vector<Segment>& segments);
    /// vgTransformPath: relative commands stay relative, lines along an axis become lines, arcs stay arcs.
    void appendTransformed(const PathData& other, const glm::mat3& affine);

    /// One for each command.
    std::vector<Segment> segments() const;

private:
    /// A number even if scale or bias is none.
    double scaled(std::size_t i) const;
    /// A scaled coordinate, rounded and pulled to what the datatype holds.
    double stored(double coordinate) const;
    void put(double coordinate) { coordinates_.push_back(stored(coordinate)); }
    void read(const void* data, std::size_t first, std::size_t count);

    VGPathDatatype datatype_ = VG_PATH_DATATYPE_F;
    VGfloat scale_ = 1, bias_ = 0;
    std::vector<VGubyte> commands_;
    std::vector<double> coordinates_;
};

/// vgInterpolatePath (section 8.6.9): `from` and `to` blended; false, and nothing appended, unless they have
/// the same kinds of segments.
bool appendInterpolated(PathData& result, const PathData& from, const PathData& to, double amount);

/// The path as outlines are made of it.
scene::Path outline(const std::vector<Segment>& segments);

/// An arc by its centre (section 18.4), radii grown where no ellipse reaches both ends (section 8.4).
struct EllipticalArc {
    Point center{0};
    Point axisX{0}, axisY{0};     ///< point(t) = center + cos t axisX + sin t axisY
    double start = 0, sweep = 0;  ///< radians

    Point at(double t) const;
    Point derivative(double t) const;
};

/// Of a segment that isArc(); false if it is drawn as a line.
bool arcOf(const Segment& segment, EllipticalArc& arc);

/// The affine image of an ellipse: radii and rotation (degrees) of what becomes of them.
void transformEllipse(const glm::dmat2& linear, Point& radii, double& rotation);

}  // namespace vtm::openvg
