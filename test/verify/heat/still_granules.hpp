// Granules that stay where they are, in a case as a user would write it: for tests of heat.
#pragma once

#include "scene/case_text.hpp"

#include <string>
#include <vector>

namespace granum::verify
{
using math::Vec3;

//! A granule given by hand.
struct Still
{
    Vec3 at;
    double radius;
    std::string material = "granule";
    double density = 1000;
    double temperature = 300;  //!< K
};

inline std::string still_text(std::vector<Still> const& granules)
{
    std::string out;
    for (auto const& one : granules)
        out += "[[granule]]\nposition = " + scene::vector_text(one.at, "m") +
               fmt::format("\ndiameter = \"{} m\"\ndensity = \"{} kg/m3\"\nmaterial = \"{}\"\ntemperature = \"{} K\"\n",
                           2 * one.radius, one.density, one.material, one.temperature);
    return out;
}

//! A closed box of gas that conducts next to nothing, so that granules exchange heat by the other ways only.
inline std::string silent_box(Vec3 const& size, double heat_capacity, std::string const& gas,
                              std::string const& contact, std::string const& granules = "")
{
    return "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n[apparatus]\nshape = \"box\"\nsize = " +
           scene::vector_text(size, "m") +
           fmt::format(
               "\n[granules]\ndiameter = \"1 mm\"\ndensity = \"1000 kg/m3\"\nheat_capacity = \"{} J/kg/K\"\n"
               "frozen = true\nstart = \"given\"\n{}[start]\ngas_temperature = \"300 K\"\n",
               heat_capacity, granules) +
           "[gas]\nclosed = true\ndensity = \"1 kg/m3\"\nconductivity = \"1e-13 W/m/K\"\ncells = [1, 1, 1]\n" + gas +
           "[contact]\nyoungs_modulus = \"10 MPa\"\n" + contact + "[time]\nduration = \"1 s\"\ngas_step = \"1000 s\"\n";
}

//! Of the granules in the order of their identities, K.
inline std::vector<double> temperatures(sim::Simulation& simulation)
{
    auto const& granules = simulation.granules();
    std::vector<double> out(granules.owned);
    for (std::size_t row = 0; row < granules.owned; ++row) out.at(granules.id[row]) = granules.temperature[row];
    return out;
}
}
