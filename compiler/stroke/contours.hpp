/// \file
/// Where the outlines of strokes go.
#pragma once

#include <span>

#include <vtm/scene/path.hpp>

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

}  // namespace vtm::compiler
