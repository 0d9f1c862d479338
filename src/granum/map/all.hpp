// The models of the map: a new one adds its name here.
#pragma once

#include "granum/map/additive.hpp"
#include "granum/map/linear_potential.hpp"
#include "granum/map/scores_models.hpp"

namespace granum::map
{
using Models = base::TypeList<Additive, LinearPotential, LinearScores, GaussianProcess>;
using Model = Models::Any;
}
