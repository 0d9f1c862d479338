// The deposits of a run folder that tell of its operating point: those of the spray, once the run has become steady.
#pragma once

#include "granum/map/features.hpp"
#include "granum/math/steady.hpp"

#include <string>
#include <vector>

namespace granum::map
{
//! How steady a run is in its deposits.
struct Window
{
    double from = 0, to = 0;  //!< s
    bool settled = false;
    double mean = 0, error = 0;  //!< of log10 of the drying time, weighted with solids
    double interval = 0;         //!< s, of the means that the error is from
};

struct RunDeposits
{
    std::string folder, title;
    double potential = 0;  //!< global drying potential: of the run's outlet where it is known, else of its balance
    Window window;
    Deposits deposits;  //!< of the window
};

//! Columns of the events that a map may use.
std::vector<std::string> const& event_variables();

//! Reads events.h5 and summary.json. Deposits that the start had placed count with what was sprayed of them, none that
//! dried while the bed settled; the steady part is found from the means of the drying time over `interval` s. Throws
//! base::IoError where a file is missing or broken, base::NumericsError where no deposit of the spray has dried.
RunDeposits read_deposits(std::string const& folder, double interval = 0.05);
}
