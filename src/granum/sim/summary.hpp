// summary.json: what a run came to, in numbers that other programs can read.
#pragma once

#include "granum/sim/output.hpp"

#include <string>

namespace granum::sim
{
//! Wall time of the stages of a step, summed over ranks.
struct Performance
{
    double wall = 0;  //!< s
    std::array<double, static_cast<std::size_t>(base::Stage::count)> seconds{};
    long granule_steps = 0;
    long lists = 0;  //!< neighbour lists that were made
    HeatTotals heat{};
    GasWork gas;             //!< of this leg of the run
    double triad_rate = 0;   //!< bytes/s of a rank; 0: not measured
    std::string state_hash;  //!< of the granules now, see sim/state_hash.hpp
};

//! The summary as JSON text; call on rank 0 after the last `Output` calls with the collective numbers at hand.
std::string summary(Simulation& simulation, Output const& output, Performance const& performance,
                    std::vector<std::string> const& warnings, std::string const& ended);

//! The same in a few lines for people: property, eta, ledgers.
std::string closing_words(std::string const& summary_json);
}
