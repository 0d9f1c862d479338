// Directions drawn evenly from all of space.
#pragma once

#include "granum/base/random.hpp"
#include "granum/math/constants.hpp"
#include "granum/math/vec3.hpp"

#include <cmath>

namespace granum::math
{
//! Unit vector, uniform over the sphere; takes two draws.
inline Vec3 random_direction(base::Random& random)
{
    double const height = 2 * random.uniform() - 1, angle = 2 * pi * random.uniform();
    double const flat = std::sqrt(1 - height * height);
    return {flat * std::cos(angle), flat * std::sin(angle), height};
}
}
