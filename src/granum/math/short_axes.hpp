// The directions of a box, the shortest first.
//
// Whoever walks through granules goes along the shortest direction first, and all must go alike: lengths that differ by
// less than a fiftieth of the longest are equal, so that a bed as deep as it is wide does not change sides with a
// granule.
#pragma once

#include "granum/math/vec3.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::math
{
inline std::array<std::size_t, 3> short_axes(Vec3 lengths)
{
    double const unit = 0.02 * std::max({lengths.x, lengths.y, lengths.z, 1e-300});
    for (std::size_t d = 0; d < 3; ++d) lengths[d] = std::round(lengths[d] / unit);
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return lengths[a] < lengths[b]; });
    return axes;
}
}
