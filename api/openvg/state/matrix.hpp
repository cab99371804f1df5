/// \file
/// Matrices whose numbers programs chose.
#pragma once

#include <cmath>
#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace vtm::openvg {

inline bool isFinite(const glm::dmat3& m) {
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(m[column][row]))
                return false;
    return true;
}

inline bool isProjective(const glm::mat3& m) { return m[0].z != 0 || m[1].z != 0 || m[2].z != 1; }

/// Nothing if there is none within double precision.
inline std::optional<glm::dmat3> inverseOf(const glm::mat3& matrix) {
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(matrix));
    return isFinite(inverse) ? std::optional(inverse) : std::nullopt;
}

}  // namespace vtm::openvg
