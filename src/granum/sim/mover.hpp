// What moves the granules of a run, soft spheres or hard ones, as far as a run without gas and its outputs ask for it.
#pragma once

#include "granum/dem/engine.hpp"
#include "granum/dem/hard_world.hpp"
#include "granum/io/sections.hpp"

namespace granum::sim
{
class Mover
{
  public:
    virtual ~Mover() = default;

    //! Takes over granules that were placed, added or removed. Collective. Throws NumericsError on a state that it
    //! cannot move.
    virtual void prepare(particle::Store& granules) = 0;
    //! `steps` steps of `dt` seconds. Collective. Throws NumericsError.
    virtual void advance(particle::Store& granules, double dt, int steps) = 0;

    //! Pairs and walls that touch now.
    virtual std::vector<dem::Contact> contacts() const = 0;
    //! Loads on the bodies: of soft spheres at the last step, of hard ones their mean since `begin_interval`.
    //! Collective.
    virtual std::vector<dem::WallLoad> wall_loads() const = 0;
    //! What was read is written: means begin anew.
    virtual void begin_interval() {}
    virtual geometry::Pose const& pose(std::size_t body) const = 0;
    virtual dem::Settings const& settings() const = 0;
    virtual dem::Watch& watch() = 0;
    virtual base::Stopwatch& stopwatch() = 0;
    //! What hard spheres have met since the start; nothing for soft ones.
    virtual dem::HardWatch const* hard_watch() { return nullptr; }
};

//! Soft spheres. The engine stays with the simulation, which also lets the gas act through it and may exchange it.
class SoftMover final : public Mover
{
  public:
    explicit SoftMover(std::unique_ptr<dem::Engine> const& engine) : engine_(engine) {}

    void prepare(particle::Store& granules) override { engine_->prepare(granules); }
    void advance(particle::Store& granules, double dt, int steps) override { engine_->advance(granules, dt, steps); }
    std::vector<dem::Contact> contacts() const override { return engine_->contacts(); }
    std::vector<dem::WallLoad> wall_loads() const override { return engine_->wall_loads(); }
    geometry::Pose const& pose(std::size_t body) const override { return engine_->pose(body); }
    dem::Settings const& settings() const override { return engine_->settings(); }
    dem::Watch& watch() override { return engine_->watch(); }
    base::Stopwatch& stopwatch() override { return engine_->stopwatch(); }

  private:
    std::unique_ptr<dem::Engine> const& engine_;
};
}
