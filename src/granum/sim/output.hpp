// The run folder while the run goes on: ParaView series, snapshot, events, time series.
#pragma once

#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "granum/io/row_log.hpp"
#include "granum/io/snapshot_file.hpp"
#include "granum/io/vtk.hpp"
#include "granum/product/aggregate.hpp"
#include "granum/product/all.hpp"
#include "granum/sim/bed_statistics.hpp"
#include "granum/sim/box_output.hpp"
#include "granum/sim/probe_output.hpp"
#include "granum/sim/simulation.hpp"
#include "granum/sim/surface_sample.hpp"
#include "granum/sim/wall_output.hpp"

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
    BedStatistics bed;
    Traffic traffic;
};

//! Writes what the simulation shows. Only rank 0 touches the disk; every call is collective.
class Output
{
  public:
    //! The folder exists. The files in it begin anew or, with what `save` returned in `saved` (read on rank 0), go on
    //! from there: what was written later is taken back. Throws base::IoError.
    Output(std::string folder, Simulation& simulation, io::Sections const* saved = nullptr);

    //! Throws base::IoError where `saved` is of a version whose records are others: before any file is touched.
    static void check(io::Sections const& saved);

    void sample();            //!< a row of the time series
    void look_at_granules();  //!< brings `last_view` up to date without writing anything
    void picture();           //!< ParaView files and the snapshot for the report
    void events();            //!< moves finished events to the file

    //! What the files held by now and what the summary is made from; on rank 0, empty elsewhere. The events written so
    //! far are on the disk when it returns.
    io::Sections save() const;

    std::vector<Sample> const& samples() const { return samples_; }
    std::vector<product::LayerSum> const& layers() const { return layers_; }  //!< by granule, sprayed events only
    SurfaceSample const& surfaces() const { return surfaces_; }
    long event_count() const { return event_count_; }
    //! @{ Mechanical energy now, lost and gone out less that at the start, brought in and done by moving walls, J; and
    //! the largest sum of motion and loss met, J. The gas does work that is not in it.
    double energy_residual() const { return energy_residual_; }
    double energy_passed() const { return energy_passed_; }
    //! @}
    io::GranuleView const& last_view() const { return view_; }
    std::vector<BoxContent> const& boxes() const { return boxes_.last(); }  //!< as the case has them
    ProbeOutput const& probes() const { return probes_; }

  private:
    void go_on(io::Sections const& saved);
    void count(drying::Event const& event);
    void write(Sample const& sample);

    std::string folder_;
    Simulation& simulation_;
    bool root_;
    std::unique_ptr<io::SeriesWriter> series_;
    std::unique_ptr<io::EventsWriter> events_;
    std::unique_ptr<io::RowLog> event_log_;  //!< the same rows in our own format, from which events.h5 can be made anew
    WallOutput walls_;
    BoxOutput boxes_;
    ProbeOutput probes_;
    io::Collection granules_, droplets_, gas_;
    std::vector<Sample> samples_;
    std::vector<product::LayerSum> layers_;
    SurfaceSample surfaces_;
    product::Any model_;
    io::GranuleView view_;
    double energy_residual_ = 0, energy_passed_ = 0;
    long event_count_ = 0;
    int pictures_ = 0;
};
}
