// Conduction through the circle in which elastic spheres touch.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/conduction/touch.hpp"

#include <cmath>

namespace granum::law::conduction
{
//! Heat H (T_j - T_i) with H = 4 k_i k_j / (k_i + k_j) a, a the radius of Hertz's circle; no heat through the gas
//! beside it.
struct Hertz
{
    static constexpr base::Card card{
        .name = "hertz",
        .title = "Circle of Hertz",
        .source = "Batchelor and O'Brien, Proc. R. Soc. Lond. A 355 (1977) 313 (recalled, unverified)",
        .valid =
            "smooth elastic spheres in vacuum or in a gas that conducts far worse than they do; circle small "
            "against the radius"};

    //! Radius of the circle that conducts, m.
    double operator()(Touch const& touch) const { return std::sqrt(touch.radius * touch.overlap); }
};
}
