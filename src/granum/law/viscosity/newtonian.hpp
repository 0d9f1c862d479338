// A viscosity that does not depend on the rate of shear.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/viscosity/shear.hpp"

namespace granum::law::viscosity
{
struct Newtonian
{
    static constexpr base::Card card{
        .name = "newtonian", .title = "Newtonian", .source = "textbook", .valid = "gases, water, dilute solutions"};

    //! Pa s.
    double operator()(Shear const& shear) const { return shear.at_rest; }
};
}
