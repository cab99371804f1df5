/// \file
/// Offsets of curves as chords, for outlines that become chords anyway.
#pragma once

#include <span>

#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>
#include "compiler/lower/outline.hpp"
#include "compiler/stroke/offset.hpp"

namespace vtm::compiler {

/// Receives closed contours: start, then lines and cubics, each from where the last one ended, then close,
/// which draws the last line to the start unless the contour has come there.
class ContourSink {
public:
    virtual ~ContourSink() = default;
    virtual void start(scene::Point p) = 0;
    virtual void lines(std::span<const scene::Point> to) = 0;
    virtual void cubic(scene::Point c1, scene::Point c2, scene::Point to) = 0;
    virtual void close() = 0;
    /// Between the right sides of rings and all other contours.
    virtual void sidesEnd() {}
};

/// As commands; lines that go nowhere are left out.
class ContourPath : public ContourSink {
public:
    void start(scene::Point p) override { path.push_back(scene::MoveTo{at_ = p}); }
    void lines(std::span<const scene::Point> to) override {
        for (const scene::Point p : to)
            if (p != at_)
                path.push_back(scene::LineTo{at_ = p});
    }
    void cubic(scene::Point c1, scene::Point c2, scene::Point to) override {
        path.push_back(scene::CubicTo{c1, c2, at_ = to});
    }
    void close() override { path.push_back(scene::Close{}); }

    scene::Path path;

private:
    scene::Point at_{0, 0};
};

/// As strokeOutline (vtm/compiler/stroke.hpp), but with chords within `tolerance` + `chordTolerance` of the
/// offsets in place of most curves that are within `tolerance`. The curves that are left become chords within
/// `chordTolerance` later. Returns whether all is rings: closed subpaths without dashes.
///
/// The contours before ContourSink::sidesEnd are the rings' right sides, each in its subpath's direction. On
/// the way from a subpath to its right side one crosses nothing but the stroke, so beside the stroke both
/// have the same winding numbers.
bool strokeContours(const scene::Path& path, const scene::StrokeStyle& style, double tolerance,
                    ChordTolerance chordTolerance, ContourSink& contours);
/// The same, right within a box: parts of the path that cannot reach it are left out, so that what is left is
/// small beside the tolerance. The path lies about the origin, as the box does.
bool strokeContoursNear(const PathBox& box, const scene::Path& path, const scene::StrokeStyle& style,
                        double tolerance, ChordTolerance chordTolerance, ContourSink& contours);
/// As a path.
scene::Path strokeOutlineOfChords(const scene::Path& path, const scene::StrokeStyle& style, double tolerance,
                                  ChordTolerance chordTolerance);

namespace stroke {

class Stretch;

/// Goes on with chords within `tolerance` of the offset that lies at `distance` to the left of a curve
/// without cusps, over [t0, t1], where the curve is not tighter than that.
///
/// Between inflections the offset is convex: it lies between its chord and its tangent in any point between.
/// So it strays from the chord by no more than the tangent does over the chord's ends.
void appendChords(const Cubic& curve, double t0, double t1, double distance, ChordTolerance tolerance,
                  Side& side);
/// The same of a tight stretch, to whichever side: its offset, whose radius of curvature is no larger than
/// `radius`, follows the tangent's angle. Adds nothing and returns false where that takes hundreds.
bool appendChords(const Stretch& stretch, double distance, double radius, ChordTolerance tolerance,
                  Side& side);
/// The same of an arc of a circle, which starts where the side ends, at `center` + `from`.
bool appendArcChords(Point center, Point from, double angle, ChordTolerance tolerance, Side& side);

}  // namespace stroke
}  // namespace vtm::compiler
