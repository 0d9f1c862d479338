// The one entry to a simulation: what `granum run` calls on every rank.
#pragma once

#include "granum/base/error.hpp"
#include "granum/par/communicator.hpp"
#include "granum/sim/case.hpp"

#include <optional>
#include <string>

namespace granum::sim
{
struct RunOptions
{
    std::string folder;           //!< of the results
    std::optional<double> until;  //!< s of simulated time, instead of the case's duration
    bool json = false;            //!< the program prints summary.json at the end, so nothing else may go to stdout
    bool quiet = false;           //!< no live line, no closing words
    bool go_on = false;           //!< the folder holds a run of this case: continue from its newest valid checkpoint
    std::string program = "?";    //!< version, for the checkpoints
};

//! Runs the case on the ranks of `comm` and fills the run folder, with checkpoints in it. Collective. Returns how it
//! ended; throws base::NumericsError or base::IoError where it fails, with the state of that moment in
//! `checkpoint/failed`.
base::Exit run(ResolvedCase const& resolved, RunOptions const& options, par::Communicator const& comm);
}
