// Conduction through the circle in which undeformed spheres cut each other.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/conduction/touch.hpp"

#include <cmath>

namespace granum::law::conduction
{
//! As Hertz, with the circle of the geometric lens: wider by the root of two.
struct Lens
{
    static constexpr base::Card card{.name = "lens",
                                     .title = "Circle where undeformed spheres cut",
                                     .source = "geometry; the choice of MFIX",
                                     .valid = "overlap small against the radius; for comparison with other codes"};

    //! Radius of the circle that conducts, m.
    double operator()(Touch const& touch) const { return std::sqrt(2 * touch.radius * touch.overlap); }
};
}
