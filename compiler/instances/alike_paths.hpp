/// \file
/// Paths in; out comes which of them are images of each other, moved, turned, mirrored or scaled.
#pragma once

#include <complex>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>

namespace vtm::compiler {

class AlikePaths {
public:
    struct Image {
        std::uint32_t kind = 0;
        scene::Affine fromKind;  ///< from the kind's own space, which has the path's first point as origin
        double scale = 1;        ///< of it: a similarity
        double size = 0;         ///< of the kind's path, in the kind's space
    };

    /// The path as an image of one that was added before, within `slack` in its own space, or as the first of
    /// a kind. It begins with MoveTo.
    Image add(const scene::Path& path, double slack);

private:
    using Complex = std::complex<double>;
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

    static Points pointsOf(const scene::Path& path);
    static std::optional<Turn> turnOf(const Points& from, const Points& to, double slack);
    static Image image(std::uint32_t kind, const Kind& of, const Points& points, const Turn& turn);

    std::vector<Kind> kinds_;
    /// Kinds by their form, by their commands.
    std::unordered_map<std::uint64_t, std::multimap<double, std::uint32_t>> byCommands_;
};

}  // namespace vtm::compiler
