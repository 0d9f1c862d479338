// Faces of cells that are fine where it matters and grow beyond.
#pragma once

#include <vector>

namespace granum::grid
{
//! Cells of `size` between two planes, and of sizes that grow by `growth` from one to the next beyond.
struct Fine
{
    double lower, upper, size;  //!< m
    double growth;              //!< above 1
};

//! Faces from `low` to `high` (m), at most `coarse` apart. Between the planes of a fine part cells are as wide as asked
//! or up to a tenth narrower, so that faces lie on its planes.
std::vector<double> stretched(double low, double high, double coarse, std::vector<Fine> const& fine);
}
