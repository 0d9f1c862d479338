// Granules in a chamber with gas and what couples them, for tests on any number of ranks.
#pragma once

#include "granum/base/random.hpp"
#include "granum/coupling/exchange.hpp"
#include "unit/gas/chamber_with_gas.hpp"

#include <gtest/gtest.h>

namespace granum::coupling
{
//! A granule parcel by its real granules.
struct Parcel
{
    Vec3 position, velocity;
    double diameter = 0.6e-3, count = 1, density = 1445, temperature = 300;
};

inline void add(particle::Store& granules, particle::Id id, Parcel const& parcel)
{
    std::size_t const row = granules.rows();
    granules.resize(row + 1);
    granules.owned = row + 1;
    double const d = parcel.diameter;
    granules.id[row] = id;
    granules.position[row] = parcel.position;
    granules.velocity[row] = parcel.velocity;
    granules.count[row] = parcel.count;
    granules.diameter[row] = d;
    granules.radius[row] = 0.5 * d * std::cbrt(parcel.count);
    granules.mass[row] = granules.core_mass[row] = parcel.count * parcel.density * math::pi / 6 * d * d * d;
    granules.temperature[row] = parcel.temperature;
}

struct Bed : gas::ChamberWithGas
{
    static constexpr double heat_capacity = 1400;
    Mapping mapping;
    Exchange exchange;
    particle::Store granules;
    Seen seen;

    Bed(geometry::Chamber shape, std::array<int, 3> cells, std::array<bool, 3> periodic, gas::Settings settings,
        Laws laws, double width = 0, bool frozen = false, double temperature = 293.15, Vec3 velocity = {},
        MPI_Comm ranks = MPI_COMM_WORLD, Scheme scheme = Scheme::kernel)
        : ChamberWithGas(std::move(shape), cells, periodic, settings, temperature, 0, velocity, ranks),
          mapping(grid, comm, width, scheme),
          exchange(std::move(laws), solver, grid, comm, mapping, {heat_capacity, frozen})
    {
    }

    bool mine(Vec3 const& x) const
    {
        for (std::size_t d = 0; d < 3; ++d)
            if (grid.axes[d].cell(x[d]) < 0 || grid.axes[d].cell(x[d]) >= grid.n[d]) return false;
        return true;
    }

    //! Keeps the parcel on the rank that owns its place.
    void put(particle::Id id, Parcel const& parcel)
    {
        if (!mine(parcel.position)) return;
        add(granules, id, parcel);
        std::size_t const row = granules.owned - 1;
        granules.enthalpy[row] = exchange.heat_capacity(granules, row) * (parcel.temperature - math::zero_celsius);
    }

    //! `count` parcels at random in the part of the chamber below `height`, velocities up to 1 m/s, 280 to 380 K.
    void fill(int parcels, double height, double real_granules)
    {
        for (particle::Id id = 0; id < static_cast<particle::Id>(parcels); ++id) {
            base::Random random(7, base::Purpose::test, id, 0);
            Parcel parcel{.count = real_granules};
            Vec3 const low = chamber.lower(), high = chamber.upper();
            do
                parcel.position = {low.x + random.uniform() * (high.x - low.x),
                                   low.y + random.uniform() * (high.y - low.y), random.uniform() * height};
            while (!chamber.inside(parcel.position, 1e-4));
            parcel.velocity = {2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
            parcel.temperature = 280 + 100 * random.uniform();
            put(id, parcel);
        }
    }

    //! Shares, moves the gas on, delivers; returns the mismatch of momentum.
    double couple(double dt)
    {
        sources.clear(grid);
        mapping.locate(granules);
        voidage = exchange.voidage(granules);
        exchange.share(granules, state, dt, seen, sources);
        Field* fields[] = {&sources.drag_coefficient, &sources.drag_momentum[0], &sources.drag_momentum[1],
                           &sources.drag_momentum[2], &sources.force[0],         &sources.force[1],
                           &sources.force[2],         &sources.heat_coefficient, &sources.heat_value};
        mapping.finish(fields);
        passed = step(dt);
        return exchange.deliver(granules, state, dt, seen, sources);
    }
    gas::Balance passed;

    template <class Pick>
    double sum_over_granules(Pick&& pick) const
    {
        double sum = 0;
        for (std::size_t row = 0; row < granules.owned; ++row) sum += pick(row);
        return comm.sum(sum);
    }
};

inline Laws laws(law::drag::Any drag = law::drag::Beetstra{}, law::heat::Any heat = law::heat::Gunn{})
{
    return {std::move(drag), std::move(heat)};
}

//! A cone of 8 x 8 x 20 cells of 12.5 mm, with a bed of parcels in its lower part.
inline geometry::Chamber cone()
{
    return {.shape = geometry::Chamber::Shape::revolution, .profile = {{0, 0.03}, {0.2, 0.05}, {0.25, 0.05}}};
}
inline constexpr std::array<int, 3> cone_cells{8, 8, 20};
}
