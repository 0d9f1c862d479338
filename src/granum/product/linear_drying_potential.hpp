// Porosity of a layer as a straight line in the drying potential.
//
// That layers are denser where the drying potential is higher, and that a line describes it, is published for sodium
// benzoate. The coefficients of that line were not at hand: the defaults are placeholders (low confidence), to be
// replaced by a fit to measurements of the product.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/product/element.hpp"

#include <algorithm>

namespace granum::product
{
struct LinearDryingPotential
{
    static constexpr base::Card card{.name = "linear-drying-potential",
                                     .title = "layer porosity linear in the drying potential",
                                     .source =
                                         "form: Rieck et al., Powder Technol. 272 (2015) 120; coefficients "
                                         "are placeholders (low confidence)",
                                     .valid = "salt solutions, drying potential 0.2 to 0.95; not suspensions"};

    double zero = 0.70;    //!< porosity at drying potential 0
    double slope = -0.50;  //!< per unit of drying potential
    double band = 0.07;    //!< standard deviation of one element about the line
    double common =
        band;  //!< standard deviation of the line itself; the band about recalled batch means serves as both

    //! Porosity within [0, 0.95], with the deviations of the line before it is clipped.
    Prediction operator()(LayerElement const& element) const
    {
        return {std::clamp(zero + slope * element.drying_potential, 0.0, 0.95), band, common};
    }
};
}
