// The file of a lab: which runs, which property was measured on the product of each, and what a map of it may look
// like.
#pragma once

#include "granum/map/fit.hpp"
#include "granum/map/run_deposits.hpp"

#include <string>
#include <vector>

namespace granum::map
{
struct Lab
{
    struct Run
    {
        std::string folder;
        double value = 0, error = 0;
    };
    std::string title, property, unit;
    std::vector<std::string> variables;  //!< one or two columns of the events
    std::vector<int> nodes;              //!< of each
    Known known;                         //!< its axes are found from the runs
    Wanted wanted;
    std::vector<Run> runs;
};

//! Throws base::CaseError with every mistake of the file.
Lab read_lab(std::string const& path);

//! Reads the runs and fits. `windows` receives how steady each run is. Throws base::IoError, base::NumericsError.
Map fit(Lab const& lab, std::vector<RunDeposits>* read = nullptr);

//! @{ A map as a file: its runs' distributions and measured values, from which it is fitted anew when read. Throws
//! base::IoError.
void write_map(Map const& map, Wanted const& wanted, std::string const& path);
Map read_map(std::string const& path, bool compare = false);
//! @}
}
