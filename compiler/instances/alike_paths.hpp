/// \file
/// Paths in; out comes which of them are images of each other, moved, turned, mirrored or scaled.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include "compiler/containers/sorted_blocks.hpp"

namespace vtm::compiler {

class AlikePaths {
public:
    struct Image {
        std::uint32_t kind = 0;
        scene::Affine fromKind;  ///< from the kind's own space, which has the path's first point as origin
        double scale = 1;        ///< of it: a similarity
        double size = 0;         ///< of the kind's path, in the kind's space
    };

    /// How far four of a path's points are apart, each from the next, in radii: rounded to steps. Images have
    /// nearly the same distances.
    using Distances = std::array<std::uint16_t, 4>;
    using Complex = std::complex<double>;
    /// What of a path is compared first. Any thread can find it.
    struct Summary {
        std::uint64_t commands = 0;  ///< hash
        Complex mean, first;         ///< of its points; the first of them
        double radius = 0;           ///< root of the mean square of distances from the mean
        double form = 0;             ///< a number that all images have in common
        double size = 0;             ///< largest distance from the first point
        Distances distances{};
    };
    static Summary summaryOf(const scene::Path& path);

    /// The path as an image of one that was added before, within `slack` in its own space, or as the first of
    /// a kind. It begins with MoveTo. It must outlive this: most paths are like no other, so their points are
    /// not kept, but found again where another path may be like them.
    Image add(const scene::Path& path, const Summary& summary, double slack);
    Image add(const scene::Path& path, double slack) { return add(path, summaryOf(path), slack); }

private:
    /// Points of a path about their mean, as x + iy.
    struct Points {
        std::uint64_t commands = 0;  ///< hash
        Complex mean;
        std::vector<Complex> fromMean;
        double radius = 0;  ///< root of the mean square of |fromMean|
        double form = 0;    ///< a number that all images have in common
    };
    struct Kind {
        Points points;
        Complex origin;
        double size = 0;
    };
    /// p = factor · q, or factor · conj(q).
    struct Turn {
        Complex factor;
        bool isMirrored = false;
    };

    /// A kind among those of the same commands.
    struct Known {
        std::uint32_t kind = 0;
        Distances distances{};
    };
    /// The first path of a kind, and its points once another one was like it.
    struct First {
        const scene::Path* path = nullptr;
        std::unique_ptr<const Kind> kind;
    };

    static void findPoints(const scene::Path& path, Points& points);
    static Distances distancesOf(const Points& points);
    static bool mayBeAlike(const Distances& from, const Distances& to, double slackInRadii);
    static std::optional<Turn> turnOf(const Points& from, const Points& to, double slack);
    static Kind kindOf(Points points);
    static Image image(std::uint32_t kind, const Kind& of, const Points& points, const Turn& turn);
    std::optional<Image> imageOf(std::uint32_t kind, double slack);

    std::vector<First> firsts_;  ///< by kind
    /// Kinds by their form, by their commands.
    std::unordered_map<std::uint64_t, SortedBlocks<Known>> byCommands_;
    Points points_;  ///< of the path being added
};

}  // namespace vtm::compiler
