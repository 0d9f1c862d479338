// How densely granules lie in boxes that the case names, and where they go: boxes.csv.
#pragma once

#include "granum/sim/kept_series.hpp"
#include "granum/sim/simulation.hpp"

#include <string>
#include <vector>

namespace granum::sim
{
struct BoxContent
{
    double solids_fraction = 0;  //!< volume of granules in the box over its own; where two overlap both count
    double granules = 0;         //!< parcels whose centre lies in the box
    Vec3 velocity{};             //!< mean of what is inside, by volume, m/s
    double pressure = 0;         //!< mean of the gas above that of the case, Pa
};

//! What the boxes of the case hold, the same on every rank and on any number of them. A granule that crosses a face
//! counts with the part that is inside. Collective.
std::vector<BoxContent> box_contents(Simulation& simulation);

//! Writes on rank 0; every call is collective.
class BoxOutput
{
  public:
    BoxOutput(std::string const& folder, Simulation& simulation);

    void sample();  //!< a row of boxes.csv
    std::vector<BoxContent> const& last() const { return last_; }

    //! What the file held, and how it goes on from there; on rank 0.
    void save(io::Sections& out) const { table_.save(out); }
    void go_on(io::Sections const& saved);

  private:
    std::size_t width() const;  //!< columns of a box

    Simulation& simulation_;
    KeptSeries table_;
    std::vector<BoxContent> last_;
};
}
