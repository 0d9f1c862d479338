// The run folder while the run goes on: ParaView series, snapshot, events, time series.
#pragma once

#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "granum/io/snapshot_file.hpp"
#include "granum/io/vtk.hpp"
#include "granum/product/aggregate.hpp"
#include "granum/product/all.hpp"
#include "granum/sim/simulation.hpp"

#include <memory>
#include <string>
#include <vector>

namespace granum::sim
{
//! A row of timeseries.csv, and what the summary is made from.
struct Sample
{
    double time;
    Readings readings;
    SprayTotals totals;
};

//! Writes what the simulation shows. Only rank 0 touches the disk; every call is collective.
class Output
{
  public:
    //! The folder exists and is empty. Throws base::IoError.
    Output(std::string folder, Simulation& simulation);

    void sample();   //!< a row of the time series
    void picture();  //!< ParaView files and the snapshot for the report
    void events();   //!< moves finished events to the file

    std::vector<Sample> const& samples() const { return samples_; }
    std::vector<product::LayerSum> const& layers() const { return layers_; }  //!< by granule, sprayed events only
    long event_count() const { return event_count_; }
    io::GranuleView const& last_view() const { return view_; }

  private:
    std::string folder_;
    Simulation& simulation_;
    bool root_;
    std::unique_ptr<io::SeriesWriter> series_;
    std::unique_ptr<io::EventsWriter> events_;
    io::Collection granules_, droplets_, gas_;
    std::vector<Sample> samples_;
    std::vector<product::LayerSum> layers_;
    product::Any model_;
    io::GranuleView view_;
    long event_count_ = 0;
    int pictures_ = 0;
};
}
