// Cases stated as text, as a user would, and the simulation that `granum run` makes of them.
#pragma once

#include "granum/sim/case_reader.hpp"
#include "granum/sim/simulation.hpp"
#include "scene/temporary_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <string>

namespace granum::scene
{
//! The resolved case that `text` describes; `granules` is what its granules.file "granules.csv" holds. Throws
//! base::CaseError as the program would.
inline sim::Case case_of(std::string const& text, std::string const& granules = "")
{
    TemporaryFolder const folder;
    auto const path = folder / "case.toml";
    std::ofstream(path) << text;
    if (!granules.empty()) std::ofstream(folder / "granules.csv") << granules;
    return sim::read_case(path).data;
}

//! The simulation of the case in `text` at time zero, on one rank.
inline std::unique_ptr<sim::Simulation> simulation_of(std::string const& text, std::string const& granules = "")
{
    static par::Communicator const alone{MPI_COMM_SELF};
    return std::make_unique<sim::Simulation>(case_of(text, granules), alone);
}

//! A vector as a case has it: ["1 m", "2 m", "3 m"], to the last digit.
inline std::string vector_text(math::Vec3 const& v, std::string const& unit)
{
    return fmt::format("[\"{0} {3}\", \"{1} {3}\", \"{2} {3}\"]", v.x, v.y, v.z, unit);
}

//! A [[granule]] table.
inline std::string granule_text(sim::GranuleCase const& granule)
{
    std::string out = "[[granule]]\nposition = " + vector_text(granule.position, "m") + "\n";
    out += "velocity = " + vector_text(granule.velocity, "m/s") + "\n";
    out += "spin = " + vector_text(granule.spin, "rad/s") + "\n";
    if (granule.diameter > 0) out += fmt::format("diameter = \"{} m\"\n", granule.diameter);
    if (granule.density > 0) out += fmt::format("density = \"{} kg/m3\"\n", granule.density);
    return out;
}
}
