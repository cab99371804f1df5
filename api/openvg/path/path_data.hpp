/// \file
/// Path data in the standard format (specification section 8.5) and what can be done with it (section 8.6).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "api/openvg/path/segment.hpp"

namespace vtm::openvg {

/// Of one path. What goes beyond throws std::length_error, and changes nothing.
inline constexpr std::size_t maxSegments = std::size_t(1) << 20;

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
    /// vgTransformPath by an affine map: relative commands stay relative, lines along an axis become lines,
    /// arcs stay arcs.
    void appendTransformed(const PathData& other, const glm::mat3& affine);

    /// One for each command.
    std::vector<Segment> segments() const;

private:
    /// A number even if scale or bias is none.
    double scaled(std::size_t i) const;
    /// A scaled coordinate, rounded and pulled to what the datatype holds.
    double stored(double coordinate) const;
    void requireRoomFor(std::size_t segments) const;
    void appendRational(const Segment& segment);
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

}  // namespace vtm::openvg
