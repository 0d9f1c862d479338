// The models of layer porosity: a new one adds its name here.
#pragma once

#include "granum/product/linear_drying_potential.hpp"

namespace granum::product
{
using All = base::TypeList<LinearDryingPotential>;
using Any = All::Any;
}
