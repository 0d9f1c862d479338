// A chain of spheres along x that touch each other, for tests of heat through contacts, on any number of ranks.
#pragma once

#include "granum/coupling/conduction.hpp"
#include "scene/granules.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace granum::scene
{
//! A sphere of a chain: how far it overlaps with the one before it, its heat and its material (0: of the first, 2: of
//! the second conductor).
struct Link
{
    double radius = 1e-3, overlap = 0, capacity = 1, temperature = 300;
    std::uint32_t material = 0;
};

class Chain
{
  public:
    std::vector<double> capacity;  //!< J/K of the owned rows
    Scene scene{limestone};

    //! The rank whose part of [0, length) a sphere lies in has it; ids follow the chain.
    Chain(std::span<Link const> links, MPI_Comm ranks = MPI_COMM_SELF)
    {
        scene.comm = par::Communicator(ranks);
        auto& settings = scene.settings;
        settings.laws.add({1e9, 0.25, false});
        for (std::uint32_t other : {0u, 1u, 2u}) settings.laws.pair(2, other, {});
        settings.frozen = true;
        double length = 0;
        for (auto const& link : links) {
            length += 2 * link.radius - link.overlap;
            settings.sight = std::max(settings.sight, 0.25 * link.radius);
        }
        settings.lower = {0, -0.5 * length, -0.5 * length}, settings.upper = {length, 0.5 * length, 0.5 * length};
        int const parts = scene.comm.size();
        scene.slabs = par::Slabs::balanced(0, length / parts, false,
                                           std::vector<double>(static_cast<std::size_t>(parts), 1.0), parts);
        double end = 0;
        for (std::size_t k = 0; k < links.size(); ++k) {
            auto const& link = links[k];
            double const x = end - link.overlap + link.radius;
            end = x + link.radius;
            if (scene.slabs.owner(x) != scene.comm.rank()) continue;
            auto const row = scene.add({x, 0, 0}, {}, link.radius, 2500, {}, link.material);
            auto& granules = scene.granules;
            granules.id[row] = k;
            granules.temperature[row] = link.temperature;
            granules.enthalpy[row] = link.capacity * (link.temperature - math::zero_celsius);
        }
        for (auto const& link : links) of_id_.push_back(link.capacity);
        scene.prepare();
        for (std::size_t row = 0; row < scene.granules.owned; ++row) capacity.push_back(of_id_[scene.granules.id[row]]);
    }

    int pass(coupling::Conduction const& conduction, double dt)
    {
        return conduction.pass(*scene.engine, scene.granules, capacity, dt).parts;
    }

    //! Sums over the spheres of all ranks. Collective.
    double heat() const
    {
        double sum = 0;
        for (std::size_t row = 0; row < scene.granules.owned; ++row) sum += scene.granules.enthalpy[row];
        return scene.comm.sum(sum);
    }

    //! Temperatures along the chain, K. Collective.
    std::vector<double> temperatures() const
    {
        std::vector<double> out(of_id_.size(), 0.0);
        for (std::size_t row = 0; row < scene.granules.owned; ++row)
            out[scene.granules.id[row]] = scene.granules.temperature[row];
        for (double& t : out) t = scene.comm.sum(t);
        return out;
    }

  private:
    std::vector<double> of_id_;
};
}
