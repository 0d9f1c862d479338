// Does a map agree with what is published about its property? Told, never enforced.
#pragma once

#include "granum/map/fit.hpp"

#include <optional>
#include <string>

namespace granum::map
{
struct Trend
{
    double slope = 0, error = 0;  //!< of the property along the global drying potential
    int published = 0;            //!< sign of the slope; 0: none is known for this property
    std::string source;

    //! 1: the same sign beyond two errors; -1: the opposite one; 0: neither can be told.
    int agrees() const;
    std::string words() const;
};

//! Slope of the lab's values; published signs are known for porosity, roughness and strength (sodium benzoate;
//! abstracts). Empty where the runs have one drying potential.
std::optional<Trend> trend(Map const& map);
}
