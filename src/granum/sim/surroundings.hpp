// What droplets meet: gas around a point, through the same weights as the granules' exchange, and granules within a
// reach that is the spray's own.
#pragma once

#include "granum/coupling/exchange.hpp"
#include "granum/spray/flight.hpp"
#include "granum/spray/nozzle.hpp"

#include <optional>

namespace granum::sim
{
class DropletSurroundings final : public spray::Surroundings
{
  public:
    DropletSurroundings(grid::Grid const& grid, coupling::Mapping const& mapping,
                        std::vector<spray::Nozzle> const& nozzles, par::Partition const& partition, int rank,
                        double reach);

    //! Takes the fields and granules of this step; exchange is added to `sources` as rates over `dt`.
    //! `eddies`: whether droplets ask for the turbulence.
    void prepare(gas::Solver const& solver, gas::State const& state, particle::Store const& granules,
                 gas::Sources& sources, double dt, bool eddies);

    spray::Seen seen(math::Vec3 const& x) const override;
    void give(math::Vec3 const& x, spray::Given const& given) override;
    void targets(math::Vec3 const& x, std::vector<spray::Target>& out) const override;
    bool mine(math::Vec3 const& x) const override { return partition_.owner(x) == rank_; }

  private:
    std::array<int, 3> cell_of(math::Vec3 const& x) const;
    //! Of the weights around x along direction d that fall into a cell.
    double share_of(std::size_t d, int cell, math::Vec3 const& x) const;

    grid::Grid const& grid_;
    coupling::Mapping const& mapping_;
    std::vector<spray::Nozzle> const& nozzles_;
    par::Partition const& partition_;
    int rank_;
    double reach_;  //!< within which a droplet strikes granules, m along each direction
    double dt_ = 0;
    std::array<grid::Field, 3> velocity_;
    std::optional<gas::Eddies> eddies_;
    gas::State const* state_ = nullptr;
    gas::Sources* sources_ = nullptr;
    particle::Store const* granules_ = nullptr;
    std::vector<std::uint32_t> first_, rows_;  //!< owned granules by cell
    double jet_reach_ = 0;                     //!< beyond it the cells resolve the jet, m
};
}
