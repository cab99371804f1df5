// Section 8.6: path objects.

#include <limits>

#include "api/openvg/path/path_measure.hpp"
#include "api/openvg/path/projective.hpp"
#include "api/openvg/state/context.hpp"
#include "api/openvg/state/matrix.hpp"

using namespace vtm::openvg;

namespace {

std::shared_ptr<Path> pathWith(const Context& context, VGPath handle, VGbitfield capability) {
    std::shared_ptr<Path> path = context.objects->get<Path>(handle);
    require(path->capabilities & capability, VG_PATH_CAPABILITY_ERROR);
    return path;
}

bool isAlignedFor(const PathData& data, const void* numbers) {
    switch (data.datatype()) {
        case VG_PATH_DATATYPE_S_8:
            return true;
        case VG_PATH_DATATYPE_S_16:
            return isAligned(static_cast<const VGshort*>(numbers));
        case VG_PATH_DATATYPE_S_32:
            return isAligned(static_cast<const VGint*>(numbers));
        default:
            return isAligned(static_cast<const VGfloat*>(numbers));
    }
}

/// Segments of a path that a query is about.
void requireRange(const PathData& data, VGint first, VGint count) {
    require(first >= 0 && count > 0 && std::int64_t(first) + count <= std::int64_t(data.commands().size()));
}

/// The nearest that there is.
VGfloat toVgFloat(double v) {
    constexpr double maximum = std::numeric_limits<VGfloat>::max();
    return VGfloat(std::clamp(v, -maximum, maximum));
}

/// Of an empty path: width and height -1 (section 8.6.12).
void storeBounds(const vtm::geometry::Box& box, VGfloat* minX, VGfloat* minY, VGfloat* width,
                 VGfloat* height) {
    *minX = box.empty() ? 0 : toVgFloat(box.min.x);
    *minY = box.empty() ? 0 : toVgFloat(box.min.y);
    *width = box.empty() ? -1 : toVgFloat(box.width());
    *height = box.empty() ? -1 : toVgFloat(box.height());
}

void requireOutputs(std::initializer_list<VGfloat*> outputs) {
    for (VGfloat* output : outputs)
        require(output != nullptr && isAligned(output));
}

}  // namespace

VGPath vgCreatePath(VGint pathFormat, VGPathDatatype datatype, VGfloat scale, VGfloat bias, VGint, VGint,
                    VGbitfield capabilities) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        require(pathFormat == VG_PATH_FORMAT_STANDARD, VG_UNSUPPORTED_PATH_FORMAT_ERROR);
        require(VGint(datatype) >= VG_PATH_DATATYPE_S_8 && VGint(datatype) <= VG_PATH_DATATYPE_F);
        require(scale != 0 && !std::isnan(scale));
        auto path = std::make_shared<Path>();
        path->data = PathData(datatype, scale, bias);
        path->capabilities = capabilities & VG_PATH_CAPABILITY_ALL;
        return context.objects->add(std::move(path));
    });
}

void vgClearPath(VGPath handle, VGbitfield capabilities) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = context.objects->get<Path>(handle);
        path->data.clear();
        path->masks.clear();
        path->capabilities = capabilities & VG_PATH_CAPABILITY_ALL;
    });
}

void vgDestroyPath(VGPath path) {
    call([&](Context& context) { context.objects->destroy<Path>(path); });
}

void vgRemovePathCapabilities(VGPath path, VGbitfield capabilities) {
    call([&](Context& context) { context.objects->get<Path>(path)->capabilities &= ~capabilities; });
}

VGbitfield vgGetPathCapabilities(VGPath path) {
    return callOr(VGbitfield(0),
                  [&](Context& context) { return context.objects->get<Path>(path)->capabilities; });
}

void vgAppendPath(VGPath dstPath, VGPath srcPath) {
    call([&](Context& context) {
        const std::shared_ptr<Path> dst = context.objects->get<Path>(dstPath),
                                    src = context.objects->get<Path>(srcPath);
        require(src->capabilities & VG_PATH_CAPABILITY_APPEND_FROM &&
                    dst->capabilities & VG_PATH_CAPABILITY_APPEND_TO,
                VG_PATH_CAPABILITY_ERROR);
        dst->data.append(src->data);
        dst->masks.clear();
    });
}

void vgAppendPathData(VGPath dstPath, VGint numSegments, const VGubyte* pathSegments, const void* pathData) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = pathWith(context, dstPath, VG_PATH_CAPABILITY_APPEND_TO);
        require(pathSegments != nullptr && pathData != nullptr && isAlignedFor(path->data, pathData));
        require(numSegments > 0);
        for (VGint i = 0; i < numSegments; ++i)
            require(isCommand(pathSegments[i], context.state.knowsExtensions));
        path->data.append(pathSegments, numSegments, pathData);
        path->masks.clear();
    });
}

void vgModifyPathCoords(VGPath dstPath, VGint startIndex, VGint numSegments, const void* pathData) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = pathWith(context, dstPath, VG_PATH_CAPABILITY_MODIFY);
        require(pathData != nullptr && isAlignedFor(path->data, pathData));
        requireRange(path->data, startIndex, numSegments);
        path->data.modify(startIndex, numSegments, pathData);
        path->masks.clear();
    });
}

void vgTransformPath(VGPath dstPath, VGPath srcPath) {
    call([&](Context& context) {
        const std::shared_ptr<Path> dst = context.objects->get<Path>(dstPath),
                                    src = context.objects->get<Path>(srcPath);
        require(src->capabilities & VG_PATH_CAPABILITY_TRANSFORM_FROM &&
                    dst->capabilities & VG_PATH_CAPABILITY_TRANSFORM_TO,
                VG_PATH_CAPABILITY_ERROR);
        const glm::mat3& toSurface = context.state.matrix(VG_MATRIX_PATH_USER_TO_SURFACE);
        if (isProjective(toSurface) || !clipLines(context.state).empty())
            dst->data.append(projectedSegments(src->data.segments(), toSurface, context.state));
        else
            dst->data.appendTransformed(src->data, toSurface);
        dst->masks.clear();
    });
}

VGboolean vgInterpolatePath(VGPath dstPath, VGPath startPath, VGPath endPath, VGfloat amount) {
    return callOr(VG_FALSE, [&](Context& context) {
        const std::shared_ptr<Path> dst = context.objects->get<Path>(dstPath),
                                    start = context.objects->get<Path>(startPath),
                                    end = context.objects->get<Path>(endPath);
        require(dst->capabilities & VG_PATH_CAPABILITY_INTERPOLATE_TO &&
                    start->capabilities & end->capabilities & VG_PATH_CAPABILITY_INTERPOLATE_FROM,
                VG_PATH_CAPABILITY_ERROR);
        if (!appendInterpolated(dst->data, start->data, end->data, double(amount)))
            return VG_FALSE;
        dst->masks.clear();
        return VG_TRUE;
    });
}

VGfloat vgPathLength(VGPath handle, VGint startSegment, VGint numSegments) {
    return callOr(VGfloat(-1), [&](Context& context) {
        const std::shared_ptr<Path> path = pathWith(context, handle, VG_PATH_CAPABILITY_PATH_LENGTH);
        requireRange(path->data, startSegment, numSegments);
        const std::vector<Segment> segments = path->data.segments();
        return toVgFloat(
            length(std::span(segments).subspan(std::size_t(startSegment), std::size_t(numSegments))));
    });
}

void vgPointAlongPath(VGPath handle, VGint startSegment, VGint numSegments, VGfloat distance, VGfloat* x,
                      VGfloat* y, VGfloat* tangentX, VGfloat* tangentY) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = context.objects->get<Path>(handle);
        const bool wantsPoint = x && y, wantsTangent = tangentX && tangentY;
        require(!wantsPoint || path->capabilities & VG_PATH_CAPABILITY_POINT_ALONG_PATH,
                VG_PATH_CAPABILITY_ERROR);
        require(!wantsTangent || path->capabilities & VG_PATH_CAPABILITY_TANGENT_ALONG_PATH,
                VG_PATH_CAPABILITY_ERROR);
        requireRange(path->data, startSegment, numSegments);
        for (const VGfloat* output : {x, y, tangentX, tangentY})
            require(isAligned(output));
        const std::vector<Segment> segments = path->data.segments();
        const PointOnPath point =
            pointAlong(segments, std::size_t(startSegment), std::size_t(numSegments), double(distance));
        if (wantsPoint) {
            *x = toVgFloat(point.at.x);
            *y = toVgFloat(point.at.y);
        }
        if (wantsTangent) {
            *tangentX = VGfloat(point.tangent.x);
            *tangentY = VGfloat(point.tangent.y);
        }
    });
}

void vgPathBounds(VGPath handle, VGfloat* minX, VGfloat* minY, VGfloat* width, VGfloat* height) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = context.objects->get<Path>(handle);
        requireOutputs({minX, minY, width, height});
        require(path->capabilities & VG_PATH_CAPABILITY_PATH_BOUNDS, VG_PATH_CAPABILITY_ERROR);
        storeBounds(bounds(path->data.segments(), glm::mat3(1)), minX, minY, width, height);
    });
}

void vgPathTransformedBounds(VGPath handle, VGfloat* minX, VGfloat* minY, VGfloat* width, VGfloat* height) {
    call([&](Context& context) {
        const std::shared_ptr<Path> path = context.objects->get<Path>(handle);
        requireOutputs({minX, minY, width, height});
        require(path->capabilities & VG_PATH_CAPABILITY_PATH_TRANSFORMED_BOUNDS, VG_PATH_CAPABILITY_ERROR);
        const glm::mat3& toSurface = context.state.matrix(VG_MATRIX_PATH_USER_TO_SURFACE);
        const vtm::geometry::Box box =
            isProjective(toSurface)
                ? bounds(projectedSegments(path->data.segments(), toSurface, State()), glm::mat3(1))
                : bounds(path->data.segments(), toSurface);
        storeBounds(box, minX, minY, width, height);
    });
}
