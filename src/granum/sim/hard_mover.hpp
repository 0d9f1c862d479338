// Hard spheres as the granules of a run: their step, their readings since the start, and what a checkpoint holds of
// them.
#pragma once

#include "granum/dem/hard_spheres.hpp"
#include "granum/sim/mover.hpp"

namespace granum::sim
{
class HardMover final : public Mover
{
  public:
    HardMover(dem::Settings settings, dem::HardOptions const& options) : spheres_(std::move(settings), options) {}

    void prepare(particle::Store& granules) override { spheres_.prepare(granules); }
    void advance(particle::Store& granules, double dt, int steps) override;
    std::vector<dem::Contact> contacts() const override { return {}; }  // no contact lasts
    std::vector<dem::WallLoad> wall_loads() const override;
    void begin_interval() override;
    geometry::Pose const& pose(std::size_t) const override { return at_rest_; }
    dem::Settings const& settings() const override { return spheres_.settings(); }
    dem::Watch& watch() override { return watch_; }
    base::Stopwatch& stopwatch() override { return spheres_.stopwatch(); }
    dem::HardWatch const* hard_watch() override { return &spheres_.watch(); }

    //! A step, s, in which a granule meets about five others, going by the last of `dt` s; at most four times longer or
    //! shorter than `before`. Long enough that predicting all events anew costs little, short enough to be stopped.
    double next_step(particle::Store const& granules, double dt, double before) const;

    //! Everything but the granules' columns that the next step, or the next reading, depends on.
    io::Sections save();
    //! Throws base::IoError where the sections do not fit.
    void resume(particle::Store& granules, io::Sections const& saved);

  private:
    template <class Visit>
    void each_number(dem::HardMemory& memory, Visit&& visit);

    dem::HardSpheres spheres_;
    dem::Watch watch_;
    double met_ = 0;                      //!< partners that all granules met in the last call of `advance`
    double interval_ = 0;                 //!< s, since the means of loads began
    std::vector<dem::HardLoad> earlier_;  //!< loads before that
    geometry::Pose at_rest_;
};
}
