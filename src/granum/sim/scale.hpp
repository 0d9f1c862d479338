// From a lab case to cases of a pilot plant that dries alike.
//
// Gas velocity at the plate, inlet air, and spray over gas are those of the lab, and with them the drying potential of
// the whole apparatus and the temperatures. What cannot stay the same is how the spray is shared: one nozzle with all
// of it wets its surroundings more than many with a lab's share each.
#pragma once

#include <string>

namespace granum::sim
{
enum class Likeness
{
    height,   //!< plate and bed of `factor` times the area, all heights as in the lab
    geometry  //!< all lengths by the cube root of `factor`; at the same velocity less gas and spray per granule
};

struct Scaling
{
    double factor = 8;  //!< mass of granules over that of the lab
    int nozzles = 1;
    Likeness likeness = Likeness::height;
};

//! The text of the pilot's case. Cells and parcels stay as large as they are. Nozzles stand on a ring that parts the
//! plate into equal areas (in a box: on a row along its wider side, or in two), each with its share of spray and
//! atomising air. Throws base::CaseError where the case is wrong, has not exactly one nozzle, or has a chamber made of
//! solids.
std::string scaled_case(std::string const& path, Scaling const& scaling);
}
