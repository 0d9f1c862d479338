// Ledgers: what is there now must be what was there at the start, plus what came in, minus what went out.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

namespace granum::sim
{
//! One conserved quantity, summed over all ranks.
struct Ledger
{
    std::string name, unit;
    double bar = 1e-9;  //!< relative; ten times this stops the run
    double start = 0, in = 0, out = 0, now = 0;

    double residual() const { return now - start - (in - out); }
    //! What passed through, or was there to begin with: the measure of the residual.
    double scale() const { return std::max(std::abs(in) + std::abs(out), reference); }
    double relative_error() const { return scale() > 0 ? std::abs(residual()) / scale() : 0; }
    bool broken() const { return relative_error() > 10 * bar; }

    double reference = 0;  //!< least measure, so that the first steps of a run are not divided by nearly nothing
};

struct Ledgers
{
    Ledger solids{"solids", "kg", 1e-9}, water{"water", "kg", 1e-9}, energy{"energy", "J", 1e-6};
    double momentum = 0;  //!< largest relative mismatch between gas and granules in any step so far
    static constexpr double momentum_bar = 1e-9;
};
}
