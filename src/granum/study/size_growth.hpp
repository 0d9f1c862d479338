// How much more layer large granules get than small ones, by what a run laid on them.
#pragma once

#include "granum/io/snapshot_file.hpp"

namespace granum::study
{
//! Layer mass per surface as a power of the diameter.
struct SizeGrowth
{
    double exponent = 0, error = 0;  //!< 0: in proportion to surface, every diameter grows alike; standard error
    bool known = false;              //!< sizes differ enough to tell
};

//! Granules in six groups of equal surface from the smallest to the largest; a line through the logarithms of layer
//! mass per surface. Sizes must differ by a tenth at least, and every group must have a layer.
SizeGrowth size_growth(io::GranuleView const& granules);
}
