/// \file
/// A scene with filters in; out come pictures without filters, and the commands that filter and composite
/// them.
///
/// What of the scene has no filter in it stays together: neighbours in a group that have none are one
/// picture, exact and without seams. Groups with filters in them become commands: their children are drawn on
/// a picture of their own, filtered, clipped, masked and blended with what is below.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include "compiler/lower/lower.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {

/// Whether a filter applies to the root or to anything in it.
bool hasFilters(const scene::Scene& scene);

/// Compiles a scene without filters. Called by several threads at once.
using CompilePlain = std::function<Result(const scene::Scene&, const Excerpt&, const Options&)>;

/// As compile. The scene must be valid. With Options::filterPixels the picture has no filters but images.
Result compileFiltered(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                       const CompilePlain& compilePlain);

/// A picture without filters that commands draw.
struct PlainPart {
    scene::NodeList nodes;
    geometry::Box content;  ///< around what is seen of them; all boxes are in the space of the excerpt
    geometry::Box seen;     ///< what of the picture that it is drawn on is needed
    geometry::Box frame;  ///< what is compiled: the content and some room around it, but no more than is seen
};

/// A scene with filters as commands.
struct FilterPlan {
    Result commands;  ///< those of the kind DrawMap draw a part: their maps are numbers of parts
    std::vector<PlainPart> parts;
};

/// The scene must be valid. `compilePlain`: for what is filtered in patterns and selections.
FilterPlan planFiltered(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                        const CompilePlain& compilePlain);
/// What is compiled of a part: its frame of the excerpt, as exactly as that.
struct PartPicture {
    scene::Scene scene;  ///< the excerpt says what of it is drawn
    Excerpt excerpt;
    Options options;
};
PartPicture pictureOf(const PlainPart& part, const Excerpt& excerpt, const Options& options);
/// The picture of a plan's commands. `pictureOf` gives the picture of each part, once, in their order.
Result joinParts(Result commands, std::span<const PlainPart> parts, const Excerpt& excerpt,
                 const std::function<const Result&(std::size_t part)>& pictureOf);

}  // namespace vtm::compiler
