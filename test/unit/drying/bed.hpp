// A few granules with deposits and what they see of the gas.
#pragma once

#include "granum/drying/drying.hpp"

#include <cmath>
#include <vector>

namespace granum::drying::test
{
using math::zero_celsius;

//! Granules of 0.6 mm, 1445 kg/m3, with what they see.
struct Bed
{
    particle::Store granules;
    Deposits deposits;
    Settings settings;
    std::vector<double> temperature, vapour, potential, slip, sherwood, evaporated;
    std::vector<Event> events;
    double now = 0;

    explicit Bed(std::size_t rows, double count = 1) : deposits(rows)
    {
        settings.combine = law::deposit::Combined{};
        settings.porosity = [](double, double, double) { return 0.4; };
        granules.resize(rows);
        granules.owned = rows;
        double const d = 0.6e-3;
        for (std::size_t row = 0; row < rows; ++row) {
            granules.id[row] = rows - 1 - row;  // rows are not identities
            granules.count[row] = count;
            granules.core_diameter[row] = d;
            granules.core_mass[row] = count * 1445 * math::pi / 6 * d * d * d;
            granules.temperature[row] = 28.734 + zero_celsius;
            resize_granule(granules, row);
        }
        temperature.assign(rows, 60 + zero_celsius);
        vapour.assign(rows, material::fraction(0.012));
        potential.assign(rows, 0.6);
        slip.assign(rows, 1.5);
        sherwood.assign(rows, 5.731);
    }

    void advance(double dt)
    {
        now += dt;
        Drying(settings).advance(granules, deposits, {temperature, vapour, potential, slip, sherwood}, dt, now,
                                 evaporated, events);
    }

    //! `weight` caps of `water` and `solute` kg each on the granule of `row`.
    void wet(std::size_t row, double weight, double water, double solute, double base_radius)
    {
        Deposit fresh;
        fresh.weight = weight;
        fresh.water = fresh.water_at_impact = weight * water;
        fresh.solute = weight * solute;
        fresh.base_radius = base_radius;
        fresh.record.t_deposit = now;
        fresh.record.moisture_at_impact = water / solute;
        deposits.on(granules.id[row]).push_back(fresh);
        granules.water[row] += fresh.water, granules.solute[row] += fresh.solute;
    }
};
}
