// What instruments at points and along lines of the case would show of the gas: probes.csv.
#pragma once

#include "granum/sim/kept_series.hpp"
#include "granum/sim/simulation.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace granum::sim
{
//! The gas at a place.
struct ProbeReading
{
    Vec3 velocity{};              //!< interstitial, m/s
    double temperature = 0;       //!< K
    double humidity = 0;          //!< kg/kg dry gas
    double drying_potential = 0;  //!< local, 1; 0 where nothing is sprayed
    double pressure = 0;          //!< above that of the case, Pa
    double voidage = 0;           //!< 1
};

//! The gas at every point of the probes of the case, in their order, the same on every rank and on any number of them:
//! straight between the middles of the cells around it, those behind walls left out. Collective.
std::vector<ProbeReading> probe_readings(Simulation& simulation);

//! Writes on rank 0; every call is collective.
class ProbeOutput
{
  public:
    ProbeOutput(std::string const& folder, Simulation& simulation);

    void sample();  //!< a row of probes.csv
    //! Mean and standard deviation of each column since `start`, by probe, for the summary; null without probes.
    nlohmann::json summary(double start) const;

    //! What the file held, and how it goes on from there; on rank 0.
    void save(io::Sections& out) const { table_.save(out); }
    void go_on(io::Sections const& saved) { table_.go_on(saved); }

  private:
    Simulation& simulation_;
    KeptSeries table_;
};
}
